// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/furnace.hpp>
#include "lobes.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;
using pellucid::test::angle_between;
using pellucid::test::Random;
using pellucid::test::textbook_distribution;

namespace {

constexpr double pi = std::numbers::pi;

/// Directional albedo of the specular lobe with F = 1 (a white metal).
double directional_albedo(BrdfModel model, double mu, double roughness, int steps) {
    const Surface<double> surface{.metallic = 1, .roughness = roughness};
    return integrate_lobe(mu, roughness * roughness, steps,
                          [&](glm::dvec3 v, glm::dvec3 l) { return evaluate_brdf(model, surface, v, l).specular.x; });
}

template <class T>
bool finite(const BrdfResponse<T>& r) {
    const glm::vec<3, T> t = r.total();
    return std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z) && t.x >= 0 && t.y >= 0 && t.z >= 0;
}

}  // namespace

TEST_CASE("light, normal and view in line: F0 D(0)/4 and Lambert's share", "[cpu]") {
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, 3));
    for (const double roughness : {0.045, 0.3, 1.0}) {
        const Surface<double> surface{.normal = n, .base_color = {0.8, 0.5, 0.1}, .roughness = roughness};
        const auto response = evaluate_gltf(surface, n, n);
        CHECK(response.specular.x == Approx(0.04 / (4 * pi * std::pow(roughness, 4))).epsilon(1e-10));
        CHECK(response.diffuse.y == Approx(0.96 * 0.5 / pi).epsilon(1e-10));
    }
    // A rougher-than-limit surface is used as it is, a smoother one at the limit.
    const Surface<double> mirror{.normal = n, .roughness = 0};
    CHECK(evaluate_gltf(mirror, n, n).specular.x == Approx(0.01 / (pi * std::pow(0.045, 4))).epsilon(1e-10));
    CHECK(punctual_alpha(0.5) == 0.25);
    CHECK(punctual_alpha(std::numeric_limits<double>::quiet_NaN()) == Approx(0.045 * 0.045).epsilon(1e-14));
}

TEST_CASE("metals have no diffuse part, and half metals half of it", "[cpu]") {
    const glm::dvec3 n(0, 0, 1);
    for (const BrdfModel model : {BrdfModel::gltf, BrdfModel::seed, BrdfModel::blinn_phong}) {
        CHECK(evaluate_brdf(model, Surface<double>{.metallic = 1}, n, n).diffuse == glm::dvec3(0.0));
        const double fresnel = model == BrdfModel::blinn_phong ? 0.0 : 0.52;
        CHECK(evaluate_brdf(model, Surface<double>{.metallic = 0.5}, n, n).diffuse.x ==
              Approx(0.5 * (1 - fresnel) / pi).epsilon(1e-12));
    }
}

TEST_CASE("a normal that turns away from the eye uses |N.V|", "[cpu]") {
    const glm::dvec3 v(std::sqrt(1 - 0.09), 0, -0.3), l(0.6, 0, 0.8);
    const Surface<double> surface{.metallic = 1, .roughness = 0.5};
    const double theta = angle_between({0, 0, 1}, v + l);
    CHECK(evaluate_gltf(surface, v, l).specular.x ==
          Approx(textbook_distribution(theta, 0.25) * smith_visibility(0.3, 0.8, 0.25) * 0.8).epsilon(1e-10));
}

TEST_CASE("light from behind gives exactly nothing, also along the view", "[cpu]") {
    const glm::dvec3 n(0, 0, 1), v = glm::normalize(glm::dvec3(0.3, 0.1, 0.8));
    for (const BrdfModel model : {BrdfModel::gltf, BrdfModel::seed, BrdfModel::blinn_phong}) {
        const Surface<double> surface{.normal = n, .roughness = 0.4};
        CHECK(evaluate_brdf(model, surface, v, -v).total() == glm::dvec3(0.0));
        CHECK(evaluate_brdf(model, surface, v, glm::dvec3(1, 0, 0)).total() == glm::dvec3(0.0));
        CHECK(evaluate_brdf(model, surface, v, glm::dvec3(0, 0, -1)).total() == glm::dvec3(0.0));
        // The eye is behind the normal and the light straight opposite: no half vector.
        CHECK(finite(evaluate_brdf(model, surface, -v, v)));
    }
    CHECK(evaluate_gltf(Surface<double>{.normal = n}, -v, v).total() == glm::dvec3(0.0));
    CHECK(evaluate_gltf(Surface<float>{}, glm::vec3(-v), glm::vec3(v)).total() == glm::vec3(0.0f));
}

