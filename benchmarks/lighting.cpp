// SPDX-License-Identifier: MIT
// What the lighting pass costs when every pixel is covered and every light reaches every pixel, against the time that
// moving its bytes takes and against a raw loop of the same arithmetic; and how far its radiance is from the same
// formulae in double, on the surfaces that the G-buffer stores.
//
//     lighting [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N] [--bandwidth TB/s]
//              [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include "lighting/fetch_floor.hpp"
#include "lighting/raw_loop.hpp"
#include "support/gbuffer_set.hpp"
#include "support/pass_program.hpp"
#include "support/scenes.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

struct Variant {
    GBufferLayout layout = GBufferLayout::compact;
    ShadingStage stage = ShadingStage::compute;
    Brdf brdf = Brdf::gltf;
    bool exact = false;
    std::size_t scene = 0;  ///< index into the scenes
};

struct LitScene {
    LightKind kind = LightKind::point;
    std::uint32_t lights = 1;
    Scene content = {};
};

reference::BrdfModel model_of(Brdf brdf) {
    return brdf == Brdf::gltf ? reference::BrdfModel::gltf : reference::BrdfModel::seed;
}

std::string setting_of(const LitScene& scene) {
    return std::to_string(scene.lights) + (scene.kind == LightKind::point ? " point" : " directional");
}

/// All counts where the comparison is about the number of lights, 16 lights where it is about something else.
std::vector<Variant> variants(const std::vector<LitScene>& scenes) {
    std::vector<Variant> out;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        const bool middle = scenes[s].lights == 16, point = scenes[s].kind == LightKind::point;
        for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
            for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
                const bool main_path = layout == GBufferLayout::compact && stage == ShadingStage::compute;
                if (!point && !main_path) continue;
                out.push_back({.layout = layout, .stage = stage, .scene = s});
                if (main_path || middle) {
                    out.push_back({.layout = layout, .stage = stage, .exact = true, .scene = s});
                    out.push_back({.layout = layout, .stage = stage, .brdf = Brdf::seed, .scene = s});
                }
            }
    }
    return out;
}

/// The lighting pass on the surfaces that the G-buffer stores.
template <rhi::Backend B>
RadianceErrors radiance_errors(const GBufferSet<B>& set, const ImageF& hdr, const Scene& scene, Brdf brdf,
                               std::uint32_t samples) {
    RadianceErrors out;
    for (const auto [x, y] : sample_pixels(set.targets.size, samples)) {
        const StoredPixel pixel = stored_pixel(set, bench_camera(), x, y);
        if (!pixel.covered) {
            out.scaled.add(NAN);
            continue;
        }
        for (const Light& light : scene.lights)
            out.below_horizon +=
                !(glm::dot(pixel.surface.normal, reference::sample_light(light, pixel.position).to_light) > 0);
        const glm::dvec3 expected =
            reference::surface_radiance(pixel.surface, pixel.position, glm::normalize(-pixel.position), scene.lights,
                                        glm::dvec3(0), model_of(brdf));
        out.add(hdr.texel(x, y), expected);
    }
    return out;
}

