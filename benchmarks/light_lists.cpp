// SPDX-License-Identifier: MIT
// What it costs to find the lights of each pixel and to add them, with 100 to 10,000 lights of which four reach a point
// on average: the loop, volumes, tiled and clustered lists, each judged by the same formulae in double first.
//
//     light_lists [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N] [--bandwidth TB/s]
//                 [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <pellucid/passes/light_volumes.hpp>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/scene/light_field.hpp>
#include <cstring>
#include "lighting/radiance_errors.hpp"
#include "support/gbuffer_set.hpp"
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

constexpr LightAssignment methods[] = {LightAssignment::loop, LightAssignment::volumes, LightAssignment::tiled,
                                       LightAssignment::clustered};

/// One method on one field of lights: its passes, and what they need.
template <rhi::Backend B>
struct Method {
    LightAssignment assignment = LightAssignment::loop;
    RenderSettings settings;
    SceneNeeds needs;
    std::optional<GpuScene<B>> scene;
    std::optional<LightListsPass<B>> lists;
    std::optional<LightingPass<B>> lighting;
    std::optional<LightVolumesPass<B>> volumes;

    [[nodiscard]] static Result<std::unique_ptr<Method>> create(rhi::DeviceFor<B>& device, const Scene& field,
                                                                LightAssignment assignment, Extent2D size,
                                                                const GBufferTargets& gbuffer, rhi::Texture hdr) {
        auto out = std::make_unique<Method>();
        out->assignment = assignment;
        out->settings = {
            .size = size, .transparency = Transparency::none, .lighting = assignment, .default_light = false};
        out->needs = scene_needs(field, out->settings);
        PELLUCID_TRY(out->scene, GpuScene<B>::create(device, field, out->settings));
        const LightingDesc desc{.needs = out->needs.mask};
        const GpuLights<B>& lights = out->scene->lights();
        if (!out->needs.grid.empty()) {
            PELLUCID_TRY(out->lists, LightListsPass<B>::create(device, out->needs.grid, lights.bounds(), lights.lists(),
                                                               gbuffer.depth));
        }
        PELLUCID_TRY(out->lighting, LightingPass<B>::create(device, desc, gbuffer, hdr));
        if (assignment == LightAssignment::volumes) {
            PELLUCID_TRY(out->volumes, LightVolumesPass<B>::create(device, desc, gbuffer, hdr, lights.sources(),
                                                                   lights.first_ranged()));
        }
        return out;
    }
    void record(rhi::CommandsFor<B>& cmd) const {
        if (lists) lists->record(cmd, scene->binding());
        lighting->record(cmd, scene->binding());
        if (volumes) volumes->record(cmd, scene->binding());
    }
};