TEST_CASE("the response is continuous where the normal turns away from the eye", "[cpu]") {
    const glm::dvec3 l = glm::normalize(glm::dvec3(0.5, 0.2, 0.7));
    for (const double roughness : {0.3, 0.6, 1.0}) {
        const Surface<double> surface{.roughness = roughness};
        double last = -1, jump = 0;
        for (int i = -20000; i <= 20000; ++i) {
            const double angle = 0.5 * pi + 0.8 * i / 20000.0;  // from the normal, across the horizon
            const auto response = evaluate_gltf(surface, glm::dvec3(-std::sin(angle), 0, std::cos(angle)), l);
            REQUIRE(finite(response));
            if (last >= 0) jump = std::max(jump, std::abs(response.total().x - last));
            last = response.total().x;
        }
        CHECK(jump < 1 / 255.0);
    }
}

TEMPLATE_TEST_CASE("no input of the 8-bit cube gives a NaN, an infinity or a negative value", "[cpu]", float, double) {
    using Vector = glm::vec<3, TestType>;
    Random random(11);
    const Vector n(glm::normalize(glm::dvec3(0.2, -0.4, 0.9)));
    std::vector<std::pair<Vector, Vector>> pairs = {{n, n}, {n, -n}, {-n, n}, {-n, -n}};
    for (int i = 0; i < 5; ++i) {
        const Vector v(random.direction()), r = TestType(2) * glm::dot(n, v) * n - v;
        const Vector side(glm::normalize(glm::cross(glm::dvec3(n), random.direction())));
        for (const auto& pair : {std::pair(v, r),
                                 {v, -v},
                                 {v, v},
                                 {v, side},
                                 {side, v},
                                 {side, -side},
                                 {side, n},
                                 {v, Vector(random.direction())}})
            pairs.push_back(pair);
    }
    // Grazing on both sides, mirrored and not.
    const Vector tangent(glm::normalize(glm::cross(glm::dvec3(n), glm::dvec3(1, 0, 0))));
    for (const double cosine : {1e-7, 1e-4}) {
        const Vector low = glm::normalize(tangent + n * TestType(cosine));
        pairs.push_back({low, low});
        pairs.push_back({low, glm::normalize(n * TestType(cosine) - tangent)});
    }
    const DfgTable table = DfgTable::make(64, DfgStorage::float16);
    constexpr int bases[] = {0, 1, 188, 255};
    for (const BrdfModel model : {BrdfModel::gltf, BrdfModel::seed, BrdfModel::blinn_phong, BrdfModel::conserving})
        for (int roughness = 0; roughness < 256; ++roughness)
            for (int metallic = 0; metallic < 256; ++metallic) {
                const int base = bases[(roughness + metallic / 4 + metallic) % 4];
                const Surface<TestType> surface{.normal = n,
                                                .base_color = Vector(TestType(base) / TestType(255)),
                                                .metallic = TestType(metallic) / TestType(255),
                                                .roughness = TestType(roughness) / TestType(255)};
                for (const auto& [v, l] : pairs)
                    if (!finite(evaluate_brdf(model, surface, v, l, table)))
                        FAIL("model " << int(model) << " roughness " << roughness << " metallic " << metallic);
            }
}

TEST_CASE("the directional albedo meets 1 - ln 2 and the table of the lobe", "[cpu]") {
    CHECK(directional_albedo(BrdfModel::gltf, 1.0, 1.0, 256) == Approx(1 - std::log(2.0)).margin(1e-4));
    CHECK(directional_albedo(BrdfModel::gltf, 0.5, 0.5, 256) == Approx(0.857).margin(1e-3));
    CHECK(directional_albedo(BrdfModel::gltf, 1.0, 0.5, 256) == Approx(0.916).margin(1e-3));
    CHECK(directional_albedo(BrdfModel::gltf, 0.1, 0.75, 256) == Approx(0.848).margin(1e-3));
    // The seed's masking loses most of a smooth metal at grazing views.
    CHECK(directional_albedo(BrdfModel::seed, 0.05, 0.1, 256) < 0.15);
    CHECK(directional_albedo(BrdfModel::gltf, 0.05, 0.1, 256) == Approx(0.976).margin(2e-3));
    for (int i = 1; i <= 8; ++i)
        for (const double mu : {0.05, 0.3, 0.7, 1.0}) {
            const double albedo = directional_albedo(BrdfModel::gltf, mu, i / 8.0, 96);
            CHECK(albedo > 0.3);
            CHECK(albedo < 1.001);
        }
}

