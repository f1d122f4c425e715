// SPDX-License-Identifier: MIT
// Where reflection models lose their digits: peaks, rings, grazing views, no half vector.  Each with what the usual
// formula makes of it.
#include <numbers>
#include <pellucid/reference/dfg.hpp>
#include "hard_cases/lit_pixels.hpp"
#include "reference/sampling.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {
constexpr double pi = std::numbers::pi;

/// F0 D(0)/4 and Lambert's share, of a white surface with N = V = L under 1 lx.
double in_line(double roughness, double metallic) {
    const double alpha = reference::punctual_alpha(roughness), f0 = 0.04 + 0.96 * metallic;
    return f0 / (4 * pi * alpha * alpha) + (1 - f0) * (1 - metallic) / pi;
}
Material white(double metallic, double roughness) {
    return {.base_color = {1, 1, 1, 1},
            .metallic = static_cast<float>(metallic),
            .roughness = static_cast<float>(roughness)};
}
}  // namespace

TEST_CASE("hard cases: a mirror under a punctual light is finite in a million samples", "[cpu]") {
    // Half vectors as near to the normal as float has them, and the normal itself.
    Random random(1);
    std::size_t bad = 0, seed_bad = 0;
    constexpr int count = 1'000'000;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 n(random.direction()), v(random.direction_above(glm::dvec3(n)));
        const glm::vec3 l = i % 4 == 0 ? v : 2.0f * glm::dot(n, v) * n - v;
        const reference::Surface<float> mirror{.normal = i % 4 == 0 ? v : n, .metallic = 1, .roughness = 0};
        const glm::vec3 f = reference::evaluate_gltf(mirror, v, l).total();
        bad += !(std::isfinite(f.x) && f.x >= 0);
        const float n_h = std::min(glm::dot(mirror.normal, glm::normalize(v + l)), 1.0f);
        seed_bad += !std::isfinite(reference::seed_distribution(n_h, 0.0f));
    }
    CHECK(bad == 0);
    CHECK(seed_bad > count / 2);  // 0/0
}

TEST_CASE("hard cases: the peak at roughness 1/255 to 3/255 in float", "[cpu]") {
    const glm::vec3 n(0, 1, 0);
    for (const int code : {1, 2, 3}) {
        const float roughness = static_cast<float>(code) / 255.0f, alpha = roughness * roughness;
        const double peak = 1 / (pi * double{alpha} * double{alpha});
        CHECK(reference::ggx_distribution(n, n, alpha) == Approx(peak).epsilon(5e-3));
        CHECK(std::isinf(reference::seed_distribution(1.0f, roughness)));  // α² − 1 is −1
    }
    // A limit of 1e-9 on the denominator, as some have, against division by 0: 318 times too dim at α = 1e-3.
    const double alpha = 1e-3, inner = alpha * alpha;
    const double limited = alpha * alpha / std::max(pi * inner * inner, 1e-9);
    CHECK(limited == Approx(1000).epsilon(1e-9));
    CHECK(reference::ggx_distribution(glm::dvec3(n), glm::dvec3(n), alpha) == Approx(318310).epsilon(1e-4));
    CHECK(reference::ggx_distribution(n, n, 1e-3f) == Approx(318310).epsilon(1e-4));
}

TEMPLATE_LIST_TEST_CASE("hard cases: light, normal and eye in line, at every roughness of 8 bits", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    RenderSettings settings = settings_for(64);
    for (const double metallic : {0.0, 1.0}) {
        Scene scene = material_tiles(16, [&](std::uint32_t i) { return white(metallic, i / 255.0); });
        scene.lights = {sun_in_the_eye()};
        const auto shot = shoot<TestType>(*device, scene, flat_camera(), settings);
        std::size_t other = 0;
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 64; ++x)
                other += !is_stored(shot.hdr.texel(x, y)[0], in_line((y / 4 * 16 + x / 4) / 255.0, metallic), 1e-5);
        INFO("metallic " << metallic);
        CHECK(other == 0);
    }
    // The seed's D is infinite at 1/255, 2/255 and 3/255, or a thousandth where N·H is rounded to below 1.  So little
    // light keeps the exact values small.
    settings.brdf = Brdf::seed;
    settings.exact = true;  // compilers may find a form that is finite
    Scene scene = material_tiles(4, [](std::uint32_t i) { return white(1, (i % 3 + 1) / 255.0); });
    scene.lights = {sun_in_the_eye(1e-7f)};
    for (const LitPixel& p : lit_pixels<TestType>(*device, scene, flat_camera(), settings)) {
        REQUIRE(p.wanted.x < 34);
        REQUIRE_FALSE(std::abs(p.got.x / p.wanted.x - 1) < 0.5);
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: no rings around the highlight of roughness 0.045", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const double alpha = 0.045 * 0.045;  // half vectors up to tan θ = 2α away
    double seed_worst = 0;
    for (const double tilt : {0.0, 0.6}) {  // the light in the eye, and off to the side
        const glm::dvec3 half(0.6 * std::sin(tilt), 0.8 * std::sin(tilt), std::cos(tilt)), side(2 * alpha, 0, 0);
        Scene scene;
        add(scene, turning_wall(half - side, half + side, {0, alpha, 0}), white(1, 0.045));
        scene.lights = {{.kind = LightKind::directional, .direction = glm::dvec3(0, 0, 1) - 2 * half.z * half}};
        RenderSettings settings = settings_for(128);
        for (const bool exact : {false, true}) {
            settings.exact = exact;
            const LitError e = lit_error(lit_pixels<TestType>(*device, scene, flat_camera(), settings));
            std::printf("%s%s: highlight of roughness 0.045, tilted by %g: %.3g below, %.3g above\n", TestType::name,
                        exact ? " exact" : "", tilt, e.below, e.above);
            CHECK(e.nonfinite == 0);
            CHECK(e.below <= half_step + 5e-5);
            CHECK(e.above <= 5e-5);
        }
        settings.brdf = Brdf::seed;
        const LitError seed = lit_error(lit_pixels<TestType>(*device, scene, flat_camera(), settings));
        seed_worst = std::max({seed_worst, seed.below, seed.above});
    }
    std::printf("%s: the seed's form is off by %.3g\n", TestType::name, seed_worst);
    CHECK(seed_worst > 0.05);
}

