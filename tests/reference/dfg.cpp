// SPDX-License-Identifier: MIT
#include <pellucid/reference/furnace.hpp>
#include "support/catch.hpp"

using namespace pellucid::reference;

namespace {

struct Place {
    double mu = 0, roughness = 0;
};

/// μ and roughness over all of (0,1], and towards the corner of smooth surfaces at grazing views.
std::vector<Place> places(int steps) {
    std::vector<double> roughnesses, cosines = {0.0};
    for (int i = 0; i <= steps; ++i) {
        const double f = static_cast<double>(i) / steps;
        cosines.push_back(f * f);
        cosines.push_back(std::pow(10.0, -8 * f));
        roughnesses.push_back(0.004 + 0.996 * f);
        roughnesses.push_back(std::pow(10.0, -2.3 * f));
    }
    std::vector<Place> out;
    for (const double r : roughnesses)
        for (const double mu : cosines) out.push_back({mu, r});
    return out;
}

template <class T>
double worst(const Dfg<T>& value, const Dfg<double>& exact) {
    const double scale = std::abs(static_cast<double>(value.scale()) - exact.scale());
    const double bias = std::abs(static_cast<double>(value.bias) - exact.bias);
    const double sum = std::abs(static_cast<double>(value.loss) - exact.loss);
    return std::max({scale, bias, sum});
}

}  // namespace

TEST_CASE("Gauss' rule integrates polynomials of degree 2n - 1", "[cpu]") {
    for (const int n : {1, 2, 5, 8, 48, 64}) {
        const GaussRule rule = gauss_rule(n);
        for (int power = 0; power < 2 * n; ++power) {
            double sum = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
            REQUIRE(sum == Approx(1.0 / (power + 1)).margin(1e-13));
        }
        CHECK(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
    }
}

TEST_CASE("the roughest white lobe reflects 1 - ln 2 of a normal view", "[cpu]") {
    const Dfg<double> exact = exact_dfg(1, 1);
    CHECK(exact.albedo(1) == Approx(1 - std::log(2.0)).margin(1e-9));
    CHECK(exact.loss == Approx(std::log(2.0)).margin(1e-9));
    CHECK(exact.scale() + exact.bias == Approx(exact.albedo(1)).margin(1e-15));
}

TEST_CASE("the albedo is the integral of D V F over the hemisphere", "[cpu]") {
    // Another domain, another rule, other code for D: the half vectors of the whole distribution.
    for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0})
        for (const double mu : {0.1, 0.3, 0.7, 1.0}) {
            const double alpha = roughness * roughness;
            const auto lobe = [&](double f0) {
                return integrate_lobe(mu, alpha, 400, [&](glm::dvec3 v, glm::dvec3 l) {
                    if (!(l.z > 0)) return 0.0;
                    const glm::dvec3 h = v + l;
                    const double v_h = glm::dot(v, h) / glm::length(h);
                    return ggx_distribution({0, 0, 1}, h, alpha) * smith_visibility(v.z, l.z, alpha) * l.z *
                           schlick_fresnel(glm::dvec3(f0), v_h).x;
                });
            };
            const Dfg<double> exact = exact_dfg(mu, alpha);
            CHECK(exact.albedo(1) == Approx(lobe(1)).margin(2e-4));
            CHECK(exact.bias == Approx(lobe(0)).margin(2e-4));
        }
}

