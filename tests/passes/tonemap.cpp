// SPDX-License-Identifier: MIT
// Every tone curve on the GPU against the double reference: within one 8-bit code, whatever comes in.
#include <pellucid/gpu/scene.h>
#include <algorithm>
#include <cstdlib>
#include <pellucid/core/half.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/reference/tonemap.hpp>
#include "reference/sampling.hpp"
#include "support/gpu.hpp"

using namespace pellucid;
using test::own;

namespace {
constexpr Extent2D size{128, 96};

/// Every kind of radiance that a target can hold: greys and colours over 2^-24 … 65504, zeros, negatives, NaN,
/// infinity.
Image<std::uint16_t> inputs() {
    Image<std::uint16_t> out(size.width, size.height, 4);
    test::Random random(11);
    for (std::size_t i = 0; i < std::size_t{size.width} * size.height; ++i) {
        std::uint16_t* t = out.data.data() + 4 * i;
        auto bits = [&] { return half_toward_zero(static_cast<float>(std::exp2(random.uniform(-14, 8)))); };
        t[0] = bits();
        t[1] = i % 3 == 0 ? t[0] : bits();
        t[2] = i % 3 == 0 ? t[0] : bits();
        t[3] = 0x3C00;
        constexpr std::uint16_t special[] = {0x0000, 0x8000, 0x0001, 0x8001, 0xBC00, 0xFBFF,
                                             0xFC00, 0x7C00, 0x7E00, 0xFE00, 0x7BFF, 0x3C00};
        if (i % 8 == 7) t[i / 8 % 3] = special[i / 24 % std::size(special)];
        if (i % 64 == 63) t[0] = t[1] = t[2] = special[i / 64 % std::size(special)];
    }
    return out;
}

template <rhi::Backend B>
Image8 mapped(typename B::Device& device, const Image<std::uint16_t>& in, ToneCurve curve, float ev) {
    const auto hdr = own(device, device.make_texture({.size = size,
                                                      .format = rhi::Format::rgba16_float,
                                                      .initial = rhi::bytes_of(std::span(in.data)),
                                                      .debug_name = "hdr"}));
    const auto display =
        own(device, device.make_texture({.size = size,
                                         .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                                         .debug_name = "display"}));
    const auto pass = test::must(TonemapPass<B>::create(device, curve, hdr, display, size));
    test::run(device, [&](auto& cmd) {
        gpu::FrameParams frame{};
        frame.exposure = std::exp2(ev);
        pass.record(cmd, test::must(cmd.upload_uniforms(rhi::bytes_of(frame))));
    });
    return test::read<std::uint8_t>(device, display, size, 4);
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("tone curves agree with the reference within one code", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Image<std::uint16_t> in = inputs();
    for (const ToneCurve curve :
         {ToneCurve::none, ToneCurve::reinhard, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx})
        for (const float ev : {0.0f, 2.5f, -7.0f, 31.0f, -31.0f}) {
            const Image8 out = mapped<TestType>(*device, in, curve, ev);
            std::size_t off = 0, wrong = 0, values = 0;
            for (std::size_t i = 0; i < in.data.size(); i += 4) {
                glm::dvec3 color;
                for (int c = 0; c < 3; ++c) color[c] = half_to_float(in.data[i + static_cast<std::size_t>(c)]);
                const glm::dvec3 wanted =
                    reference::tone_map(static_cast<reference::ToneMap>(curve), double{ev}, color);
                for (std::size_t c = 0; c < 3; ++c) {
                    const int code = reference::srgb8_from_linear(wanted[static_cast<int>(c)]);
                    const int difference = std::abs(out.data[i + c] - code);
                    ++values;
                    off += difference == 1;
                    wrong += difference > 1;
                }
                wrong += out.data[i + 3] != 255;
            }
            INFO(name(curve) << " at " << ev << " EV: " << off << " of " << values << " values are one code off");
            if (off > 0)
                std::printf("%s: %s %+g EV: %zu of %zu off by one\n", TestType::name, name(curve), double{ev}, off,
                            values);
            CHECK(wrong == 0);
            CHECK(off <= values / 200);  // where the exact value lies within float rounding of a code's edge
        }
}

TEMPLATE_LIST_TEST_CASE("tone curves: infinity is the largest value before the exposure, NaN and negatives are black",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Image<std::uint16_t> in(size.width, size.height, 4);
    constexpr std::uint16_t values[] = {0x7C00, 0x7BFF, 0x7E00, 0xFC00, 0xBC00, 0x0000};
    for (std::size_t i = 0; i < in.data.size(); ++i) in.data[i] = values[i / 4 % std::size(values)];
    const Image8 out = mapped<TestType>(*device, in, ToneCurve::reinhard, -16);
    const auto largest = reference::srgb8_from_linear(65504.0 / 65536 / (1 + 65504.0 / 65536));
    for (std::uint32_t x = 0; x < 6; ++x) {
        INFO("value " << x);
        CHECK(std::abs(int{out.texel(x, 0)[0]} - (x < 2 ? int{largest} : 0)) <= (x < 2 ? 1 : 0));
    }
    CHECK(out.texel(0, 0)[0] == out.texel(1, 0)[0]);
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("tone curves: both backends within one code", "[gpu]") {
    const auto vulkan = test::make_device<Vulkan>();
    const auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    const Image<std::uint16_t> in = inputs();
    for (const ToneCurve curve :
         {ToneCurve::none, ToneCurve::reinhard, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx}) {
        const Image8 a = mapped<Vulkan>(*vulkan, in, curve, 1), b = mapped<OpenGL>(*opengl, in, curve, 1);
        int worst = 0;
        for (std::size_t i = 0; i < a.data.size(); ++i) worst = std::max(worst, std::abs(a.data[i] - b.data[i]));
        INFO(name(curve));
        CHECK(worst <= 1);
    }
}
#endif
