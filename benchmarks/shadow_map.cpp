// SPDX-License-Identifier: MIT
// What a frame takes with shadow maps against the same frame without, and how far it is from exact hard shadows (rays
// in double), by the size of a map.
//
//     shadow_map [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N]
//                [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Frames are timed by the clock around record, submit and wait, whatever --clock says.
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <pellucid/measure/image_error.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

struct Case {
    std::string scene;
    Scene content;
    reference::Picture exact;
};

/// Pixels that are more than a hundredth off, of those that are stable.
double share_off(const ImageF& test, const reference::Picture& exact) {
    std::size_t off = 0, stable = 0;
    for (std::uint32_t y = 0; y < test.height; ++y)
        for (std::uint32_t x = 0; x < test.width; ++x) {
            if (*exact.stable.texel(x, y) != 255) continue;
            ++stable;
            bool wrong = false;
            for (int c = 0; c < 3; ++c) {
                const float r = exact.radiance.texel(x, y)[c];
                wrong = wrong || std::abs(test.texel(x, y)[c] - r) > 0.01f * std::max(1.0f, r);
            }
            off += wrong;
        }
    return static_cast<double>(off) / static_cast<double>(std::max<std::size_t>(1, stable));
}

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        SpeedErrorTable table{.stem = "shadow_map",
                              .baseline = "the frame without shadows",
                              .error = "radiance against exact hard shadows, scaled by max(1, reference)"};
        table.notes = {"a frame moves the camera, so that cascades are drawn again; \"held\" does not",
                       "maps of point lights and spots are drawn once, in the first frame; no translucent surfaces"};
        std::vector<Case> cases{{.scene = "demo scene, a sun", .content = make_demo_scene(), .exact = {}},
                                {.scene = "demo scene, 8 lights", .content = make_demo_scene(), .exact = {}}};
        cases[0].content.lights = {{.kind = LightKind::directional,
                                    .intensity = 3,
                                    .direction = glm::normalize(glm::dvec3(-0.5, -1.0, -0.6))}};
        for (Case& c : cases) {
            PELLUCID_TRY(c.exact, reference::render(c.content, c.content.cameras.front(),
                                                    {.size = settings.size,
                                                     .lights = c.content.lights,
                                                     .shadows = true,
                                                     .translucent = false,
                                                     .stability = true}));
            double without = 0;
            for (const std::uint32_t size : {0u, 256u, 512u, 1024u, 2048u}) {
                if (settings.quick && size > 256) break;
                const std::uint64_t bytes = std::uint64_t{4} * size * size * (c.content.lights.size() == 1 ? 4 : 48);
                if (settings.software && bytes > (std::uint64_t{1} << 28u)) break;
                PELLUCID_TRY(SpeedErrorRow row, judge_and_time<B>(device, settings, c, size));
                if (size == 0) without = row.milliseconds.median;
                row.ratio = row.milliseconds.median / without;
                table.rows.push_back(row);
            }
            // Finer maps are nearer to the truth, and any are nearer than none.
            const std::size_t of_case = table.rows.size();
            const auto first = std::find_if(table.rows.begin(), table.rows.end(),
                                            [&](const SpeedErrorRow& r) { return r.scene == c.scene; });
            if (of_case >= 2 && table.rows.back().more[0].value >= first->more[0].value)
                return Error{Errc::internal, c.scene + ": " + significant(table.rows.back().more[0].value) +
                                                 " % of the pixels are off with shadow maps and " +
                                                 significant(first->more[0].value) + " % without"};
        }
        return table;
    }

    template <rhi::Backend B>
    static Result<SpeedErrorRow> judge_and_time(rhi::DeviceFor<B>& device, const PassSettings& settings, const Case& c,
                                                std::uint32_t size) {
        RenderSettings how{
            .size = settings.size, .transparency = Transparency::none, .background = {0, 0, 0}, .default_light = false};
        if (size != 0) how.shadows = Shadows::map, how.shadow_size = size;
        PELLUCID_TRY(const auto renderer, Renderer<B>::create(device, c.content, how));
        const Camera still = c.content.cameras.front();
        Camera camera = still;
        const auto frame = [&]() -> Result<double> {
            const double start = now_ns();
            rhi::Ticket ticket{};
            PELLUCID_TRY(ticket, renderer->render(camera));
            PELLUCID_CHECK(device.wait(ticket));
            return 1e-6 * (now_ns() - start);
        };
        PELLUCID_CHECK(frame());
        PELLUCID_TRY(const ImageF hdr, renderer->read_hdr());
        ImageF rgb(hdr.width, hdr.height, 3);
        for (std::size_t i = 0; i < rgb.data.size() / 3; ++i)
            std::copy_n(hdr.data.data() + 4 * i, 3, rgb.data.data() + 3 * i);
        PELLUCID_TRY(const measure::ImageError error,
                     measure::image_error(rgb, c.exact.radiance,
                                          {.scale = measure::ErrorScale::scaled, .mask = &c.exact.stable}));
        // The reference took seconds, in which a GPU lowers its clocks: a few frames do not bring them back.
        const double ready = now_ns() + (settings.software ? 0 : 5e8);
        do {
            PELLUCID_CHECK(frame());
        } while (now_ns() < ready);
        std::vector<double> moving, held;
        for (std::uint32_t i = 0; i < settings.rounds + settings.warm_up; ++i) {
            camera = still;
            camera.world_from_view[3] += glm::dvec4(i % 2 == 0 ? 0.5 : -0.5, 0, 0, 0);
            PELLUCID_TRY(const double a, frame());
            PELLUCID_TRY(const double b, frame());
            if (i < settings.warm_up) continue;
            moving.push_back(a);
            held.push_back(b);
        }
        const RenderStats stats = renderer->stats();
        std::uint64_t bytes = 0;
        for (const TextureReport& r : stats.resources)
            if (std::string(r.name) == "scene.shadow_maps" || std::string(r.name) == "scene.shadows") bytes += r.bytes;
        return SpeedErrorRow{.scene = c.scene,
                             .method = size == 0 ? "none" : "map",
                             .setting = size == 0 ? "" : std::to_string(size),
                             .milliseconds = summarise(moving),
                             .rmse = error.rmse,
                             .p999 = error.p999,
                             .max_error = error.max,
                             .bytes = bytes,
                             .more = {{"pixels off by 1 % [%]", 100 * share_off(rgb, c.exact)},
                                      {"held [ms]", summarise(held).median},
                                      {"maps", static_cast<double>(stats.shadow_maps)}}};
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("shadow_map", argc, argv, Measure{});
}
