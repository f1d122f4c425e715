// SPDX-License-Identifier: MIT
#include <pellucid/reference/furnace.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;
using pellucid::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

/// 128², binary16, as a GPU holds it.
const DfgTable& stored_table() {
    static const DfgTable table = DfgTable::make(128, DfgStorage::float16);
    return table;
}

glm::dvec3 furnace(BrdfModel model, const Surface<double>& surface, double mu, int steps) {
    return white_furnace(model, surface, mu, stored_table(), steps);
}

/// Albedo of a microsurface with Schlick's F: light walks on it until it leaves (Heitz, Hanika, d'Eon and Dachsbacher
/// 2016).  Where it is, is kept as the share of the surface below, C; a ray leaves with probability C^Λ.
double walk_albedo(double f0, double mu, double alpha, int walks, Random& random) {
    const auto lambda = [alpha](glm::dvec3 w) {
        const double root = std::sqrt(1 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z));
        return w.z > 0 ? 0.5 * (root - 1) : 0.5 * (-root - 1);
    };
    double sum = 0;
    for (int walk = 0; walk < walks; ++walk) {
        glm::dvec3 w(-std::sqrt(1 - mu * mu), 0, -mu);  // the way it travels
        double below = 1 - 1e-9, weight = 1;
        for (int bounce = 0; bounce < 100; ++bounce) {
            const double free = random.uniform(), l = lambda(w);
            if (w.z > 0 && free >= 1 - std::pow(below, l)) {
                sum += weight;
                break;
            }
            below /= std::pow(1 - free, 1 / l);
            // A normal that −w sees, also from below the horizon.
            const glm::dvec3 from = -w, s = glm::normalize(glm::dvec3(alpha * from.x, alpha * from.y, from.z));
            const double z = (1 - random.uniform()) * (1 + s.z) - s.z, phi = 2 * pi * random.uniform();
            const double r = std::sqrt(std::max(1 - z * z, 0.0));
            const glm::dvec3 m = glm::normalize(glm::dvec3(
                alpha * (r * std::cos(phi) + s.x), alpha * (r * std::sin(phi) + s.y), std::max(z + s.z, 1e-12)));
            weight *= schlick_fresnel(glm::dvec3(f0), glm::dot(from, m)).x;
            w = 2 * glm::dot(from, m) * m - from;
        }
    }
    return sum / walks;
}

std::vector<double> sixteenths() {
    std::vector<double> out;
    for (int i = 0; i <= 16; ++i) out.push_back(i / 16.0);
    return out;
}

}  // namespace

TEST_CASE("a white metal in a white furnace cannot be seen", "[cpu]") {
    for (const double roughness : sixteenths())
        for (const double mu : {0.05, 0.1, 0.3, 0.6, 1.0}) {
            const Surface<double> metal{.metallic = 1, .roughness = roughness};
            CAPTURE(roughness, mu);
            CHECK(furnace(BrdfModel::conserving, metal, mu, 160).x == Approx(1).margin(0.002));
        }
}

TEST_CASE("a table of 64², made with 128 evaluations a texel in float, does for the furnace", "[cpu]") {
    const GaussRule rule = gauss_rule(8);
    const DfgTable table = DfgTable::make(64, DfgStorage::float16, [&](double mu, double alpha) {
        const Dfg<float> value = integrate_dfg(static_cast<float>(mu), static_cast<float>(alpha), rule);
        return Dfg<double>{value.loss, value.bias};
    });
    for (const double roughness : sixteenths())
        for (const double mu : {0.05, 0.3, 1.0}) {
            CAPTURE(roughness, mu);
            const Surface<double> metal{.metallic = 1, .roughness = roughness}, white{.roughness = roughness};
            CHECK(white_furnace(BrdfModel::conserving, metal, mu, table).x == Approx(1).margin(0.002));
            CHECK(white_furnace(BrdfModel::conserving, white, mu, table).x == Approx(1).margin(0.001));
        }
}

