// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Typed handles (index + generation) and the slot map that hands them out.
#include <compare>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1 {

/// Names an object of kind `Tag` in the device that made it: 20 bits of index, 12 of generation.  A default handle is
/// null.  A handle whose object was destroyed never names another object until 4,095 others have used its slot.
template <class Tag>
struct Handle {
    std::uint32_t bits = 0;

    [[nodiscard]] constexpr explicit operator bool() const noexcept { return bits != 0; }
    [[nodiscard]] constexpr std::uint32_t index() const noexcept { return bits & 0xFFFFFu; }
    [[nodiscard]] constexpr std::uint32_t generation() const noexcept { return bits >> 20u; }
    friend constexpr auto operator<=>(Handle, Handle) = default;
};

/// Dense storage addressed by handles.  Insertion, lookup and erasure are O(1); addresses may move on insertion.
template <class Tag, class T>
class SlotMap {
public:
    Handle<Tag> insert(T value) {
        std::uint32_t index;
        if (free_.empty()) {
            index = static_cast<std::uint32_t>(slots_.size());
            slots_.push_back({});
        } else {
            index = free_.back();
            free_.pop_back();
        }
        Slot& slot = slots_[index];
        slot.value = std::move(value);
        slot.live = true;
        ++live_;
        return {index | slot.generation << 20u};
    }
    /// Null where the handle is null, stale or foreign.
    [[nodiscard]] T* find(Handle<Tag> handle) noexcept {
        const std::uint32_t index = handle.index();
        if (!handle || index >= slots_.size()) return nullptr;
        Slot& slot = slots_[index];
        return slot.live && slot.generation == handle.generation() ? &slot.value : nullptr;
    }
    [[nodiscard]] const T* find(Handle<Tag> handle) const noexcept { return const_cast<SlotMap*>(this)->find(handle); }
    /// Precondition: the handle is live.
    [[nodiscard]] T& operator[](Handle<Tag> handle) noexcept { return slots_[handle.index()].value; }
    [[nodiscard]] const T& operator[](Handle<Tag> handle) const noexcept { return slots_[handle.index()].value; }
    /// Removes and returns the object; a default `T` where the handle names none.
    T erase(Handle<Tag> handle) {
        T* found = find(handle);
        if (!found) return T{};
        T value = std::move(*found);
        Slot& slot = slots_[handle.index()];
        slot.value = T{};
        slot.live = false;
        slot.generation = slot.generation % 4095u + 1u;  // 1 … 4095: a live handle is never all zero bits
        free_.push_back(handle.index());
        --live_;
        return value;
    }
    [[nodiscard]] std::uint32_t size() const noexcept { return live_; }
    template <class F>
    void for_each(F&& f) {
        for (std::uint32_t i = 0; i < slots_.size(); ++i)
            if (slots_[i].live) f(Handle<Tag>{i | slots_[i].generation << 20u}, slots_[i].value);
    }

private:
    struct Slot {
        T value{};
        std::uint32_t generation = 1;
        bool live = false;
    };
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
    std::uint32_t live_ = 0;
};

}  // namespace pellucid::inline v0_1
