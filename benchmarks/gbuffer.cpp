// SPDX-License-Identifier: MIT
// What the G-buffer pass costs, in both layouts, against the time that moving its bytes takes, and how far what it
// stores is from the geometry, in double.
//
//     gbuffer [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N] [--bandwidth TB/s]
//             [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <numbers>
#include <pellucid/renderer/gpu_scene.hpp>
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
};

struct StoredErrors {
    ErrorSample normal;     ///< [degree]
    ErrorSample base;       ///< [1/255] sRGB codes
    ErrorSample roughness;  ///< absolute
    ErrorSample position;   ///< relative to the distance
    std::uint32_t edges = 0, wrong_coverage = 0;
};

/// Compares sampled pixels with the triangles themselves; pixels that an outline crosses are counted apart.
template <rhi::Backend B>
StoredErrors stored_errors(const GBufferSet<B>& set, const Scene& scene, std::uint32_t samples) {
    StoredErrors out;
    const RayScene rays(scene, bench_camera(), set.targets.size);
    for (const auto [x, y] : sample_pixels(set.targets.size, samples)) {
        if (!rays.inside_of_surfaces(x, y)) {
            ++out.edges;
            continue;
        }
        const std::vector<Hit> hits = rays.hits(x + 0.5, y + 0.5);
        const StoredPixel stored = stored_pixel(set, bench_camera(), x, y);
        out.wrong_coverage += stored.covered == hits.empty();
        if (!stored.covered || hits.empty()) continue;
        const reference::Surface<double> exact = surface_of(hits.front());
        // The chord keeps its digits where the cosine has lost them.
        out.normal.add(2 * std::asin(0.5 * glm::length(stored.surface.normal - exact.normal)) * 180 / std::numbers::pi);
        for (int c = 0; c < 3; ++c)
            out.base.add(base_code(set, x, y, c) - int{reference::srgb8_from_linear(exact.base_color[c])});
        out.roughness.add(stored.surface.roughness - exact.roughness);
        out.position.add(glm::length(stored.position - hits.front().position) / glm::length(hits.front().position));
    }
    return out;
}