TEST_CASE("a white dielectric in a white furnace cannot be seen", "[cpu]") {
    for (const double roughness : sixteenths())
        for (const double mu : {0.05, 0.1, 0.3, 0.6, 1.0}) {
            const double albedo = furnace(BrdfModel::conserving, {.roughness = roughness}, mu, 160).x;
            CAPTURE(roughness, mu);
            CHECK(albedo >= 0.99);
            CHECK(albedo <= 1.001);
        }
}

TEST_CASE("what the other models do in the furnace", "[cpu]") {
    // The seed's masking loses a smooth metal at grazing views; a rough one loses two thirds without a second lobe.
    CHECK(furnace(BrdfModel::seed, {.metallic = 1, .roughness = 0.1}, 0.05, 256).x == Approx(0.074).margin(0.002));
    CHECK(furnace(BrdfModel::gltf, {.metallic = 1, .roughness = 1}, 1, 256).x == Approx(0.3069).margin(1e-3));
    // glTF's diffuse part, which knows nothing of E, on a white dielectric.
    CHECK(furnace(BrdfModel::gltf, {.roughness = 0.1}, 0.1, 256).x == Approx(1.535).margin(0.002));
    CHECK(furnace(BrdfModel::gltf, {.roughness = 0.5}, 0.1, 256).x == Approx(1.110).margin(0.002));
}

TEST_CASE("the model is reciprocal", "[cpu]") {
    Random random(3);
    double worst = 0, worst_float = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 n = random.direction(), v = random.direction_above(n), l = random.direction_above(n);
        const Surface<double> surface{.normal = n,
                                      .base_color = {random.uniform(), random.uniform(), 1},
                                      .metallic = random.uniform(),
                                      .roughness = random.uniform()};
        const glm::dvec3 forward = evaluate_conserving(surface, v, l, stored_table()).total() / glm::dot(n, l);
        const glm::dvec3 backward = evaluate_conserving(surface, l, v, stored_table()).total() / glm::dot(n, v);
        const Surface<float> rounded{.normal = glm::vec3(n),
                                     .base_color = glm::vec3(surface.base_color),
                                     .metallic = static_cast<float>(surface.metallic),
                                     .roughness = static_cast<float>(surface.roughness)};
        const glm::vec3 vf(v), lf(l);
        const glm::vec3 there =
            evaluate_conserving(rounded, vf, lf, stored_table()).total() / glm::dot(rounded.normal, lf);
        const glm::vec3 back =
            evaluate_conserving(rounded, lf, vf, stored_table()).total() / glm::dot(rounded.normal, vf);
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(forward[c] / backward[c] - 1));
            if (glm::dot(n, v) > 1e-3 && glm::dot(n, l) > 1e-3)  // float's own N·V has few digits below
                worst_float = std::max(worst_float, std::abs(static_cast<double>(there[c]) / back[c] - 1));
        }
    }
    CHECK(worst < 1e-9);
    CHECK(worst_float < 2e-3);
}

TEST_CASE("under a constant environment the closed form is the integral", "[cpu]") {
    const Surface<double> surface{.base_color = {0.9, 0.5, 0.1}, .metallic = 0.3, .roughness = 0.6};
    for (const double mu : {0.05, 0.4, 1.0}) {
        const glm::dvec3 sum = furnace(BrdfModel::conserving, surface, mu, 256);
        const glm::dvec3 closed = constant_environment_response(surface, mu, stored_table()).total();
        for (int c = 0; c < 3; ++c) CHECK(closed[c] == Approx(sum[c]).margin(1e-3));
    }
    for (const double roughness : sixteenths())
        for (const double mu : {0.0, 0.001, 0.05, 1.0}) {
            const Surface<double> metal{.metallic = 1, .roughness = roughness}, white{.roughness = roughness};
            CHECK(constant_environment_response(metal, mu, stored_table()).total().x == Approx(1).epsilon(1e-12));
            CHECK(constant_environment_response(white, mu, stored_table()).total().x == Approx(1).epsilon(1e-12));
        }
    // A mirror's is Schlick's term, at the roughness as it is.
    CHECK(constant_environment_response(Surface<double>{.roughness = 0}, 0.2, stored_table()).specular.x ==
          Approx(schlick_fresnel(glm::dvec3(0.04), 0.2).x).margin(1e-6));
}

