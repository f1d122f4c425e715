// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A fixed-capacity list that lives inside its owner: descriptors hold attachments and bindings without allocating.
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace pellucid::inline v0_1 {

/// Up to `N` values of `T`.  Precondition of every insertion: size() < N (asserted).
template <class T, std::size_t N>
class SmallVector {
public:
    constexpr SmallVector() = default;
    constexpr SmallVector(std::initializer_list<T> values) {
        for (const T& value : values) push_back(value);
    }
    constexpr void push_back(const T& value) {
        assert(size_ < N);
        values_[size_++] = value;
    }
    constexpr void clear() noexcept { size_ = 0; }
    [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
    [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] static constexpr std::size_t capacity() noexcept { return N; }
    [[nodiscard]] constexpr T& operator[](std::size_t i) { return assert(i < size_), values_[i]; }
    [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return assert(i < size_), values_[i]; }
    [[nodiscard]] constexpr const T* begin() const noexcept { return values_; }
    [[nodiscard]] constexpr const T* end() const noexcept { return values_ + size_; }
    [[nodiscard]] constexpr T* begin() noexcept { return values_; }
    [[nodiscard]] constexpr T* end() noexcept { return values_ + size_; }
    friend constexpr bool operator==(const SmallVector& a, const SmallVector& b) {
        if (a.size_ != b.size_) return false;
        for (std::size_t i = 0; i < a.size_; ++i)
            if (!(a.values_[i] == b.values_[i])) return false;
        return true;
    }

private:
    T values_[N]{};
    std::size_t size_ = 0;
};

}  // namespace pellucid::inline v0_1
