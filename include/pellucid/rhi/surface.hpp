// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Windows: an addition to a backend.  A surface shows textures in one window of a window library (GLFW, SDL, Qt …):
/// nothing renders to a window itself, so a picture is the same bits in a window and without one, and presenting is a
/// copy.
///
///     DeviceDesc::display names the connection to the window system; then
///     PELLUCID_TRY(auto surface, B::Surface::create(*device, {.window = native_window}));
///     … begin_frame, record, submit …
///     PELLUCID_TRY(const bool shown, surface->present(picture, {width, height}));
///
/// A surface is destroyed before its device and before its window.
#include <pellucid/rhi/backend.hpp>
#include <cstdint>
#include <memory>

namespace pellucid::inline v0_1::rhi {

/// A window to show textures in.
struct SurfaceDesc {
    std::uintptr_t window = 0;  ///< X11: the `Window`
    bool vsync = true;          ///< wait for the display's refresh; false: show at once, pictures may tear
    const char* debug_name = "window";
};

/// What textures can be shown: codes that a display takes as they are, or linear values that become codes as they are.
/// sRGB formats cannot: one API would decode them on the way, the other would not.
[[nodiscard]] inline Result<void> check_presentable(Format format, const char* window) {
    if (format == Format::rgba8_unorm || format == Format::rgba16_float || format == Format::rgba32_float) return {};
    return Error{Errc::invalid_argument, std::string("present: '") + window + "' shows textures of rgba8_unorm, " +
                                             "rgba16_float or rgba32_float; this one is of " + info(format).name};
}
/// The error of `create` for a device that was made without `DeviceDesc::display`.
[[nodiscard]] inline Error no_display(const char* window) {
    return {Errc::invalid_argument, std::string("the surface '") + window +
                                        "' needs a device for windows: set DeviceDesc::display when making the device"};
}

/// `create(device, desc)`: `invalid_argument` for a device without `DeviceDesc::display`; `unsupported` where the
/// window cannot show what the device draws.
///
/// `present(texture, size)`: shows level 0 of a texture (check_presentable; usage copy_source; values in [0,1]) in a
/// window of `size` pixels, stretched where the sizes differ, row 0 at the top, after everything that was submitted.
/// Call it between `submit` and `begin_frame`.  `size` is that of the window's framebuffer now: where it changed,
/// what is behind the window is made again.  Gives whether anything was shown: not where the window has no pixels
/// (minimised), or is of another size by now (present again once the window library says which).  Errors: device loss,
/// memory, a window that is gone.
template <class S, class D>
concept SurfaceOf = requires(S s, D& device, const SurfaceDesc& desc, Texture texture, Extent2D size) {
    { S::create(device, desc) } -> std::same_as<Result<std::unique_ptr<S>>>;
    { s.present(texture, size) } -> std::same_as<Result<bool>>;
};

/// A backend with `B::Surface`, whose definition is in its own header `pellucid/<name>/surface.hpp`.
template <class B>
concept PresentingBackend = Backend<B> && SurfaceOf<typename B::Surface, typename B::Device>;

}  // namespace pellucid::inline v0_1::rhi