/// Refuses what cannot be right.  Limits: the layouts' own quantisation, and what moving a vertex by 1/512 pixel, as
/// rasterisers do, turns the normals and shifts the depths of a picture of `height` rows.
Result<void> check(const StoredErrors& e, GBufferLayout layout, std::uint32_t height, const std::string& where) {
    const bool compact = layout == GBufferLayout::compact;
    const double row = 1.0 / height;
    const auto refuse = [&](const char* what, const ErrorSample& sample, double limit) -> Result<void> {
        if (sample.within(limit)) return {};
        return Error{Errc::internal, where + ": the " + what + " is off by up to " + significant(sample.max()) +
                                         " in " + std::to_string(sample.count()) + " values (" +
                                         std::to_string(sample.nonfinite()) + " not finite); the limit is " +
                                         significant(limit) + ": not timed"};
    };
    if (e.wrong_coverage > 0)
        return Error{Errc::internal,
                     where + ": " + std::to_string(e.wrong_coverage) +
                         " sampled pixels away from outlines are covered where nothing is, or the other "
                         "way round: not timed"};
    PELLUCID_CHECK(refuse("normal [degree]", e.normal, (compact ? 0.005 : 0.06) + 5 * row));
    PELLUCID_CHECK(refuse("base colour [1/255]", e.base, 1));
    PELLUCID_CHECK(refuse("roughness", e.roughness, compact ? 1.0 / 65535 : 1.0 / 255));
    return refuse("position, relative,", e.position, 0.04 * row);
}

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        const Extent2D size = settings.size;
        std::vector<Case> cases;
        cases.push_back({"quads", "1 layer", make_opaque_layers(size, 1, true)});
        cases.push_back({"quads", "4 layers, front to back", make_opaque_layers(size, 4, true)});
        cases.push_back({"quads", "4 layers, back to front", make_opaque_layers(size, 4, false)});
        cases.push_back({"100 spheres", "", make_sphere_field(settings.quick ? 8 : 32)});

        SpeedErrorTable table{.stem = "gbuffer", .baseline = "floor", .error = "normals [degree]"};
        PELLUCID_TRY(const CopyFloor<B> copy, CopyFloor<B>::create(device, settings));
        std::vector<Work<B>> works = {copy.work()};
        std::vector<GBufferSet<B>> sets;
        for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic}) {
            PELLUCID_TRY(auto set, GBufferSet<B>::create(device, layout, size));
            sets.push_back(std::move(set));
        }
        // Kept for a reader: normals are stored although no light falls on them.
        const RenderSettings render{.size = size, .default_light = false, .keep_gbuffer = true};
        std::vector<GpuScene<B>> scenes;
        std::vector<GBufferPass<B>> passes;
        scenes.reserve(cases.size());  // works point into both
        passes.reserve(cases.size() * sets.size());
        std::vector<double> floor_bytes;
        for (const Case& c : cases) {
            PELLUCID_TRY(auto made, GpuScene<B>::create(device, c.content, render));
            scenes.push_back(std::move(made));
            GpuScene<B>& scene = scenes.back();
            for (GBufferSet<B>& set : sets) {
                const std::string where = std::string(name(set.layout)) + ", " + c.scene + " " + c.setting;
                PELLUCID_TRY(auto pass, GBufferPass<B>::create(device, {.layout = set.layout,
                                                                        .needs = scene_needs(c.content, render).mask,
                                                                        .culls = scene.opaque_culls()}));
                passes.push_back(std::move(pass));
                const auto record = [&pass = passes.back(), &set, &scene](rhi::CommandsFor<B>& cmd) {
                    pass.record(cmd, set.targets, scene.binding(), scene.opaque());
                };
                const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                    PELLUCID_CHECK(scene.begin_frame(cmd, bench_camera(), render));
                    record(cmd);
                    return {};
                };
                PELLUCID_CHECK(run_frame<B>(device, once));
                PELLUCID_CHECK(set.read(device));
                const StoredErrors e = stored_errors(set, c.content, settings.quick ? 200 : 1000);
                PELLUCID_CHECK(check(e, set.layout, size.height, where));
                works.push_back({.name = where, .record = record, .repeats = settings.repeats});
                const double pixels = static_cast<double>(size.width) * size.height;
                floor_bytes.push_back(set.bytes_per_pixel * pixels);
                table.rows.push_back({.scene = c.scene,
                                      .method = name(set.layout),
                                      .setting = c.setting,
                                      .rmse = e.normal.rms(),
                                      .p999 = e.normal.p999(),
                                      .max_error = e.normal.max(),
                                      .bytes = static_cast<std::uint64_t>(set.bytes_per_pixel * pixels),
                                      .more = {{"base, max [1/255]", e.base.max()},
                                               {"roughness, max", e.roughness.max()},
                                               {"position, max relative", e.position.max()},
                                               {"pixels on outlines", static_cast<double>(e.edges)}}});
            }
        }
        PELLUCID_TRY(const RoundTimes times,
                     time_works<B>(device, settings, works, [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                         for (GpuScene<B>& scene : scenes)
                             PELLUCID_CHECK(scene.begin_frame(cmd, bench_camera(), render));
                         return {};
                     }));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            SpeedErrorRow& row = table.rows[i];
            row.milliseconds = summarise(times[i + 1]);
            row.ratio = summarise(ratios(times[i + 1], copy.floor(settings, times[0], floor_bytes[i]))).median;
            row.more.insert(row.more.begin(), {"us/Mpixel", microseconds_per_megapixel(row.milliseconds.median, size)});
        }
        table.notes = {copy.note(settings, times[0]),
                       "the floor counts each stored byte of a pixel once, whatever the overdraw: 16 B (compact), 36 B "
                       "(classic)"};
        return table;
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("gbuffer", argc, argv, Measure{});
}
