// SPDX-License-Identifier: MIT
// What sorted transparency costs against plain blending of constant colours over the same pixels, and how far it is
// from the exact composite in double: full-screen layers, whose order is known, and the demo scene, whose surfaces are
// sorted pixel by pixel on the CPU.
//
//     sorted_forward [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N]
//                    [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <pellucid/reference/lighting.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include "sorted_forward/plain_blend.hpp"
#include "support/error_sample.hpp"
#include "support/gbuffer_set.hpp"
#include "support/pass_program.hpp"
#include "support/rays.hpp"
#include "support/scenes.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

struct Case {
    std::string scene, setting;
    Scene content;
    Camera camera = bench_camera();
    std::uint32_t layers = 0;  ///< full-screen; 0: not layers
};

/// `count` translucent rectangles of different colours, the nearest first in draw order, so that sorting must turn it.
Scene make_translucent_layers(Extent2D size, std::uint32_t count, bool lit) {
    Scene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        add_object(scene, make_view_quad(size, 2.0 + 0.1 * i, 0.25, {0, 0}),
                   {.base_color = {0.2f + 0.8f * t, 1.0f - 0.7f * t, 0.5f + 0.5f * static_cast<float>(i % 2),
                                   0.1f + 0.3f * static_cast<float>(i % 4) / 3.0f},
                    .metallic = 0,
                    .roughness = 0.4f,
                    .alpha_mode = AlphaMode::blend,
                    .unlit = !lit});
    }
    if (lit) add_lights(scene, LightKind::point, 4);
    return scene;
}

struct Composite {
    ErrorSample scaled;
    double mean_layers = 0;
    std::uint32_t edges = 0;
};

/// Every surface of sampled pixels shaded in double, all in front of the opaque one composited nearest first; pixels
/// that an outline crosses are counted apart.
Composite composite_errors(const Case& c, const ImageF& hdr, const glm::vec3& background, std::uint32_t samples) {
    Composite out;
    const Extent2D size{hdr.width, hdr.height};
    const RayScene rays(c.content, c.camera, size);
    const std::vector<Light> lights = reference::lights_in_view(c.content.lights, c.camera);
    std::uint64_t layers = 0, pixels = 0;
    for (const auto [x, y] : sample_pixels(size, samples)) {
        if (!rays.inside_of_surfaces(x, y)) {
            ++out.edges;
            continue;
        }
        glm::dvec3 color(0);
        double through = 1;
        ++pixels;
        for (const Hit& hit : rays.hits(x + 0.5, y + 0.5)) {
            const Material& m = *hit.material;
            const double alpha = m.alpha_mode == AlphaMode::blend ? double{m.base_color.w} : 1.0;
            const glm::dvec3 radiance =
                m.unlit ? glm::dvec3(m.base_color)
                        : reference::surface_radiance(surface_of(hit), hit.position, glm::normalize(-hit.position),
                                                      lights, glm::dvec3(0));
            color += through * alpha * radiance;
            through *= 1 - alpha;
            layers += alpha < 1;
            if (alpha == 1) break;
        }
        color += through * glm::dvec3(background);
        for (int i = 0; i < 3; ++i) out.scaled.add_scaled(hdr.texel(x, y)[i], color[i]);
    }
    out.mean_layers = static_cast<double>(layers) / static_cast<double>(std::max<std::uint64_t>(1, pixels));
    return out;
}