Result<void> check(const RadianceErrors& e, const std::string& where) {
    // One step of binary16 is 2^-10 of the value; float arithmetic takes far less than that again.
    constexpr double limit = 2.0 / 1024;
    if (e.below_horizon > 0)
        return Error{Errc::internal, where + ": " + std::to_string(e.below_horizon) +
                                         " lights are below the horizon of a sampled pixel, so the count is not that "
                                         "of the work: not timed"};
    if (e.scaled.within(limit)) return {};
    return Error{Errc::internal, where + ": the radiance is off by up to " + significant(e.scaled.max()) + " in " +
                                     std::to_string(e.scaled.count()) + " values (" +
                                     std::to_string(e.scaled.nonfinite()) +
                                     " not finite or not covered); the limit is " + significant(limit) + ": not timed"};
}

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        const Extent2D size = settings.size;
        const double pixels = static_cast<double>(size.width) * size.height;
        const std::uint32_t samples = settings.quick ? 100 : 500;
        const RenderSettings render{.size = size, .lighting = LightAssignment::loop, .default_light = false};
        SpeedErrorTable table{
            .stem = "lighting", .baseline = "floor", .error = "radiance, scaled by max(1, reference)"};

        std::vector<LitScene> scenes;
        for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 16u, 64u, 256u})
            if (!settings.quick || count == 4 || count == 16) scenes.push_back({LightKind::point, count});
        scenes.push_back({LightKind::directional, 16});
        std::vector<GpuScene<B>> uploaded;
        uploaded.reserve(scenes.size());  // works point into it
        for (LitScene& s : scenes) {
            add_object(s.content, make_view_quad(size, raw_surface.distance, raw_surface.lean, {0, 0}),
                       {.base_color = glm::vec4(glm::vec3(raw_surface.base), 1),
                        .metallic = static_cast<float>(raw_surface.metallic),
                        .roughness = static_cast<float>(raw_surface.roughness)});
            add_lights(s.content, s.kind, s.lights);
            PELLUCID_TRY(auto made, GpuScene<B>::create(device, s.content, render));
            uploaded.push_back(std::move(made));
        }
        const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
            for (GpuScene<B>& scene : uploaded) PELLUCID_CHECK(scene.begin_frame(cmd, bench_camera(), render));
            return {};
        };

        PELLUCID_TRY(const auto hdr, make_target<B>(device, size, rhi::Format::rgba16_float, "hdr"));
        std::vector<GBufferSet<B>> sets;
        for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic}) {
            PELLUCID_TRY(auto set, GBufferSet<B>::create(device, layout, size));
            PELLUCID_TRY(const auto fill, GBufferPass<B>::create(device, {.layout = layout, .needs = 0}));
            const auto record = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                fill.record(cmd, set.targets, uploaded[0].binding(), uploaded[0].opaque());
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, record));
            PELLUCID_CHECK(set.read(device));
            sets.push_back(std::move(set));
        }

        PELLUCID_TRY(const CopyFloor<B> copy, CopyFloor<B>::create(device, settings));
        std::vector<Work<B>> works = {copy.work()};
        std::vector<double> moved;         // [byte] of each row
        std::vector<std::size_t> raw_row;  // of each row: that of the raw loop with as many lights, or its own
        const auto add = [&](const LitScene& lit, const std::string& method, const RadianceErrors& e, double bytes,
                             std::function<void(rhi::CommandsFor<B>&)> record, std::uint32_t repeats) -> Result<void> {
            const std::string where = method + ", " + setting_of(lit);
            PELLUCID_CHECK(check(e, where));
            works.push_back({.name = where, .record = std::move(record), .repeats = repeats});
            moved.push_back(bytes * pixels);
            raw_row.push_back(table.rows.size());
            for (std::size_t r = 0; r < table.rows.size(); ++r)
                if (table.rows[r].method == raw_forms[0].name && table.rows[r].setting == setting_of(lit))
                    raw_row.back() = r;
            table.rows.push_back({.scene = "lights",
                                  .method = method,
                                  .setting = setting_of(lit),
                                  .rmse = e.scaled.rms(),
                                  .p999 = e.scaled.p999(),
                                  .max_error = e.scaled.max(),
                                  .bytes = static_cast<std::uint64_t>(moved.back()),
                                  .more = {{"off the reference's code [%]", 100 * e.off_code()}}});
            return {};
        };
        std::vector<RawLoop<B>> raw;
        raw.reserve(scenes.size() * std::size(raw_forms));
        for (const RawForm& form : raw_forms)
            for (const LitScene& lit : scenes) {
                if (lit.lights == 0 || lit.kind != LightKind::point ||
                    (form.form + form.storage != 0 && lit.lights < 16))
                    continue;
                PELLUCID_TRY(auto made, RawLoop<B>::create(device, size, form, lit.content.lights, hdr));
                raw.push_back(std::move(made));
                const auto record = [&loop = raw.back()](rhi::CommandsFor<B>& cmd) { loop.record(cmd); };
                const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> { return record(cmd), Result<void>{}; };
                PELLUCID_CHECK(run_frame<B>(device, once));
                PELLUCID_TRY(const ImageF image, read_hdr<B>(device, hdr, size));
                const RadianceErrors e = raw_errors(image, lit.content.lights, samples);
                PELLUCID_CHECK(add(lit, form.name, e, 8, record, lit.lights > 16 ? 1 : settings.repeats));
            }

        PELLUCID_TRY(const FetchFloor<B> fetch, FetchFloor<B>::create(device, sets[0].targets, hdr));
        {
            const auto record = [&](rhi::CommandsFor<B>& cmd) { fetch.record(cmd); };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> { return record(cmd), Result<void>{}; };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const ImageF image, read_hdr<B>(device, hdr, size));
            PELLUCID_CHECK(add({.lights = 0}, "compact, read and nothing lit", fetch_errors(sets[0], image, samples),
                               sets[0].bytes_per_pixel + 8, record, settings.repeats));
        }

        const std::vector<Variant> chosen = variants(scenes);
        std::vector<LightingPass<B>> passes;
        passes.reserve(chosen.size());
        for (const Variant& v : chosen) {
            const LitScene& lit = scenes[v.scene];
            const GBufferSet<B>& set = sets[v.layout == GBufferLayout::compact ? 0 : 1];
            const std::string method =
                std::string(name(v.layout)) + " " + name(v.stage) + " " + name(v.brdf) + (v.exact ? " exact" : "");
            PELLUCID_TRY(auto pass, LightingPass<B>::create(device,
                                                            {.layout = v.layout,
                                                             .stage = v.stage,
                                                             .brdf = v.brdf,
                                                             .needs = scene_needs(lit.content, render).mask,
                                                             .exact = v.exact},
                                                            set.targets, hdr));
            passes.push_back(std::move(pass));
            const auto record = [&pass = passes.back(), &scene = uploaded[v.scene]](rhi::CommandsFor<B>& cmd) {
                pass.record(cmd, scene.binding());
            };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const ImageF image, read_hdr<B>(device, hdr, size));
            const RadianceErrors e = radiance_errors(set, image, lit.content, v.brdf, samples);
            const bool slow = v.stage == ShadingStage::fragment || lit.lights > 16;
            PELLUCID_CHECK(add(lit, method, e, set.bytes_per_pixel + 8, record, slow ? 1 : settings.repeats));
        }

        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            SpeedErrorRow& row = table.rows[i];
            const std::vector<double>& ms = times[i + 1];
            row.milliseconds = summarise(ms);
            row.ratio = summarise(ratios(ms, copy.floor(settings, times[0], moved[i]))).median;
            row.more.insert(row.more.begin(), {"us/Mpixel", microseconds_per_megapixel(row.milliseconds.median, size)});
            if (raw_row[i] != i || row.method == raw_forms[0].name)
                row.more.push_back({"x raw loop", summarise(ratios(ms, times[raw_row[i] + 1])).median});
        }
        table.notes = {copy.note(settings, times[0]),
                       "the floor counts the G-buffer read once and 8 B written: 24 B (compact), 44 B (classic), 8 B "
                       "(raw loop)",
                       "raw loop: the same arithmetic in compute with the surface from the pixel's coordinates and "
                       "lights from a uniform block; every light is above the horizon of every pixel",
                       "rounding to binary16 is part of the error (up to 9.8e-4 of the value)"};
        return table;
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("lighting", argc, argv, Measure{});
}
