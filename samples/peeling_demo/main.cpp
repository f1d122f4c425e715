// SPDX-License-Identifier: MIT
// peeling_demo: a translucent teapot, a pane and a sphere that cut each other, peeled layer by layer.  Draws in a
// window, or pictures of each layer.
#include "pictures.hpp"
#include "window.hpp"
#include <pellucid/scene/sample_scenes.hpp>

int main(int argc, char** argv) {
    using namespace pellucid;
    using namespace pellucid::samples;
    DemoOptions options{.size = {480, 360}};
    std::uint32_t layers = 6;
    CLI::App app{"A translucent teapot, a pane and a sphere, peeled layer by layer.", "peeling_demo"};
    add_demo_options(app, options);
    app.add_option("--layers", layers, "how many layers to write pictures of (6)")
        ->check(CLI::Range(1u, 99u))
        ->needs("--headless");
    std::uint32_t frames = 0;
    app.add_option("--frames", frames, "close the window after so many frames")
        ->check(CLI::Range(1u, 1000000u))
        ->excludes("--headless");
    if (const auto status = parse_command_line(app, argc, argv)) return *status;
    const Scene scene = make_peeling_scene();
    return run_demo(app.get_name(), options,
                    [&]<rhi::Backend B>(std::type_identity<B>, rhi::DeviceDesc desc) -> Result<void> {
                        if (!options.headless)
                            return show<B>({.title = "peeling_demo", .size = options.size}, desc, frames,
                                           [&](typename B::Device& device, Extent2D size) {
                                               return PeelingWindow<B>::create(device, scene, size);
                                           });
                        std::unique_ptr<typename B::Device> device;
                        PELLUCID_TRY(device, B::create(desc));
                        std::unique_ptr<PeelingStage<B>> stage;
                        PELLUCID_TRY(stage, PeelingStage<B>::create(*device, scene, options.size));
                        return write_layers<B>(*device, *stage, scene.cameras.front(), layers, options.out);
                    });
}