TEST_CASE("the glTF model is reciprocal", "[cpu]") {
    Random random(3);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 n = random.direction(), v = random.direction_above(n), l = random.direction_above(n);
        const Surface<double> surface{.normal = n,
                                      .base_color = {random.uniform(), random.uniform(), 1},
                                      .metallic = random.uniform(),
                                      .roughness = random.uniform()};
        const glm::dvec3 forward = evaluate_gltf(surface, v, l).total() / glm::dot(n, l);
        const glm::dvec3 backward = evaluate_gltf(surface, l, v).total() / glm::dot(n, v);
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(forward[c] / backward[c] - 1));
    }
    CHECK(worst < 1e-9);
}

TEST_CASE("the seed's terms have their hand-computed values", "[cpu]") {
    CHECK(seed_distribution(1.0, 0.5) == Approx(16 / pi).epsilon(1e-12));
    CHECK(seed_distribution(0.5, 1.0) == Approx(1 / pi).epsilon(1e-12));
    CHECK(seed_masking(0.5, 1.0) == Approx(2.0 / 3.0).epsilon(1e-12));
    CHECK(seed_masking(0.1, 0.0) == Approx(0.1 / 0.2125).epsilon(1e-12));
    CHECK(std::isnan(seed_distribution(1.0, 0.0)));
    CHECK(std::isinf(seed_distribution(1.0f, 0.011f)));
    const glm::dvec3 n(0, 0, 1);
    const auto response = evaluate_seed(Surface<double>{.normal = n, .roughness = 0.5}, n, n);
    CHECK(response.specular.x == Approx(16 / pi * 0.04 / 4.0001).epsilon(1e-12));
    CHECK(response.diffuse.x == Approx(0.96 / pi).epsilon(1e-12));
    // The bias dims a grazing view: 5.9 % at both cosines 0.02.
    const auto vector = [](double z, double sign) { return glm::dvec3(sign * std::sqrt(1 - z * z), 0, z); };
    const double biased = evaluate_seed(Surface<double>{.roughness = 1}, vector(0.02, 1), vector(0.02, 1)).specular.x;
    const double fresnel = 0.04, masking = seed_masking(0.02, 1.0);
    CHECK(biased == Approx(fresnel / pi * masking * masking / (4 * 0.02 * 0.02) * 0.02 * (1 - 0.0588)).epsilon(1e-3));
    CHECK(evaluate_seed(Surface<double>{.roughness = 0}, n, n).specular == glm::dvec3(0.0));
}

TEST_CASE("the Blinn-Phong lobe is normalised and peaks with GGX", "[cpu]") {
    const glm::dvec3 n(0, 0, 1);
    for (const double roughness : {0.045, 0.2, 0.7, 1.0}) {
        const Surface<double> metal{.metallic = 1, .roughness = roughness};
        const double peak = evaluate_blinn_phong(metal, n, n).specular.x;
        CHECK(peak == Approx(evaluate_gltf(metal, n, n).specular.x).epsilon(1e-9));
        // With V = L = H the lobe is (s+2)/(8π) (N·H)^s (N·L): its integral over the hemisphere, times 4, is 1.
        const int steps = 200000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps, theta = 0.5 * pi * t * t * t;  // graded toward the axis
            const glm::dvec3 h(std::sin(theta), 0, std::cos(theta));
            sum += 2 * pi * std::sin(theta) * 1.5 * pi * t * t / steps * evaluate_blinn_phong(metal, h, h).specular.x;
        }
        CHECK(4 * sum == Approx(1).epsilon(1e-6));
    }
    CHECK(evaluate_blinn_phong(Surface<double>{}, n, n).diffuse.x == Approx(1 / pi).epsilon(1e-14));
}
