// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bit sets over scoped enumerations: specialise `enable_flags<E>` and `|`, `&`, `has` work on `E`.
#include <type_traits>

namespace pellucid::inline v0_1 {

template <class E>
inline constexpr bool enable_flags = false;

template <class E>
concept FlagEnum = std::is_enum_v<E> && enable_flags<E>;

/// The flags of either.
template <FlagEnum E>
[[nodiscard]] constexpr E operator|(E a, E b) noexcept {
    using U = std::underlying_type_t<E>;
    return static_cast<E>(static_cast<U>(a) | static_cast<U>(b));
}
/// The flags of both.
template <FlagEnum E>
[[nodiscard]] constexpr E operator&(E a, E b) noexcept {
    using U = std::underlying_type_t<E>;
    return static_cast<E>(static_cast<U>(a) & static_cast<U>(b));
}
/// Adds flags.
template <FlagEnum E>
constexpr E& operator|=(E& a, E b) noexcept {
    return a = a | b;
}
/// Whether `set` holds every bit of `bits`.
template <FlagEnum E>
[[nodiscard]] constexpr bool has(E set, E bits) noexcept {
    return (set & bits) == bits;
}
/// Whether `set` holds any bit of `bits`.
template <FlagEnum E>
[[nodiscard]] constexpr bool has_any(E set, E bits) noexcept {
    return (set & bits) != E{};
}

}  // namespace pellucid::inline v0_1
