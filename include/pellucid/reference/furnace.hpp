// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Integrals of reflection models over the hemisphere: what a surface returns of a white environment.
#include <pellucid/reference/brdf.hpp>
#include <type_traits>

namespace pellucid::inline v0_1::reference {

/// ∫ response(V, L) dω over the hemisphere around z, V at cosine `mu` in the xz plane, for lobes shaped like GGX with
/// `alpha` > 0: the midpoint rule over half vectors, `steps`² of them, tan²θ = α² u/(1 − u), graded toward the tail and
/// the axis of the lobe.  `response` -> double or dvec3 is called with lights below the horizon too, where it must give
/// 0.
template <class Response>
[[nodiscard]] auto integrate_lobe(double mu, double alpha, int steps, Response&& response);

/// ∫ response(V, L) dω -> dvec3, for responses that are smooth in L: 32 by 24 lights, graded toward the horizon.
template <class Response>
[[nodiscard]] glm::dvec3 integrate_smooth(double mu, Response&& response);

/// The response of `model` summed over an environment of radiance 1, with the view at cosine `mu`: 1 for a white
/// surface that neither loses nor makes light.  The surface's normal must be z.  Highlights are integrated as lobes,
/// with their punctual roughness, the rest of the model as smooth.  160 steps are good to 3e-4, 256 to 1e-4.
[[nodiscard]] inline glm::dvec3 white_furnace(BrdfModel model, const Surface<double>& surface, double mu,
                                              const DfgTable& table, int steps = 160);

// ---------------------------------------------------------------------------------------------------- bodies

template <class Response>
auto integrate_lobe(double mu, double alpha, int steps, Response&& response) {
    const glm::dvec3 v(std::sqrt(1 - mu * mu), 0, mu);
    std::invoke_result_t<Response&, glm::dvec3, glm::dvec3> sum(0);
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, s = t * t * (3 - 2 * t), u = 1 - s * s;  // s: cosine in the stretched space
        const double weight = 2 * s * 6 * t * (1 - t) / steps;
        const double tangent = alpha * std::sqrt(u) / s, cosine = 1 / std::sqrt(1 + tangent * tangent);
        const double sum2 = cosine * cosine * (alpha * alpha + tangent * tangent);
        const double distribution = alpha * alpha / (std::numbers::pi * sum2 * sum2);
        for (int j = 0; j < steps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / steps;  // the other half is its mirror image
            const glm::dvec3 h(tangent * cosine * std::cos(phi), tangent * cosine * std::sin(phi), cosine);
            const double v_dot_h = glm::dot(v, h);
            if (v_dot_h <= 0) continue;
            const double density = distribution * cosine / (4 * v_dot_h);
            sum += response(v, 2.0 * v_dot_h * h - v) * (weight / steps / density);
        }
    }
    return sum;
}

template <class Response>
glm::dvec3 integrate_smooth(double mu, Response&& response) {
    static const GaussRule rule = gauss_rule(32);
    constexpr int turns = 24;
    const glm::dvec3 v(std::sqrt(1 - mu * mu), 0, mu);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        for (int j = 0; j < turns; ++j) {
            const double t = rule.nodes[i], cosine = t * t * t, sine = std::sqrt(1 - cosine * cosine);
            const double phi = 2 * std::numbers::pi * (j + 0.5) / turns;
            sum += response(v, glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), cosine)) *
                   (rule.weights[i] * 3 * t * t * 2 * std::numbers::pi / turns);
        }
    return sum;
}

glm::dvec3 white_furnace(BrdfModel model, const Surface<double>& surface, double mu, const DfgTable& table, int steps) {
    // Of the conserving model's specular part only glTF's lobe is sharp.
    const auto sharp = [&](glm::dvec3 v, glm::dvec3 l) {
        return evaluate_brdf(model == BrdfModel::conserving ? BrdfModel::gltf : model, surface, v, l, table);
    };
    const auto lobe = [&](glm::dvec3 v, glm::dvec3 l) { return sharp(v, l).specular; };
    const auto rest = [&](glm::dvec3 v, glm::dvec3 l) {
        return evaluate_brdf(model, surface, v, l, table).total() - lobe(v, l);
    };
    return integrate_lobe(mu, punctual_alpha(surface.roughness), steps, lobe) + integrate_smooth(mu, rest);
}

}  // namespace pellucid::inline v0_1::reference
