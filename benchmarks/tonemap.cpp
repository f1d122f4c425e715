// SPDX-License-Identifier: MIT
// What the tone-mapping pass costs for each curve against the time that moving its bytes takes, and how many of its
// 8-bit codes are not those of the curve in double.
//
//     tonemap [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N] [--bandwidth TB/s]
//             [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <pellucid/gpu/scene.h>
#include <pellucid/core/half.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/reference/tonemap.hpp>
#include <pellucid/rhi/readback.hpp>
#include "support/error_sample.hpp"
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

constexpr ToneCurve curves[] = {ToneCurve::none, ToneCurve::reinhard, ToneCurve::neutral, ToneCurve::aces,
                                ToneCurve::agx};

/// Radiance as binary16 RGBA: colours of every kind over 20 stops, black, and what a broken pixel may hold.
std::vector<std::uint16_t> test_radiance(Extent2D size) {
    std::vector<std::uint16_t> out(std::size_t{size.width} * size.height * 4);
    std::uint32_t state = 1;
    const auto random = [&] {  // a linear congruential generator (Numerical Recipes), upper 24 bits
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8u) * 0x1p-24f;
    };
    constexpr std::uint16_t special[] = {0x0000, 0x8000, 0x7C00, 0xFC00, 0x7E00, 0x7BFF, 0xC000, 0x0001};
    for (std::size_t i = 0; i < out.size(); i += 4) {
        const float level = std::exp2(20.0f * random() - 13.0f);
        for (std::size_t c = 0; c < 3; ++c)
            out[i + c] = i / 4 % 64 == 7 ? special[(i / 256 + 3 * c) % 8] : half_toward_zero(level * random());
        out[i + 3] = 0x3C00;
    }
    return out;
}

struct CodeErrors {
    ErrorSample codes;     ///< [1/255]
    double off_share = 0;  ///< of codes that are not the reference's
};

CodeErrors code_errors(const rhi::Texels& display, const std::vector<std::uint16_t>& radiance, ToneCurve curve,
                       std::uint32_t samples) {
    CodeErrors out;
    std::size_t off = 0;
    const auto operation = static_cast<reference::ToneMap>(curve);
    const auto check_pixel = [&](std::uint32_t x, std::uint32_t y) {
        const std::size_t at = (std::size_t{y} * display.size.width + x) * 4;
        const glm::dvec3 color(half_to_float(radiance[at]), half_to_float(radiance[at + 1]),
                               half_to_float(radiance[at + 2]));
        const glm::dvec3 mapped = reference::tone_map(operation, 0.0, color);
        for (int c = 0; c < 3; ++c) {
            const int code = std::to_integer<int>(display.bytes[at + static_cast<std::size_t>(c)]);
            const int expected = reference::srgb8_from_linear(mapped[c]);
            out.codes.add(code - expected);
            off += code != expected;
        }
    };
    for (const auto [x, y] : sample_pixels(display.size, samples)) check_pixel(x, y);
    const std::uint32_t pixels = display.size.width * display.size.height;
    for (std::uint32_t i = 7; i < std::min(pixels, 64u * 64u); i += 64)  // the broken ones
        check_pixel(i % display.size.width, i / display.size.width);
    out.off_share = static_cast<double>(off) / static_cast<double>(std::max<std::size_t>(1, out.codes.count()));
    return out;
}

static_assert(static_cast<int>(reference::ToneMap::none) == static_cast<int>(ToneCurve::none) &&
              static_cast<int>(reference::ToneMap::reinhard) == static_cast<int>(ToneCurve::reinhard) &&
              static_cast<int>(reference::ToneMap::neutral) == static_cast<int>(ToneCurve::neutral) &&
              static_cast<int>(reference::ToneMap::aces) == static_cast<int>(ToneCurve::aces) &&
              static_cast<int>(reference::ToneMap::agx) == static_cast<int>(ToneCurve::agx));

struct Measure {
    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        const Extent2D size = settings.size;
        const double pixels = static_cast<double>(size.width) * size.height;
        const double moved = (8 + 4) * pixels;
        SpeedErrorTable table{.stem = "tonemap", .baseline = "floor", .error = "sRGB codes [1/255]"};
        const std::vector<std::uint16_t> radiance = test_radiance(size);
        rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> hdr, display;
        PELLUCID_OWN(hdr, device,
                     device.make_texture({.size = size,
                                          .format = rhi::Format::rgba16_float,
                                          .initial = rhi::bytes_of(std::span<const std::uint16_t>(radiance)),
                                          .debug_name = "hdr"}));
        const rhi::TextureDesc shown{.size = size,
                                     .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                                     .debug_name = "display"};
        PELLUCID_OWN(display, device, device.make_texture(shown));
        PELLUCID_TRY(const CopyFloor<B> copy, CopyFloor<B>::create(device, settings));

        rhi::UniformSlice frame;
        std::vector<TonemapPass<B>> passes;
        passes.reserve(std::size(curves));  // works point into it
        const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
            gpu::FrameParams params{};
            params.exposure = 1;
            PELLUCID_TRY(frame, cmd.upload_uniforms(rhi::bytes_of(params)));
            return {};
        };
        std::vector<Work<B>> works = {copy.work()};
        for (const ToneCurve curve : curves) {
            PELLUCID_TRY(auto made, TonemapPass<B>::create(device, curve, hdr, display, size));
            passes.push_back(std::move(made));
            const auto record = [&pass = passes.back(), &frame](rhi::CommandsFor<B>& cmd) { pass.record(cmd, frame); };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const rhi::Texels texels, rhi::download<B>(device, display, shown));
            const CodeErrors e = code_errors(texels, radiance, curve, settings.quick ? 2000 : 50000);
            if (!e.codes.within(1))
                return Error{Errc::internal, std::string(name(curve)) + ": a code is off by " +
                                                 significant(e.codes.max()) + " of 255; the limit is 1: not timed"};
            works.push_back({.name = name(curve), .record = record, .repeats = settings.repeats});
            table.rows.push_back({.scene = "20 stops",
                                  .method = name(curve),
                                  .rmse = e.codes.rms(),
                                  .p999 = e.codes.p999(),
                                  .max_error = e.codes.max(),
                                  .bytes = static_cast<std::uint64_t>(moved),
                                  .more = {{"codes that are off by one [%]", 100 * e.off_share}}});
        }
        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            SpeedErrorRow& row = table.rows[i];
            row.milliseconds = summarise(times[i + 1]);
            row.ratio = summarise(ratios(times[i + 1], copy.floor(settings, times[0], moved))).median;
            row.more.insert(row.more.begin(), {"us/Mpixel", microseconds_per_megapixel(row.milliseconds.median, size)});
        }
        table.notes = {copy.note(settings, times[0]), "the floor counts 8 B read and 4 B written a pixel"};
        return table;
    }
};

}  // namespace

int main(int argc, char** argv) {
    return run_pass_program("tonemap", argc, argv, Measure{});
}
