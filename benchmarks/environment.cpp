// SPDX-License-Identifier: MIT
// What it takes to make a prefiltered cube map of a sunlit picture, once at load, and how far each of its levels is
// from the integral in double.
//
//     environment [--backend vulkan|opengl|both] [--device N|name] [--rounds N] [--clock auto|timestamps|wall]
//                 [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <pellucid/core/half.hpp>
#include <pellucid/passes/environment.hpp>
#include <pellucid/reference/cube_map.hpp>
#include <pellucid/rhi/readback.hpp>
#include <array>
#include "support/error_sample.hpp"
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

/// `[h, 2h, 3]` a gradient with a sun of 2 degrees, 3000 times as bright as the rest: what makes prefiltering hard.
ImageF sunlit_picture(std::uint32_t height) {
    ImageF out(2 * height, height, 3);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.6, -0.4));
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < 2 * height; ++x) {
            const glm::dvec3 d = reference::equirect_direction({(x + 0.5) / (2 * height), (y + 0.5) / height});
            const double disc = glm::dot(d, sun) > std::cos(0.0175) ? 2000.0 : 0.0;
            const glm::dvec3 sky = glm::mix(glm::dvec3(0.25, 0.2, 0.15), glm::dvec3(0.5, 0.7, 1.1), 0.5 * d.y + 0.5);
            for (int c = 0; c < 3; ++c) out.texel(x, y)[c] = static_cast<float>(sky[c] + disc);
        }
    return out;
}

/// Errors of texels of a level, relative to the mean of what they should be.
template <rhi::Backend B>
Result<ErrorSample> level_errors(rhi::DeviceFor<B>& device, const EnvironmentPass<B>& pass, const ImageF& picture,
                                 std::uint32_t size, std::uint32_t level) {
    const double roughness = environment_roughness(level, pass.levels()), alpha = roughness * roughness;
    const std::uint32_t side = size >> level, step = std::max(1u, side / 4);
    const rhi::TextureDesc desc{
        .size = {size, size}, .layers = 6, .mips = pass.levels(), .format = rhi::Format::rgba16_float};
    std::vector<double> off;
    double mean = 0;
    for (std::uint32_t face = 0; face < 6; ++face) {
        PELLUCID_TRY(const rhi::Texels texels, rhi::download<B>(device, pass.cube(), desc, level, face));
        for (std::uint32_t y = step / 2; y < side; y += step)
            for (std::uint32_t x = step / 2; x < side; x += step) {
                const glm::dvec3 axis = reference::cube_direction(face, (glm::dvec2(x, y) + 0.5) / double(side));
                const glm::dvec3 wanted = reference::prefiltered_radiance(picture, axis, alpha);
                const auto halves = texels.template at<std::array<std::uint16_t, 4>>(x, y);
                for (int c = 0; c < 3; ++c) {
                    off.push_back(half_to_float(halves[static_cast<std::size_t>(c)]) - wanted[c]);
                    mean += wanted[c];
                }
            }
    }
    mean /= static_cast<double>(off.size());
    ErrorSample out;
    for (const double o : off) out.add(o / mean);
    return out;
}

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        SpeedErrorTable table{.stem = "environment",
                              .baseline = "smallest",
                              .error = "prefiltered radiance, relative to the level's mean"};
        const ImageF picture = sunlit_picture(settings.quick ? 64 : 256);
        std::vector<Work<B>> works;
        std::vector<EnvironmentPass<B>> passes;
        passes.reserve(4);
        std::vector<std::size_t> first_row;
        for (const std::uint32_t size : {64u, 128u, 256u}) {
            if (size > (settings.software ? 64u : 256u)) continue;
            PELLUCID_TRY(auto made, EnvironmentPass<B>::create(device, picture, size));
            passes.push_back(std::move(made));
            const EnvironmentPass<B>& pass = passes.back();
            const auto record = [&pass](rhi::CommandsFor<B>& cmd) { pass.record(cmd); };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> { return record(cmd), Result<void>{}; };
            PELLUCID_CHECK(run_frame<B>(device, once));
            works.push_back({.name = std::to_string(size), .record = record});
            first_row.push_back(table.rows.size());
            for (std::uint32_t level = 1; level < pass.levels(); ++level) {
                const double roughness = environment_roughness(level, pass.levels());
                // Narrower lobes than texels of the picture are not what its integral is made for.
                if (roughness * roughness * picture.height < 3.2) continue;
                PELLUCID_TRY(const ErrorSample e, level_errors<B>(device, pass, picture, size, level));
                const bool narrow = roughness <= PELLUCID_ENVIRONMENT_NARROW;
                if (!e.within(narrow ? 4.0 : 1.0))
                    return Error{Errc::internal, "level " + std::to_string(level) + " of a cube of " +
                                                     std::to_string(size) + " is off by " + significant(e.max()) +
                                                     " of its mean: not timed"};
                table.rows.push_back({.scene = "sunlit sky",
                                      .method = std::to_string(size) + " a side",
                                      .setting = "roughness " + significant(roughness),
                                      .rmse = e.rms(),
                                      .p999 = e.p999(),
                                      .max_error = e.max(),
                                      .bytes = pass.bytes()});
            }
        }
        const auto begin = [](rhi::CommandsFor<B>&) -> Result<void> { return {}; };
        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));
        for (std::size_t p = 0; p < passes.size(); ++p)
            for (std::size_t r = first_row[p]; r < (p + 1 < passes.size() ? first_row[p + 1] : table.rows.size());
                 ++r) {
                table.rows[r].milliseconds = summarise(times[p]);
                table.rows[r].ratio = summarise(ratios(times[p], times[0])).median;
            }
        table.notes = {"a row's time is that of making the whole cube map: projection, levels, every lobe",
                       "the picture's sun is a disc of 2 degrees, 2000 times as bright as the sky round it"};
        return table;
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("environment", argc, argv, Measure{});
}
