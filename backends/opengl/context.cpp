// SPDX-License-Identifier: MIT
#include "pellucid/opengl/context.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <atomic>
#include <map>
#include <mutex>
#include <string_view>

#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

bool has_word(const char* words, std::string_view word) {
    if (!words) return false;
    std::string_view rest = words;
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == word) return true;
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    return false;
}

// epoxy ends the process where libEGL is absent: look first.
bool egl_exists() {
    static const bool exists = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL) != nullptr;
    return exists;
}

/// How many contexts there are on each borrowed EGLDisplay.
std::mutex borrowed_mutex;
std::map<void*, int> borrowed_contexts;

void borrow(void* display) {
    const std::scoped_lock lock(borrowed_mutex);
    ++borrowed_contexts[display];
}
void give_back(void* display) {
    const std::scoped_lock lock(borrowed_mutex);
    if (--borrowed_contexts[display] != 0) return;
    borrowed_contexts.erase(display);
    eglTerminate(display);
}

}  // namespace

std::vector<Adapter> find_adapters(const rhi::NativeDisplay& wanted) {
    std::vector<Adapter> found;
    if (!egl_exists()) return found;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!get_display) return found;
    if (wanted.system == rhi::WindowSystem::x11) {
        if (has_word(client, "EGL_EXT_platform_x11") || has_word(client, "EGL_KHR_platform_x11"))
            if (void* display = get_display(EGL_PLATFORM_X11_EXT, wanted.connection, nullptr))
                found.push_back({display, "EGL device of the X11 display", true, true});
        return found;
    }
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto device_string =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    if (has_word(client, "EGL_EXT_platform_device") && query_devices && device_string) {
        EGLint count = 0;
        query_devices(0, nullptr, &count);
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count > 0 ? count : 0));
        if (count > 0) query_devices(count, devices.data(), &count);
        for (const EGLDeviceEXT device : devices) {
            // Mesa's software device comes by the surfaceless platform below, which needs no device node.
            if (has_word(device_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
            if (void* display = get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr))
                found.push_back({display, text("EGL device %zu", found.size())});
        }
    }
    if (has_word(client, "EGL_MESA_platform_surfaceless"))
        if (void* display = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr))
            found.push_back({display, "EGL surfaceless platform", true});
    return found;
}

Result<std::unique_ptr<Context>> Context::open(const Adapter& adapter, bool validation) {
    EGLint major = 0, minor = 0;
    if (!eglInitialize(adapter.display, &major, &minor))
        return Error{Errc::unsupported, text("a driver that starts: eglInitialize failed on the %s with error 0x%x",
                                             adapter.name.c_str(), static_cast<unsigned>(eglGetError()))};
    std::unique_ptr<Context> made(new Context);
    made->display_ = adapter.display;
    made->borrowed_ = adapter.borrowed;
    if (adapter.borrowed) borrow(adapter.display);  // given back also where no context can be had
    const char* extensions = eglQueryString(adapter.display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_create_context", "EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"})
        if (!has_word(extensions, needed)) return Error{Errc::unsupported, needed};

    eglBindAPI(EGL_OPENGL_API);
    const bool can_skip_errors = has_word(extensions, "EGL_KHR_create_context_no_error");
    const bool can_tell_reset = major > 1 || minor >= 5 || has_word(extensions, "EGL_EXT_create_context_robustness");
    // Some drivers refuse no-error together with reset notification: ask for both, then for less.
    for (int attempt = 0; attempt < 3 && !made->context_; ++attempt) {
        const bool reset = attempt == 0;
        const bool no_error = !validation && can_skip_errors && attempt < 2;
        if (reset && !can_tell_reset) continue;
        EGLint attributes[16] = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                 EGL_CONTEXT_MINOR_VERSION,       5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
        std::size_t n = 6;
        auto add = [&](EGLint key, EGLint value) { attributes[n++] = key, attributes[n++] = value; };
        if (validation) add(EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE);
        if (no_error) add(EGL_CONTEXT_OPENGL_NO_ERROR_KHR, EGL_TRUE);
        if (reset) add(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET);
        attributes[n] = EGL_NONE;
        made->context_ = eglCreateContext(adapter.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        made->no_error_ = no_error;
    }
    if (!made->context_)
        return Error{Errc::unsupported, text("OpenGL 4.5 core: eglCreateContext failed on the %s with error 0x%x",
                                             adapter.name.c_str(), static_cast<unsigned>(eglGetError()))};
    static std::atomic<std::uint64_t> serials = 0;
    made->serial_ = ++serials;
    if (!made->make_current())
        return Error{Errc::unsupported,
                     text("a context without a surface: eglMakeCurrent failed on the %s with error 0x%x",
                          adapter.name.c_str(), static_cast<unsigned>(eglGetError()))};
    return made;
}

Context::~Context() {
    if (context_ && current_context == serial_) {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        current_context = 0;
        call_counter = nullptr;
    }
    if (context_) eglDestroyContext(display_, context_);
    if (borrowed_) give_back(display_);
}

bool Context::make_current() noexcept {
    eglBindAPI(EGL_OPENGL_API);
    if (!eglMakeCurrent(display_, surface_, surface_, context_)) return false;
    current_context = serial_;
    call_counter = &calls;
    return true;
}

CurrentGuard::CurrentGuard() noexcept : serial_(current_context), counter_(call_counter) {
    const bool egl = egl_exists();
    if (egl) eglBindAPI(EGL_OPENGL_API);
    display_ = egl ? eglGetCurrentDisplay() : nullptr;
    context_ = egl ? eglGetCurrentContext() : nullptr;
    draw_ = egl ? eglGetCurrentSurface(EGL_DRAW) : nullptr;
    read_ = egl ? eglGetCurrentSurface(EGL_READ) : nullptr;
}

CurrentGuard::~CurrentGuard() {
    if (context_ && eglMakeCurrent(display_, draw_, read_, context_)) {
        current_context = serial_;
        call_counter = counter_;
    }
}

}  // namespace pellucid::inline v0_1::opengl