struct Field {
    std::uint32_t lights = 0;
    Scene scene = {};
};

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        const Extent2D size = settings.size;
        const double pixels = static_cast<double>(size.width) * size.height;
        SpeedErrorTable table{
            .stem = "light_lists", .baseline = "floor", .error = "radiance, scaled by max(1, reference)"};
        std::vector<Field> fields;
        for (const std::uint32_t count : {100u, 1000u, 10000u})
            if (!(settings.quick && count > 100) && !(settings.software && count > 1000))
                fields.push_back({.lights = count, .scene = make_light_field({.lights = count, .panes = false})});
        const Camera camera = fields.front().scene.cameras.front();

        // The surfaces are the same whatever the lights.
        PELLUCID_TRY(const auto hdr, make_target<B>(device, size, rhi::Format::rgba16_float, "hdr"));
        PELLUCID_TRY(auto gbuffer, GBufferSet<B>::create(device, GBufferLayout::compact, size));
        std::vector<std::unique_ptr<Method<B>>> made;
        std::vector<const Field*> field_of;
        for (const Field& field : fields)
            for (const LightAssignment assignment : methods) {
                // On software drivers a loop over very many lights says nothing that a loop over fewer does not.
                if (settings.software && assignment == LightAssignment::loop && field.lights > 100) continue;
                PELLUCID_TRY(auto method,
                             Method<B>::create(device, field.scene, assignment, size, gbuffer.targets, hdr));
                made.push_back(std::move(method));
                field_of.push_back(&field);
            }
        const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
            for (const auto& method : made) PELLUCID_CHECK(method->scene->begin_frame(cmd, camera, method->settings));
            return {};
        };
        {
            const GpuScene<B>& any = *made.front()->scene;
            PELLUCID_TRY(const auto fill, GBufferPass<B>::create(device, {.needs = made.front()->needs.mask,
                                                                          .culls = any.opaque_culls()}));
            const auto record = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                fill.record(cmd, gbuffer.targets, any.binding(), any.opaque());
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, record));
            PELLUCID_CHECK(gbuffer.read(device));
        }

        PELLUCID_TRY(const CopyFloor<B> copy, CopyFloor<B>::create(device, settings));
        std::vector<Work<B>> works = {copy.work()};
        ImageF first;  // of the field: the picture that lists must give bit for bit
        for (std::size_t i = 0; i < made.size(); ++i) {
            const Method<B>& method = *made[i];
            const std::string setting = std::to_string(field_of[i]->lights) + " lights";
            const std::string where = std::string(name(method.assignment)) + ", " + setting;
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                method.record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const ImageF image, read_hdr<B>(device, hdr, size));
            PELLUCID_TRY(SpeedErrorRow row,
                         judge(gbuffer, image, *field_of[i], camera, where, settings.quick ? 100 : 500));
            const bool has_lists = method.lists.has_value();
            std::size_t different = 0;
            const bool same_field = i > 0 && field_of[i] == field_of[i - 1];
            if (same_field && has_lists && first.width != 0) {
                for (std::size_t k = 0; k < image.data.size(); ++k)
                    different += std::memcmp(&image.data[k], &first.data[k], 4) != 0;
                if (different != 0)
                    return Error{Errc::internal, where + ": " + std::to_string(different) +
                                                     " values are not those of the first method: not timed"};
            }
            if (!same_field) first = {};
            if (method.assignment == LightAssignment::loop || (has_lists && first.width == 0)) first = image;
            row.method = name(method.assignment);
            row.setting = setting;
            method.scene->lights().each_resource([&](const char*, std::uint64_t bytes) { row.bytes += bytes; });
            if (method.volumes)
                method.volumes->each_resource([&](const char*, std::uint64_t bytes) { row.bytes += bytes; });
            table.rows.push_back(row);
            works.push_back({.name = where, .record = [&method](rhi::CommandsFor<B>& cmd) { method.record(cmd); }});
            if (has_lists)
                works.push_back({.name = where + ", lists", .record = [&method](rhi::CommandsFor<B>& cmd) {
                                     method.lists->record(cmd, method.scene->binding());
                                 }});
        }

        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));
        const double moved = (gbuffer.bytes_per_pixel + 8) * pixels;
        const auto row_of = [&](LightAssignment method, const Field* field) -> SpeedErrorRow* {
            for (std::size_t i = 0; i < made.size(); ++i)
                if (made[i]->assignment == method && field_of[i] == field) return &table.rows[i];
            return nullptr;
        };
        for (std::size_t i = 0, w = 1; i < made.size(); ++i) {
            SpeedErrorRow& row = table.rows[i];
            row.milliseconds = summarise(times[w]);
            row.ratio = summarise(ratios(times[w], copy.floor(settings, times[0], moved))).median;
            row.more.push_back({"ns/pixel", row.milliseconds.median * 1e6 / pixels});
            if (const SpeedErrorRow* least = row_of(made[i]->assignment, &fields.front()))
                row.more.push_back({"x its time with 100", row.milliseconds.median / least->milliseconds.median});
            ++w;
            if (made[i]->lists) row.more.push_back({"lists alone [ms]", summarise(times[w++]).median});
        }
        table.notes = {
            copy.note(settings, times[0]),
            "the floor counts the G-buffer read once and 8 B written (24 B a pixel); times are of finding the "
            "lights and adding them; the picture of lists is that of the loop, bit for bit, before it is timed",
            "rounding to binary16 is part of the error (up to 9.8e-4 of the value; volumes round twice)"};
        return table;
    }

private:
    /// The picture against the formulae, on the surfaces that the G-buffer stores.
    template <rhi::Backend B>
    static Result<SpeedErrorRow> judge(const GBufferSet<B>& gbuffer, const ImageF& image, const Field& field,
                                       const Camera& camera, const std::string& where, std::uint32_t samples) {
        const std::vector<Light> lights = reference::lights_in_view(field.scene.lights, camera);
        RadianceErrors errors;
        std::size_t covered = 0, reaching = 0;
        for (const auto [x, y] : sample_pixels(gbuffer.targets.size, samples)) {
            const StoredPixel pixel = stored_pixel(gbuffer, camera, x, y);
            if (!pixel.covered) continue;
            ++covered;
            for (const Light& light : lights) {
                const glm::dvec3 e = reference::sample_light(light, pixel.position).illuminance;
                reaching += e.x + e.y + e.z > 0;
            }
            errors.add(image.texel(x, y),
                       reference::surface_radiance(pixel.surface, pixel.position, glm::normalize(-pixel.position),
                                                   lights, glm::dvec3(0)));
        }
        constexpr double limit = 3.0 / 1024;  // two roundings to binary16, and arithmetic
        if (!errors.scaled.within(limit))
            return Error{Errc::internal, where + ": the radiance is off by up to " + significant(errors.scaled.max()) +
                                             " in " + std::to_string(errors.scaled.count()) + " values; the limit is " +
                                             significant(limit) + ": not timed"};
        return SpeedErrorRow{.scene = "light field",
                             .rmse = errors.scaled.rms(),
                             .p999 = errors.scaled.p999(),
                             .max_error = errors.scaled.max(),
                             .more = {{"lights a pixel", static_cast<double>(reaching) /
                                                             static_cast<double>(std::max<std::size_t>(1, covered))}}};
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("light_lists", argc, argv, Measure{});
}