TEMPLATE_LIST_TEST_CASE("hard cases: N.V from 0.001 to 0 under light along the normal", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    RenderSettings settings = settings_for(64);
    for (const double roughness : {0.045, 0.3, 1.0}) {
        Scene scene;
        add(scene, turning_wall({1, 0, 1e-3}, {1, 0, 0}), white(1, roughness));
        scene.lights = {{.kind = LightKind::directional, .intensity = 0.1f, .direction = {-1, 0, 0}}};
        const auto pixels = lit_pixels<TestType>(*device, scene, flat_camera(), settings);
        const LitError e = lit_error(pixels);
        std::printf("%s: grazing view, roughness %g: %.3g below, %.3g above\n", TestType::name, roughness, e.below,
                    e.above);
        CHECK(pixels.size() == 64 * 64);
        CHECK(e.nonfinite == 0);
        CHECK(e.below <= half_step + 1e-5);
        CHECK(e.above <= 1e-5);
    }
}

TEST_CASE("hard cases: what a bias in the denominator takes from grazing views", "[cpu]") {
    const auto at = [](double z, double side) { return glm::dvec3(side * std::sqrt(1 - z * z), 0, z); };
    struct Case {
        double n_v, n_l, left;
    };
    for (const Case& c : {Case{2.5e-5, 1, 0.5}, Case{0.005, 0.005, 0.5}, Case{0.02, 0.02, 0.941}}) {
        const reference::Surface<double> rough{.metallic = 1, .roughness = 1};
        const glm::dvec3 v = at(c.n_v, 1), l = at(c.n_l, 1);
        const double whole = reference::seed_distribution(glm::normalize(v + l).z, 1.0) *
                             reference::seed_masking(c.n_v, 1.0) * reference::seed_masking(c.n_l, 1.0) /
                             (4 * c.n_v * c.n_l) * c.n_l;
        CHECK(reference::evaluate_seed(rough, v, l).specular.x / whole == Approx(c.left).margin(1e-3));
        // Without one, and in float: the exact value.
        const double exact = reference::smith_visibility(c.n_v, c.n_l, 1.0);
        CHECK(reference::smith_visibility(static_cast<float>(c.n_v), static_cast<float>(c.n_l), 1.0f) ==
              Approx(exact).epsilon(1e-5));
        CHECK(exact == Approx(0.5 / (c.n_v + c.n_l)).epsilon(1e-12));
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: a normal map turns normals away from the eye", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 128;
    Scene scene;
    // The normal leans to the right by 0.08 at the left and 0.28 at the right, on a wall seen at 80 degrees.
    Image8 lean(2, 1, 4);
    lean.data = {138, 128, 252, 255, 163, 128, 252, 255};
    scene.images.push_back({lean, "lean"});
    scene.textures.push_back(
        {.image = 0, .sampler = {.mipmapped = false, .wrap_u = TextureWrap::clamp, .wrap_v = TextureWrap::clamp}});
    const double turn = 80 * pi / 180;
    Mesh wall = quad(static_cast<float>(1 / std::cos(turn)), 1);
    wall.uv0 = {{0.25f, 0}, {0.25f, 1}, {0.75f, 1}, {0.75f, 0}};
    wall.tangents.assign(4, {1, 0, 0, 1});
    Material m = white(0.5, 0.5);
    m.normal_texture.texture = 0;
    add(scene, wall, m, glm::rotate(glm::dmat4(1), turn, {0, 1, 0}));
    scene.lights = {{.kind = LightKind::directional, .direction = {-0.8, 0, -0.6}}};
    const auto pixels = lit_pixels<TestType>(*device, scene, flat_camera(), settings_for(n));
    REQUIRE(pixels.size() == n * n);
    const LitError e = lit_error(pixels);
    double jump = 0, least = 1;
    std::size_t away = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        away += pixels[i].n_dot_v < 0;
        least = std::min(least, pixels[i].got.x);
        if (pixels[i].x > 0) jump = std::max(jump, std::abs(pixels[i].got.x - pixels[i - 1].got.x));
    }
    std::printf("%s: normals that turn away: largest step %.4f, least %.3f, %.3g above\n", TestType::name, jump, least,
                e.above);
    CHECK(away > n * n / 3);
    CHECK(away < 2 * n * n / 3);
    CHECK(e.nonfinite == 0);
    CHECK(e.below <= half_step + 1e-5);
    CHECK(e.above <= 1e-5);
    CHECK(least > 0.05);
    CHECK(jump <= 1 / 255.0);
    // max(N·V, 0) makes a metal black there.
    RenderSettings seed = settings_for(n);
    seed.brdf = Brdf::seed;
    scene.materials[0].metallic = 1;
    std::size_t black = 0;
    for (const LitPixel& p : lit_pixels<TestType>(*device, scene, flat_camera(), seed)) black += p.got.x == 0;
    CHECK(black >= away);
}

