// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Ownership: `Unique<D, H>` destroys the object its handle names.
#include <utility>

namespace pellucid::inline v0_1::rhi {

/// Owns the object that `handle` names in `device`, which must outlive it.  Move-only.
template <class Device, class Handle>
class Unique {
public:
    Unique() = default;
    Unique(Device& device, Handle handle) noexcept : device_(&device), handle_(handle) {}
    Unique(Unique&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, {})) {}
    Unique& operator=(Unique&& other) noexcept {
        if (this != &other) {
            reset();
            device_ = other.device_;
            handle_ = std::exchange(other.handle_, {});
        }
        return *this;
    }
    ~Unique() { reset(); }

    [[nodiscard]] Handle get() const noexcept { return handle_; }
    operator Handle() const noexcept { return handle_; }  // NOLINT: a Unique is used as its handle
    [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(handle_); }
    void reset() {
        if (handle_) device_->destroy(handle_);
        handle_ = {};
    }

private:
    Device* device_ = nullptr;
    Handle handle_{};
};

}  // namespace pellucid::inline v0_1::rhi

/// `PELLUCID_OWN(member, device, device.make_buffer({...}));`: moves the created object into a `Unique`, or returns the
/// error from the enclosing function.
#define PELLUCID_OWN(target, device, ...) \
    PELLUCID_OWN_INNER(PELLUCID_CONCAT(pellucid_own_, __LINE__), target, device, __VA_ARGS__)
#define PELLUCID_OWN_INNER(temporary, target, device, ...) \
    auto temporary = (__VA_ARGS__);                        \
    if (!temporary) return temporary.error();              \
    target = ::pellucid::rhi::Unique(device, *temporary)
