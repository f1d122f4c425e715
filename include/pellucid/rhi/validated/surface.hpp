// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Validated<B>::Surface`: what is presented is checked, then forwarded with the backend's own handle.
#include <memory>
#include <pellucid/rhi/surface.hpp>
#include <pellucid/rhi/validated/device.hpp>

namespace pellucid::inline v0_1::validated {

/// Models `SurfaceOf<Surface<B>, Device<B>>` where B presents.
template <rhi::Backend B>
class Surface {
public:
    static Result<std::unique_ptr<Surface>> create(Device<B>& device, const rhi::SurfaceDesc& desc) {
        PELLUCID_TRY(auto inner, B::Surface::create(device.backend(), desc));
        return std::unique_ptr<Surface>(new Surface(device, std::move(inner)));
    }
    Result<bool> present(rhi::Texture texture, Extent2D size) {
        if (!device_->may_present(texture)) return Error{Errc::invalid_argument, "present was misused: see the log"};
        return inner_->present(device_->backend(texture), size);
    }

private:
    Surface(Device<B>& device, std::unique_ptr<typename B::Surface> inner)
        : device_(&device), inner_(std::move(inner)) {}

    Device<B>* device_;
    std::unique_ptr<typename B::Surface> inner_;
};

}  // namespace pellucid::inline v0_1::validated
