// SPDX-License-Identifier: MIT
// Radiance from nothing to more than a half can hold, and what the tone curves make of it.
#include <encodings/half_nearest.hpp>
#include <numbers>
#include <pellucid/reference/tonemap.hpp>
#include "hard_cases/lit_pixels.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {
constexpr ToneCurve curves[] = {ToneCurve::none, ToneCurve::reinhard, ToneCurve::neutral, ToneCurve::aces,
                                ToneCurve::agx};
}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: a sun of 1e5 lux in mirrors of roughness 0.045", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 96;
    Scene scene;
    add(scene, make_plane(8, 8), matte({1, 1, 1}, 0.7f), at(0, -1, 0));
    for (const float roughness : {0.0f, 0.045f, 0.3f})
        add(scene, make_uv_sphere(0.6f, 96, 192), {.base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = roughness},
            at(roughness < 0.01f  ? -1.3
               : roughness < 0.1f ? 0
                                  : 1.3,
               0, 0));
    scene.lights = {
        {.kind = LightKind::directional, .intensity = 1e5f, .direction = glm::normalize(glm::dvec3(-0.1, -0.3, -1))}};
    const Camera camera{.world_from_view = look_at({0, 0.5, 4}, {0, 0, 0})};
    for (const ToneCurve curve : curves) {
        RenderSettings settings = settings_for(n);
        settings.tonemap = curve;
        settings.exposure_ev = -15;
        auto shot = shoot<TestType>(*device, scene, camera, settings);
        const Image8 display = must(shot.renderer->read_display());
        float most = 0;
        std::size_t bad = 0, wrong = 0;
        for (std::uint32_t y = 0; y < n; ++y)
            for (std::uint32_t x = 0; x < n; ++x) {
                const float* t = shot.hdr.texel(x, y);
                for (int c = 0; c < 3; ++c) {
                    bad += !(t[c] >= 0 && t[c] <= 65504);
                    most = std::max(most, t[c]);
                }
                const glm::dvec3 wanted =
                    reference::tone_map(static_cast<reference::ToneMap>(curve), -15.0, glm::dvec3(t[0], t[1], t[2]));
                for (int c = 0; c < 3; ++c)
                    wrong += std::abs(int{display.texel(x, y)[c]} - reference::srgb8_from_linear(wanted[c])) > 1;
            }
        INFO(name(curve));
        CHECK(bad == 0);
        CHECK(wrong == 0);
        CHECK(most == 65504);
    }
    // In line with the eye it is 1e5 D(0)/4 = 1.9e9: infinite where it is rounded to the nearest half, unlimited.
    const double alpha = 0.045 * 0.045;
    const auto peak = static_cast<float>(1e5 / (4 * std::numbers::pi * alpha * alpha));
    CHECK(std::isinf(half_to_float(bench::half_nearest(peak))));
}

TEMPLATE_LIST_TEST_CASE("hard cases: tone curves of nothing, of one bright channel and of ties", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::vec3 radiances[] = {{0, 0, 0},    {-1e-6f, 0, 0},     {65504, 65504, 65504}, {1e6f, 1, 1},
                                   {1e4f, 0, 0}, {0, 1e4f, 0},       {0, 0, 1e4f},          {1, 1, 1},
                                   {1, 1, 0},    {0.8f, 0.8f, 0.8f}, {1e-7f, 0, 0},         {1e4f, 1e4f, 1e3f}};
    constexpr std::uint32_t columns = 4, n = 16;
    const Scene scene = material_tiles(columns, [&](std::uint32_t i) {
        Material m = matte({0, 0, 0});
        m.emissive = radiances[i % std::size(radiances)];
        return m;
    });
    for (const ToneCurve curve : curves) {
        Image8 last;
        for (const float ev : {-20.0f, -8.0f, -2.0f, 0.0f, 2.0f, 8.0f}) {
            RenderSettings settings = settings_for(n);
            settings.keep_gbuffer = false;
            settings.tonemap = curve;
            settings.exposure_ev = ev;
            auto shot = shoot<TestType>(*device, scene, flat_camera(), settings);
            const Image8 display = must(shot.renderer->read_display());
            for (std::uint32_t i = 0; i < std::size(radiances); ++i) {
                const std::uint32_t x = i % columns * 4 + 1, y = i / columns * 4 + 1;
                const float* hdr = shot.hdr.texel(x, y);
                const std::uint8_t* t = display.texel(x, y);
                INFO(name(curve) << " " << ev << " EV, case " << i);
                for (int c = 0; c < 3; ++c) {
                    const double limited = std::clamp(radiances[i][c], 0.0f, 65504.0f);
                    CHECK(std::max(hdr[c], 0.0f) <= limited);
                    CHECK(std::max(hdr[c], 0.0f) >= limited * (1 - half_step) - half_least);
                    // AgX mixes channels, so that one of them may darken while the colour brightens.
                    if (!last.data.empty() && curve != ToneCurve::agx) CHECK(t[c] >= last.texel(x, y)[c]);
                }
                // Ties stay ties and the brightest channel stays that: no hue is flipped.
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b) {
                        if (hdr[a] == hdr[b]) CHECK(std::abs(t[a] - t[b]) <= (curve == ToneCurve::agx ? 1 : 0));
                        if (hdr[a] > hdr[b]) CHECK(t[a] >= t[b]);
                    }
            }
            last = display;
        }
    }
    // x/(1+x) of each channel alone turns bright orange into yellow; the neutral curve keeps where the middle lies.
    const glm::dvec3 orange(8, 4, 0);
    const glm::dvec3 reinhard = reference::tone_map(reference::ToneMap::reinhard, 0.0, orange);
    CHECK(reinhard.y / reinhard.x > 0.9);
    const glm::dvec3 neutral = reference::tone_map(reference::ToneMap::neutral, 0.0, orange);
    CHECK((neutral.y - neutral.z) / (neutral.x - neutral.z) == Approx(0.5).margin(1e-7));
}