TEST_CASE("the second lobe's colour is that of light walking on the microsurface", "[cpu]") {
    Random random(5);
    double ours = 0, lobe_mean = 0, first_published = 0, single = 0;
    int count = 0;
    const auto blend = [](double f, double loss) { return f * f * (1 - loss) / (1 - f * loss); };
    for (const double roughness : {0.25, 0.5, 0.75, 1.0})
        for (const double mu : {0.05, 0.2, 0.5, 1.0}) {
            const double alpha = roughness * roughness;
            const Dfg<double> at = exact_dfg(mu, alpha), average = reference_dfg_table().average(roughness);
            // All of a white metal's light leaves, whatever the walk: the oracle's own check.
            CHECK(walk_albedo(1, mu, alpha, 1000, random) == Approx(1).margin(1e-12));
            for (const double f0 : {0.04, 0.2, 0.5, 0.8, 0.95}) {
                const double truth = walk_albedo(f0, mu, alpha, 8000, random);
                const double mean = f0 + (1 - f0) / 21, over_lobe = average.albedo(f0) / (1 - average.loss);
                const double between = multiple_scattering(glm::dvec3(f0), average).x;
                REQUIRE(between == Approx(blend(mean, average.loss)).epsilon(1e-12));
                ours += std::abs(conserving_albedo(glm::dvec3(f0), glm::dvec3(between), at).x - truth);
                lobe_mean += std::abs(at.albedo(f0) + blend(over_lobe, average.loss) * at.loss - truth);
                first_published += std::abs(at.albedo(f0) + blend(mean, average.loss) / mean * at.loss - truth);
                single += std::abs(at.albedo(f0) - truth);
                CHECK(conserving_albedo(glm::dvec3(f0), glm::dvec3(between), at).x == Approx(truth).margin(0.055));
                ++count;
            }
        }
    CAPTURE(ours / count, lobe_mean / count, first_published / count, single / count);
    CHECK(ours / count < 0.011);
    CHECK(ours < lobe_mean);
    CHECK(ours < 0.7 * first_published);
    CHECK(ours < 0.15 * single);
}

TEST_CASE("metals have no diffuse part, light from behind gives nothing", "[cpu]") {
    const glm::dvec3 n(0, 0, 1), v = glm::normalize(glm::dvec3(0.3, 0.1, 0.8));
    const glm::dvec3 l = glm::normalize(glm::dvec3(-0.5, 0.2, 0.3));
    CHECK(evaluate_conserving(Surface<double>{.metallic = 1}, v, l, stored_table()).diffuse == glm::dvec3(0.0));
    CHECK(evaluate_conserving(Surface<double>{}, v, -l, stored_table()).total() == glm::dvec3(0.0));
    CHECK(evaluate_conserving(Surface<double>{}, v, -v, stored_table()).total() == glm::dvec3(0.0));
    CHECK(evaluate_conserving(Surface<double>{}, -v, v, stored_table()).total() == glm::dvec3(0.0));
    // Smooth surfaces have next to no second lobe: what is left is glTF's highlight.
    const Surface<double> smooth{.metallic = 1, .roughness = 0.1};
    CHECK(evaluate_conserving(smooth, n, n, stored_table()).specular.x ==
          Approx(evaluate_gltf(smooth, n, n).specular.x).epsilon(1e-5));
    // Without a table of one's own the exact one serves.
    const auto found = evaluate_brdf(BrdfModel::conserving, Surface<double>{.roughness = 0.7}, v, l).total();
    CHECK(found == evaluate_conserving(Surface<double>{.roughness = 0.7}, v, l, reference_dfg_table()).total());
}
