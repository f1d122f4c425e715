// SPDX-License-Identifier: MIT
#include <pellucid/reference/furnace.hpp>
#include "lobes.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;

TEST_CASE("integrals over lights and over half vectors have their closed forms", "[cpu]") {
    constexpr double pi = std::numbers::pi;
    for (const double mu : {0.05, 0.5, 1.0}) {
        const glm::dvec3 moments =
            integrate_smooth(mu, [](glm::dvec3, glm::dvec3 l) { return glm::dvec3(1, l.z, l.z * l.z); });
        CHECK(moments.x == Approx(2 * pi).epsilon(1e-12));
        CHECK(moments.y == Approx(pi).epsilon(1e-12));
        CHECK(moments.z == Approx(2 * pi / 3).epsilon(1e-12));
        // Schlick's weight over a whole lobe, from dfg.hpp's integral over other variables.
        for (const double roughness : {0.045, 0.3, 1.0}) {
            const double alpha = roughness * roughness;
            const double bias = integrate_lobe(mu, alpha, 256, [&](glm::dvec3 v, glm::dvec3 l) {
                if (!(l.z > 0)) return 0.0;
                const double v_h = std::sqrt(std::max(0.5 * (1 + glm::dot(v, l)), 0.0));
                return pellucid::test::textbook_distribution(pellucid::test::angle_between({0, 0, 1}, v + l), alpha) *
                       smith_visibility(v.z, l.z, alpha) * l.z * mirror_weight(v_h);
            });
            CHECK(bias == Approx(exact_dfg(mu, alpha).bias).margin(2e-4));
        }
    }
}

TEST_CASE("a white furnace shows Lambert's share and the albedo of glTF's lobe", "[cpu]") {
    for (const double roughness : {0.2, 0.8})
        for (const double mu : {0.1, 0.9}) {
            const Dfg<double> dfg = exact_dfg(mu, roughness * roughness);
            const Surface<double> metal{.base_color = {0.9, 0.5, 0.1}, .metallic = 1, .roughness = roughness};
            const glm::dvec3 found = white_furnace(BrdfModel::gltf, metal, mu, DfgTable{});
            for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(dfg.albedo(metal.base_color[c])).margin(3e-4));
            const Surface<double> black{.base_color = {0, 0, 0}, .roughness = roughness};
            CHECK(white_furnace(BrdfModel::gltf, black, mu, DfgTable{}).y == Approx(dfg.albedo(0.04)).margin(3e-4));
            // Blinn–Phong's diffuse part keeps its whole share.
            const Surface<double> white{.roughness = roughness};
            CHECK(white_furnace(BrdfModel::blinn_phong, white, mu, DfgTable{}).x -
                      white_furnace(BrdfModel::blinn_phong, black, mu, DfgTable{}).x ==
                  Approx(1).margin(1e-9));
        }
}