TEST_CASE("a mirror reflects what Schlick's term says, and smooth surfaces come near it", "[cpu]") {
    for (const double mu : {0.01, 0.3, 1.0}) {
        CHECK(exact_dfg(mu, 0).loss == Approx(0).margin(1e-12));
        CHECK(exact_dfg(mu, 0).bias == Approx(mirror_weight(mu)).margin(1e-9));
        CHECK(exact_dfg(mu, 1e-6).bias == Approx(mirror_weight(mu)).margin(1e-5));
    }
    CHECK(exact_dfg(0, 0).albedo(0) == 1);
    for (const double alpha : {1e-6, 1e-3, 0.1, 1.0}) CHECK(exact_dfg(0, alpha).albedo(1) == Approx(1).margin(1e-9));
    // In the corner the albedo has no limit: it is a function of μ/α.
    for (const double alpha : {1e-3, 1e-5, 1e-7})
        CHECK(exact_dfg(alpha, alpha).loss == Approx(exact_dfg(1e-6, 1e-6).loss).margin(2e-6));
    CHECK(exact_dfg(1e-6, 1e-6).loss == Approx(0.108).margin(5e-4));
}

TEST_CASE("the quadrature is converged to 1e-6", "[cpu]") {
    // Three quarters and four thirds of its points: the error of the rule of 48 is below the larger of the differences.
    const GaussRule fewer = gauss_rule(36), more = gauss_rule(64);
    double down = 0, up = 0;
    for (const Place& p : places(7)) {
        const double alpha = p.roughness * p.roughness;
        const Dfg<double> exact = exact_dfg(p.mu, alpha);
        down = std::max(down, worst(integrate_dfg(p.mu, alpha, fewer), exact));
        up = std::max(up, worst(integrate_dfg(p.mu, alpha, more), exact));
    }
    CHECK(down < 1e-6);
    CHECK(up < 5e-7);
    CHECK(up < down);
    for (const double roughness : {0.1, 0.5}) {
        const GaussRule twice = gauss_rule(96);
        for (const double mu : {0.003, 0.1, 1.0}) {
            const double alpha = roughness * roughness;
            CHECK(worst(integrate_dfg(mu, alpha, twice), exact_dfg(mu, alpha)) < 5e-7);
        }
    }
}

TEST_CASE("128 evaluations in float are within 1.8e-4, also in the corners", "[cpu]") {
    const GaussRule eight = gauss_rule(8), sixteen = gauss_rule(16);
    double worst8 = 0, worst8_double = 0, worst16 = 0;
    for (const Place& p : places(16)) {
        const double alpha = p.roughness * p.roughness;
        const Dfg<double> exact = integrate_dfg(p.mu, alpha, gauss_rule(32));
        const auto mu = static_cast<float>(p.mu), a = static_cast<float>(alpha);
        worst8 = std::max(worst8, worst(integrate_dfg(mu, a, eight), exact));
        worst8_double = std::max(worst8_double, worst(integrate_dfg(p.mu, alpha, eight), exact));
        worst16 = std::max(worst16, worst(integrate_dfg(mu, a, sixteen), exact));
    }
    CHECK(worst8 < 1.8e-4);
    CHECK(worst8_double < 1.8e-4);
    CHECK(worst16 < 1.2e-5);
    CHECK(sampled_dfg(0.3f, 0.2f).bias == integrate_dfg(0.3f, 0.2f, eight).bias);
    CHECK(sampled_dfg(0.3f, 0.2f, 127).bias == integrate_dfg(0.3f, 0.2f, gauss_rule(7)).bias);
}

TEST_CASE("averages are cosine-weighted", "[cpu]") {
    CHECK(exact_dfg_average(0).bias == Approx(1.0 / 21).margin(1e-9));  // of (1 − μ)⁵
    CHECK(exact_dfg_average(0).loss == Approx(0).margin(1e-9));
    for (const double roughness : {0.25, 0.5, 1.0}) {
        const double alpha = roughness * roughness;
        Dfg<double> sum;  // the midpoint rule, in μ
        const int steps = 400;
        const GaussRule rule = gauss_rule(16);
        for (int i = 0; i < steps; ++i) {
            const double mu = (i + 0.5) / steps;
            const Dfg<double> at = integrate_dfg(mu, alpha, rule);
            sum.loss += 2 * mu / steps * at.loss;
            sum.bias += 2 * mu / steps * at.bias;
        }
        CHECK(worst(exact_dfg_average(alpha), sum) < 5e-5);
    }
}
