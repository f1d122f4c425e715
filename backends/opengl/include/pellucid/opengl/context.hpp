// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// An OpenGL 4.5 core context without a window or a surface, and which one is current on this thread.
#include <memory>
#include <pellucid/core/log.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/rhi/desc.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::opengl {

/// One way to get a context: a device of EGL's enumeration (hardware), or Mesa's surfaceless platform.
struct Adapter {
    void* display = nullptr;   ///< EGLDisplay, not yet initialised
    std::string name;          ///< for messages before there is a context
    bool by_platform = false;  ///< surfaceless platform: may be a device of the enumeration once more
    bool borrowed = false;     ///< on a connection of the window library's, which may close it after the last context
};

/// What there is on this machine; empty where there is no EGL.  With a `display`, only the device that drives it: EGL
/// makes windows for the contexts of their own display alone.
[[nodiscard]] std::vector<Adapter> find_adapters(const rhi::NativeDisplay& display = {});

/// Where the driver's debug messages go while a context is in validation mode.
struct DebugSink {
    LogSink log = {};
    bool quiet = false;  ///< set while a failure is reported by a `Result` anyway
};

inline constinit thread_local std::uint64_t current_context = 0;  ///< serial number; 0: none of ours

/// Owns an EGL context.  It belongs to the thread that made it: EGL refuses to make it current on a second one while it
/// is current on the first.  The EGL display under it is shared by the whole process and stays initialised, but for one
/// on a window library's connection: that ends with its last context, since the connection may be closed then.
class Context {
public:
    /// A new context, made current.  `unsupported` with what `adapter` lacks.
    [[nodiscard]] static Result<std::unique_ptr<Context>> open(const Adapter& adapter, bool validation);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it current unless it is.  False where EGL refuses: it is current on another thread.
    bool enter() noexcept {
        if (current_context == serial_) [[likely]]
            return true;
        return make_current();
    }
    [[nodiscard]] bool no_error() const noexcept { return no_error_; }
    /// Makes it current together with a window's EGLSurface, from now on; null: without one.  False where EGL refuses.
    bool show_in(void* surface) noexcept {
        surface_ = surface;
        return make_current();
    }
    [[nodiscard]] void* display() const noexcept { return display_; }  ///< the EGLDisplay
    [[nodiscard]] void* surface() const noexcept { return surface_; }

    std::uint64_t calls = 0;  ///< counted API calls (calls.hpp)

private:
    Context() = default;
    bool make_current() noexcept;

    void* display_ = nullptr;
    void* context_ = nullptr;
    void* surface_ = nullptr;
    std::uint64_t serial_ = 0;
    bool no_error_ = false;
    bool borrowed_ = false;
};

/// Restores, when it ends, what was current on this thread when it began.
class CurrentGuard {
public:
    CurrentGuard() noexcept;
    ~CurrentGuard();
    CurrentGuard(const CurrentGuard&) = delete;
    CurrentGuard& operator=(const CurrentGuard&) = delete;

private:
    void *display_, *context_, *draw_, *read_;
    std::uint64_t serial_;
    std::uint64_t* counter_;
};

}  // namespace pellucid::inline v0_1::opengl
