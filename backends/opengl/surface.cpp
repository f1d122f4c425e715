// SPDX-License-Identifier: MIT
#include "pellucid/opengl/surface.hpp"

#include <X11/Xlib.h>
#include <dlfcn.h>
#include <epoxy/egl.h>

#include <vector>

#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

/// The visual of a window, which its EGL configuration must have; 0 where it cannot be had.  Whoever has a `Display*`
/// has libX11 loaded, so nothing of ours links to it.
EGLint visual_of(const rhi::NativeDisplay& display, std::uintptr_t window) {
    void* const library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) return 0;
    const auto attributes_of =
        reinterpret_cast<decltype(&XGetWindowAttributes)>(dlsym(library, "XGetWindowAttributes"));
    const auto id_of = reinterpret_cast<decltype(&XVisualIDFromVisual)>(dlsym(library, "XVisualIDFromVisual"));
    XWindowAttributes attributes = {};
    EGLint visual = 0;
    if (attributes_of && id_of &&
        attributes_of(static_cast<::Display*>(display.connection), static_cast<::Window>(window), &attributes))
        visual = static_cast<EGLint>(id_of(attributes.visual));
    dlclose(library);
    return visual;
}

/// The first configuration for windows of that visual, or null.
EGLConfig config_for(EGLDisplay display, EGLint visual) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, nullptr, 0, &count)) return nullptr;
    std::vector<EGLConfig> configs(static_cast<std::size_t>(count));
    if (!eglChooseConfig(display, wanted, configs.data(), count, &count)) return nullptr;
    for (const EGLConfig config : configs) {
        EGLint id = 0, samples = 0;
        eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &id);
        eglGetConfigAttrib(display, config, EGL_SAMPLES, &samples);
        if (id == visual && samples == 0) return config;
    }
    return nullptr;
}

}  // namespace

Result<std::unique_ptr<Surface>> Surface::create(Device& device, const rhi::SurfaceDesc& desc) {
    if (device.display_.system == rhi::WindowSystem::none) return rhi::no_display(desc.debug_name);
    std::unique_ptr<Surface> surface(new Surface(device));
    PELLUCID_CHECK(surface->start(desc));
    return surface;
}

Surface::~Surface() {
    if (!surface_) return;
    Context& context = *device_.context_;
    if (context.surface() == surface_) context.show_in(nullptr);
    eglDestroySurface(context.display(), surface_);
}

Error Surface::fail(const char* what) const {
    return {Errc::invalid_argument,
            text("%s for '%s' failed with the EGL error 0x%x: the window is gone, or another API draws into it; make a "
                 "new surface for a new window",
                 what, name_.c_str(), static_cast<unsigned>(eglGetError()))};
}

Result<void> Surface::start(const rhi::SurfaceDesc& desc) {
    name_ = desc.debug_name;
    vsync_ = desc.vsync;
    PELLUCID_CHECK(device_.enter());
    const EGLDisplay display = device_.context_->display();
    const EGLint visual = visual_of(device_.display_, desc.window);
    const EGLConfig config = config_for(display, visual);
    if (!config)
        return Error{Errc::unsupported,
                     text("EGL has no configuration for '%s', whose X visual is 0x%x: make the window with the "
                          "display's default visual",
                          name_.c_str(), static_cast<unsigned>(visual))};
    const auto create = reinterpret_cast<PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC>(
        eglGetProcAddress("eglCreatePlatformWindowSurfaceEXT"));
    auto window = static_cast<::Window>(desc.window);
    if (create) surface_ = create(display, config, &window, nullptr);
    if (!surface_) return fail("eglCreatePlatformWindowSurface");
    return {};
}

Result<bool> Surface::present(rhi::Texture handle, Extent2D size) {
    PELLUCID_CHECK(device_.enter());
    if (device_.in_frame_) return Error{Errc::invalid_argument, "present: submit the frame before"};
    TextureObject* const texture = device_.objects_.textures.find(handle);
    if (!texture) return Error{Errc::invalid_argument, "present: the texture is not alive"};
    PELLUCID_CHECK(rhi::check_presentable(texture->format, name_.c_str()));
    if (size.width == 0 || size.height == 0) return false;

    Commands& commands = device_.commands_;
    // Mesa (22.3) gives buffers only to a window that is bound, whatever a call names.
    if (commands.framebuffer_ != 0) glBindFramebuffer(GL_DRAW_FRAMEBUFFER, commands.framebuffer_ = 0);
    Context& context = *device_.context_;
    if (context.surface() != surface_) {
        if (!context.show_in(surface_)) {
            const Error error = fail("eglMakeCurrent");
            context.show_in(nullptr);
            return error;
        }
        // A context that was made without a window draws to none of a window's buffers.
        glNamedFramebufferDrawBuffer(0, GL_BACK);
    }
    if (!paced_) paced_ = eglSwapInterval(context.display(), vsync_ ? 1 : 0);

    const GLuint source = commands.framebuffers_.find_or_make(
        device_.objects_, {.colors = {{.texture = handle}}, .size = texture->size, .name = "window"}, commands.labels_);
    if (source == 0)
        return Error{Errc::unsupported, text("'%s': the driver refuses to copy the texture", name_.c_str())};
    glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);  // shaders may have written it
    commands.set_scissor({0, 0, size.width, size.height});
    const auto w = static_cast<GLint>(texture->size.width), h = static_cast<GLint>(texture->size.height);
    const auto width = static_cast<GLint>(size.width), height = static_cast<GLint>(size.height);
    glDisable(GL_FRAMEBUFFER_SRGB);  // Mesa's windows can encode, and what is shown are codes already
    // Row 0 of a texture is the top row, row 0 of a window the bottom one.
    glBlitNamedFramebuffer(source, 0, 0, 0, w, h, 0, height, width, 0, GL_COLOR_BUFFER_BIT,
                           w == width && h == height ? GL_NEAREST : GL_LINEAR);
    glEnable(GL_FRAMEBUFFER_SRGB);
    if (eglSwapBuffers(context.display(), surface_)) return true;
    if (glGetGraphicsResetStatus() == GL_NO_ERROR) return fail("eglSwapBuffers");
    device_.lost_ = true;
    return device_.lost_error();
}

}  // namespace pellucid::inline v0_1::opengl
