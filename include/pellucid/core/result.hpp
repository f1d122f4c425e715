// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Errors as values.  Every function that can fail returns `Result<T>`; nothing throws across the API.
#include <cassert>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace pellucid::inline v0_1 {

/// What kind of failure: a caller may branch on it; a person reads `Error::message`.
enum class Errc : std::uint8_t {
    invalid_argument,  ///< the caller passed something outside the documented range
    unsupported,       ///< this device, driver or build lacks a feature that was asked for
    no_device,         ///< no device of the asked-for kind was found
    device_lost,       ///< the device stopped answering; every object of it is dead
    out_of_memory,     ///< host or device memory ran out
    io,                ///< a file could not be read or written
    parse,             ///< a file's content is not valid
    internal           ///< a driver or this library broke its own contract
};

/// The enumerator's name, e.g. "invalid_argument".
[[nodiscard]] constexpr const char* name(Errc code) noexcept {
    constexpr const char* names[] = {"invalid_argument", "unsupported", "no_device", "device_lost",
                                     "out_of_memory",    "io",          "parse",     "internal"};
    return names[static_cast<std::size_t>(code)];
}

/// A failure: its kind and one sentence that says what, where, the value, the limit and what to do.
struct Error {
    Errc code = Errc::internal;
    std::string message;
};

/// Either a `T` or an `Error` (C++20 has no std::expected).  Reading the side that is not there is a
/// precondition violation, checked by assert.
template <class T = void>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit by design
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

    [[nodiscard]] explicit operator bool() const noexcept { return state_.index() == 0; }
    [[nodiscard]] T& operator*() & { return assert(*this), *std::get_if<0>(&state_); }
    [[nodiscard]] const T& operator*() const& { return assert(*this), *std::get_if<0>(&state_); }
    [[nodiscard]] T&& operator*() && { return assert(*this), std::move(*std::get_if<0>(&state_)); }
    [[nodiscard]] T* operator->() { return &**this; }
    [[nodiscard]] const T* operator->() const { return &**this; }
    [[nodiscard]] const Error& error() const { return assert(!*this), *std::get_if<1>(&state_); }

private:
    std::variant<T, Error> state_;
};

/// Success, or an `Error`.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT: implicit by design
    [[nodiscard]] explicit operator bool() const noexcept { return ok_; }
    [[nodiscard]] const Error& error() const { return assert(!ok_), error_; }

private:
    Error error_;
    bool ok_ = true;
};

}  // namespace pellucid::inline v0_1

#define PELLUCID_CONCAT_INNER(a, b) a##b
#define PELLUCID_CONCAT(a, b) PELLUCID_CONCAT_INNER(a, b)
/// `PELLUCID_TRY(target, expression);`: assigns the value of a `Result` to `target` (a declaration or an lvalue), or
/// returns its error from the enclosing function.
#define PELLUCID_TRY(target, ...) PELLUCID_TRY_INNER(PELLUCID_CONCAT(pellucid_try_, __LINE__), target, __VA_ARGS__)
#define PELLUCID_TRY_INNER(temporary, target, ...) \
    auto temporary = (__VA_ARGS__);                \
    if (!temporary) return temporary.error();      \
    target = std::move(*temporary)
/// `PELLUCID_CHECK(expression);`: returns the error of a `Result<void>` from the enclosing function, if there is one.
#define PELLUCID_CHECK(...)                                                                      \
    do {                                                                                         \
        if (auto pellucid_check = (__VA_ARGS__); !pellucid_check) return pellucid_check.error(); \
    } while (false)