TEMPLATE_LIST_TEST_CASE("hard cases: light straight against the view has no half vector", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // The shading normal looks away from the eye, so that the light behind the wall is in front of the normal.
    for (const double roughness : {0.0, 0.5, 1.0}) {
        Scene scene;
        add(scene, turning_wall({0, 0, -1}, {0, 0, -1}), white(0.5, roughness));
        scene.lights = {{.kind = LightKind::directional, .intensity = 1000, .direction = {0, 0, 1}}};
        std::size_t other = 0;
        const auto shot = shoot<TestType>(*device, scene, flat_camera(), settings_for(16));
        for (std::uint32_t i = 0; i < 256; ++i)
            for (std::uint32_t c = 0; c < 3; ++c) other += shot.hdr.texel(i % 16, i / 16)[c] != 0;
        CHECK(other == 0);
    }
    CHECK(std::isnan(glm::normalize(glm::vec3(0, 0, 1) + glm::vec3(0, 0, -1)).z));
}

TEST_CASE("hard cases: energy that is given back by the eye's share alone is not reciprocal", "[cpu]") {
    // Scaling by 1 + F0 (1/E(N·V) − 1), F0 = 1, roughness 1: f(v,l)/f(l,v) is E(l)/E(v).
    const reference::GaussRule rule = reference::gauss_rule(24);
    const auto albedo = [&](double mu) { return reference::integrate_dfg(mu, 1.0, rule).albedo(1.0); };
    CHECK(albedo(0.05) / albedo(1.0) == Approx(2.76).margin(0.01));
    const reference::Surface<double> metal{.metallic = 1, .roughness = 1};
    const glm::dvec3 n(0, 0, 1), low(std::sqrt(1 - 0.0025), 0, 0.05);
    CHECK(reference::evaluate_conserving(metal, n, low, reference::reference_dfg_table()).total().x / 0.05 ==
          Approx(reference::evaluate_conserving(metal, low, n, reference::reference_dfg_table()).total().x)
              .epsilon(1e-5));
}

TEMPLATE_LIST_TEST_CASE("hard cases: the sky in mirrors that turn away from the eye, across the horizon", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    RenderSettings settings = settings_for(64);
    settings.environment.kind = EnvironmentKind::sky;
    const reference::EnvironmentLight sky(settings.environment);
    for (const double roughness : {0.0, 0.3, 1.0}) {
        Scene scene;  // N·V from 0.2 to -0.2; normals and mirrored rays above and below the horizon
        add(scene, turning_wall({1, 0, 0.2}, {1, 0, -0.2}, {0, 0.4, 0}), white(1, roughness));
        double worst = 0;
        std::size_t away = 0, below = 0;
        for (const LitPixel& p : lit_pixels<TestType>(*device, scene, flat_camera(), settings)) {
            const glm::dvec3 wanted =
                reference::environment_response(p.surface, {0, 0, 1}, sky, reference::BrdfModel::gltf);
            away += p.n_dot_v < 0;
            below += p.surface.normal.y * p.n_dot_v < 0;  // of the mirrored ray
            for (int c = 0; c < 3; ++c) {
                REQUIRE(std::isfinite(p.got[c]));
                worst = std::max(worst, std::abs(p.got[c] - wanted[c]) / wanted[c]);
            }
        }
        std::printf("%s: sky, roughness %g: off by up to %.3g\n", TestType::name, roughness, worst);
        CHECK(away > 1000);
        CHECK(below > 1000);
        CHECK(worst <= 0.005 + half_step);
    }
    CHECK(std::isnan(std::pow(-0.25f, 0.4f)));  // without |y|
}
