// SPDX-License-Identifier: MIT
// The whole of it: load a glTF file, draw it on the backend chosen at startup, write a picture.
#include <pellucid/pellucid.hpp>
#include <cstdio>

template <pellucid::rhi::Backend B>
pellucid::Result<void> draw(const char* file, const char* picture) {
    pellucid::Scene scene;
    PELLUCID_TRY(scene, pellucid::load_gltf(file));
    std::unique_ptr<typename B::Device> device;
    PELLUCID_TRY(device, B::create({}));
    std::unique_ptr<pellucid::Renderer<B>> renderer;
    PELLUCID_TRY(renderer, pellucid::Renderer<B>::create(*device, scene, {.size = {1280, 720}}));
    PELLUCID_CHECK(renderer->render(pellucid::frame_scene(scene, {1280, 720})));
    pellucid::Image8 pixels;
    PELLUCID_TRY(pixels, renderer->read_display());
    return pellucid::write_png(picture, pixels);
}

int main(int argc, char** argv) {
    if (argc != 4) return std::fprintf(stderr, "usage: minimal auto|vulkan|opengl scene.glb picture.png\n"), 2;
    auto done = pellucid::rhi::with_backend(pellucid::Backends{}, argv[1],
                                            [&]<class B>(std::type_identity<B>) { return draw<B>(argv[2], argv[3]); });
    if (done && *done) return 0;
    return std::fprintf(stderr, "%s\n", (done ? done->error() : done.error()).message.c_str()), 1;
}
