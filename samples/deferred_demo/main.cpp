// SPDX-License-Identifier: MIT
// deferred_demo: 25 spheres over metallic and roughness under eight lights that go round them, and two translucent
// cubes.  Draws in a window, or a sequence of pictures.
#include "sequence.hpp"
#include "window.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::samples;

void add_transparency(CLI::App& app, Transparency& method) {
    std::map<std::string, Transparency> names;
    std::string list;
    for (const TransparencyTraits& m : all_transparencies) {
        names.emplace(m.name, m.method);
        list += (list.empty() ? "" : ", ") + std::string(m.name);
    }
    app.add_option("--transparency", method, "how the cubes are drawn: " + list + " (" + name(method) + ")")
        ->transform(CLI::CheckedTransformer(std::move(names)))
        ->option_text("NAME");
}

}  // namespace

int main(int argc, char** argv) {
    DemoOptions options;
    Sequence sequence;
    RenderSettings settings;
    CLI::App app{"Spheres of all materials under eight lights that move, and two translucent cubes.", "deferred_demo"};
    add_demo_options(app, options);
    add_transparency(app, settings.transparency);
    std::uint32_t frames = 0;
    app.add_option("--frames", frames, "pictures to write (30); in a window: frames to show (until it is closed)")
        ->check(CLI::Range(1u, 9999u));
    app.add_option("--step", sequence.step, "seconds from one picture to the next (1/30)")
        ->check(CLI::Range(0.0, 1e6))
        ->needs("--headless");
    if (const auto status = parse_command_line(app, argc, argv)) return *status;
    settings.size = options.size;
    sequence.folder = options.out;
    if (frames > 0) sequence.frames = frames;
    return run_demo(app.get_name(), options,
                    [&]<rhi::Backend B>(std::type_identity<B>, rhi::DeviceDesc desc) -> Result<void> {
                        if (!options.headless)
                            return show<B>({.title = "deferred_demo", .size = options.size}, desc, frames,
                                           [&](typename B::Device& device, Extent2D size) {
                                               settings.size = size;
                                               return DeferredWindow<B>::create(device, settings);
                                           });
                        std::unique_ptr<typename B::Device> device;
                        PELLUCID_TRY(device, B::create(desc));
                        PELLUCID_TRY(auto stage, DeferredStage<B>::create(*device, settings));
                        return write_sequence<B>(*device, stage, sequence);
                    });
}
