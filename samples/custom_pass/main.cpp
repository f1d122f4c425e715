// SPDX-License-Identifier: MIT
// Step 4 of 4: the renderer draws, and the pass of one's own reads what it drew.
#include "edges.hpp"
#include <pellucid/pellucid.hpp>
#include <pellucid/rhi/readback.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <cstdio>

using namespace pellucid;

template <rhi::Backend B>
Result<void> draw(const Scene& scene, const char* file) {
    constexpr Extent2D size{1280, 720};
    std::unique_ptr<typename B::Device> device;
    PELLUCID_TRY(device, B::create({}));
    // The G-buffer outlives the frame only where it is asked for.
    std::unique_ptr<Renderer<B>> renderer;
    PELLUCID_TRY(renderer, Renderer<B>::create(*device, scene, {.size = size, .keep_gbuffer = true}));
    if (!renderer->gbuffer().depth) return Error{Errc::invalid_argument, "nothing of the scene is opaque: no depth"};
    PELLUCID_TRY(auto edges,
                 samples::EdgesPass<B>::create(*device, renderer->display(), renderer->gbuffer().depth, size));

    PELLUCID_CHECK(renderer->render(scene.cameras.empty() ? frame_scene(scene, size) : scene.cameras.front()));
    // A frame of one's own, behind the renderer's: work runs in the order in which it is submitted.
    typename B::Commands* commands = nullptr;
    PELLUCID_TRY(commands, device->begin_frame());
    edges.record(*commands, {.line = {1, 1, 1, 0.9f}});
    PELLUCID_CHECK(device->submit());

    PELLUCID_TRY(const Image8 picture,
                 rhi::download_image<B, std::uint8_t>(*device, edges.target(), size, rhi::Format::rgba8_unorm));
    return write_png(file, picture);
}

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4)
        return std::fprintf(stderr, "usage: custom_pass auto|vulkan|opengl picture.png [scene.glb]\n"), 2;
    const Result<Scene> scene = argc == 4 ? load_gltf(argv[3]) : make_demo_scene();
    if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 1;
    const auto done = rhi::with_backend(
        Backends{}, argv[1], [&]<rhi::Backend B>(std::type_identity<B>) { return draw<B>(*scene, argv[2]); });
    if (done && *done) return 0;
    return std::fprintf(stderr, "%s\n", (done ? done->error() : done.error()).message.c_str()), 1;
}