/// One scene on the device: opaque surfaces lit, translucent ones sorted over them.
template <rhi::Backend B>
struct Drawn {
    GpuScene<B> scene;
    std::optional<GBufferPass<B>> fill;
    std::optional<LightingPass<B>> light;
    SortedForwardPass<B> sorted;
    rhi::Texture depth = {};  ///< of what is opaque
};

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        const Extent2D size = settings.size;
        const RenderSettings render{.size = size,
                                    .transparency = Transparency::sorted,
                                    .lighting = LightAssignment::loop,
                                    .default_light = false};
        SpeedErrorTable table{
            .stem = "sorted_forward", .baseline = "plain blending", .error = "radiance, scaled by max(1, reference)"};
        std::vector<Case> cases;
        for (const std::uint32_t layers : {8u, 32u}) {
            if (settings.quick && layers > 8) continue;
            const std::string setting = std::to_string(layers) + " layers";
            cases.push_back(
                {.scene = "unlit layers", .setting = setting, .content = make_translucent_layers(size, layers, false)});
            cases.back().layers = layers;
            cases.push_back({.scene = "layers, 4 lights",
                             .setting = setting,
                             .content = make_translucent_layers(size, layers, true)});
            cases.back().layers = layers;
        }
        cases.push_back({.scene = "demo scene, 8 lights", .setting = "", .content = make_demo_scene()});
        cases.back().camera = cases.back().content.cameras[0];

        PELLUCID_TRY(const auto hdr, make_target<B>(device, size, rhi::Format::rgba16_float, "hdr"));
        PELLUCID_TRY(const auto no_depth, make_target<B>(device, size, rhi::Format::d32_float, "no depth"));
        PELLUCID_TRY(auto set, GBufferSet<B>::create(device, GBufferLayout::compact, size));
        std::vector<Work<B>> works;
        std::vector<Drawn<B>> drawn;
        drawn.reserve(cases.size());  // works point into both
        std::vector<PlainBlend<B>> plain;
        plain.reserve(cases.size());

        // The background and an empty depth buffer: what the layers are drawn over.
        const auto clear = [&](rhi::CommandsFor<B>& cmd) {
            const glm::vec3 b = render.background;
            cmd.begin_render({.colors = {{.texture = hdr, .clear = {b.x, b.y, b.z, 1}}},
                              .depth = {.texture = no_depth},
                              .size = size,
                              .name = "clear"});
            cmd.end_render();
        };
        std::vector<double> full_layers;  // of each row: how many full-screen layers are as many fragments
        const auto add_row = [&](const Case& c, const std::string& method, Composite e) {
            full_layers.push_back(c.layers ? c.layers : e.mean_layers);
            table.rows.push_back(
                {.scene = c.scene,
                 .method = method,
                 .setting = c.setting,
                 .rmse = e.scaled.rms(),
                 .p999 = e.scaled.p999(),
                 .max_error = e.scaled.max(),
                 .bytes = std::uint64_t{12} * size.width * size.height,
                 .more = {{"layers a pixel", e.mean_layers}, {"pixels on outlines", static_cast<double>(e.edges)}}});
        };
        for (const Case& c : cases) {
            const std::uint32_t samples = settings.quick ? 100 : c.layers ? 400 : 2000;
            const SceneNeeds needs = scene_needs(c.content, render);
            PELLUCID_TRY(auto scene, GpuScene<B>::create(device, c.content, render));
            PELLUCID_TRY(auto sorted, SortedForwardPass<B>::create(
                                          device, {.needs = needs.mask, .culls = scene.translucent_culls()}));
            drawn.push_back({.scene = std::move(scene),
                             .fill = {},
                             .light = {},
                             .sorted = std::move(sorted),
                             .depth = needs.opaque ? set.targets.depth : no_depth.get()});
            Drawn<B>& d = drawn.back();
            if (needs.opaque) {
                PELLUCID_TRY(d.fill,
                             GBufferPass<B>::create(device, {.needs = needs.mask, .culls = d.scene.opaque_culls()}));
                PELLUCID_TRY(d.light, LightingPass<B>::create(device, {.needs = needs.mask}, set.targets, hdr));
            }
            const auto below = [&](rhi::CommandsFor<B>& cmd) {
                if (!d.fill) return clear(cmd);
                d.fill->record(cmd, set.targets, d.scene.binding(), d.scene.opaque());
                d.light->record(cmd, d.scene.binding());
            };
            const auto record = [&d, &hdr, size](rhi::CommandsFor<B>& cmd) {
                d.sorted.record(cmd, hdr, d.depth, size, d.scene.binding(), d.scene.translucent());
            };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(d.scene.begin_frame(cmd, c.camera, render));
                below(cmd);
                record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const ImageF image, read_hdr<B>(device, hdr, size));
            const Composite e = composite_errors(c, image, render.background, samples);
            // Each blend rounds the target toward zero by at most one step of binary16; the demo scene's cubes overlap,
            // which sorting by object does not resolve, so that only a rough match can be asked of it.
            const double limit = c.layers ? (c.layers + 2) / 1024.0 : 1.0;
            if (!e.scaled.within(limit) || (!c.layers && e.scaled.rms() > 0.1))
                return Error{Errc::internal,
                             c.scene + " " + c.setting + ": off by up to " + significant(e.scaled.max()) + ", RMSE " +
                                 significant(e.scaled.rms()) + " (" + std::to_string(e.scaled.nonfinite()) +
                                 " values not finite); the limit is " + significant(limit) + ": not timed"};
            works.push_back({.name = c.scene + " " + c.setting, .record = record});
            add_row(c, "sorted_forward", e);
            if (c.scene != "unlit layers") continue;

            PELLUCID_TRY(auto blend, PlainBlend<B>::create(device, c.content, hdr, no_depth, size));
            plain.push_back(std::move(blend));
            const auto blend_once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                clear(cmd);
                PELLUCID_CHECK(plain.back().begin_frame(cmd));
                plain.back().record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, blend_once));
            PELLUCID_TRY(const ImageF blended, read_hdr<B>(device, hdr, size));
            const Composite p = composite_errors(c, blended, render.background, samples);
            if (!p.scaled.within(limit))
                return Error{Errc::internal, "plain blending, " + c.setting + ": off by up to " +
                                                 significant(p.scaled.max()) + ": not timed"};
            works.push_back({.name = "plain blending " + c.setting,
                             .record = [&b = plain.back()](rhi::CommandsFor<B>& cmd) { b.record(cmd); }});
            add_row(c, "plain blending", p);
        }
        const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
            for (std::size_t i = 0; i < cases.size(); ++i)
                PELLUCID_CHECK(drawn[i].scene.begin_frame(cmd, cases[i].camera, render));
            for (PlainBlend<B>& p : plain) PELLUCID_CHECK(p.begin_frame(cmd));
            return {};
        };
        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            SpeedErrorRow& row = table.rows[i];
            row.milliseconds = summarise(times[i]);
            // Plain blending of eight layers stands for where there is no baseline of as many.
            std::size_t baseline = 0;
            for (std::size_t b = 0; b < table.rows.size(); ++b)
                if (table.rows[b].method == "plain blending" && (baseline == 0 || table.rows[b].setting == row.setting))
                    baseline = b;
            row.ratio = summarise(ratios(times[i], times[baseline])).median * full_layers[baseline] / full_layers[i];
            row.more.insert(row.more.begin(), {"us/Mpixel", microseconds_per_megapixel(row.milliseconds.median, size)});
        }
        return table;
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("sorted_forward", argc, argv, Measure{});
}
