// SPDX-License-Identifier: MIT
// Lights drawn as volumes against the loop over all lights: the same to the rounding of the picture, wherever the eye,
// the near plane and the light are.
#include <pellucid/passes/light_volumes.hpp>
#include "support/light_cases.hpp"

using namespace pellucid;

namespace {

/// Largest difference of two pictures, over max(1e-3, value): they add in another order, and round to binary16 twice.
double largest_difference(const ImageF& a, const ImageF& b) {
    REQUIRE(a.data.size() == b.data.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        const double x = a.data[i], y = b.data[i];
        REQUIRE(std::isfinite(y));
        largest = std::max(largest, std::abs(x - y) / std::max({1e-3, x, y}));
    }
    return largest;
}
// What the lighting pass wrote and the sum of both are each rounded toward zero by less than 2^-10 of the value.
constexpr double rounding = 2 * 0x1p-10;

}  // namespace

TEMPLATE_LIST_TEST_CASE("volumes give the picture of the loop to its rounding", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    double worst = 0;
    for (const test::LightCase& c : test::light_cases()) {
        RenderSettings settings = test::settings_for(1);
        settings.size = c.size;
        settings.keep_gbuffer = false;
        settings.lighting = LightAssignment::loop;
        const auto loop = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        settings.lighting = LightAssignment::volumes;
        const auto volumes = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        INFO(c.name);
        const double off = largest_difference(loop.hdr, volumes.hdr);
        worst = std::max(worst, off);
        CHECK(off <= rounding);
        const bool has_ranged = scene_needs(c.scene, settings).ranged != 0;
        CHECK(volumes.renderer->stats().lighting == (has_ranged ? LightAssignment::volumes : LightAssignment::loop));
    }
    std::printf("%s: volumes differ by up to %.3g of a value\n", TestType::name, worst);
}

TEMPLATE_LIST_TEST_CASE("volumes work with every layout, stage, build and method that lights with what is opaque",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = make_light_field({.lights = 60});
    for (const Transparency transparency :
         {Transparency::none, Transparency::abuffer, Transparency::interleaved, Transparency::interleaved_skyx})
        for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
            for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
                if (transparency != Transparency::none &&
                    (layout == GBufferLayout::classic) != (stage == ShadingStage::fragment))
                    continue;  // both ways of both, not all of them: pipelines take long to build
                RenderSettings settings = test::settings_for(64);
                settings.keep_gbuffer = false;
                settings.transparency = transparency;
                settings.gbuffer = layout;
                settings.shading = stage;
                settings.exact = stage == ShadingStage::fragment;
                settings.lighting = LightAssignment::loop;
                const auto loop = test::shoot<TestType>(*device, scene, scene.cameras.front(), settings);
                settings.lighting = LightAssignment::volumes;
                const auto volumes = test::shoot<TestType>(*device, scene, scene.cameras.front(), settings);
                INFO(name(transparency) << ", " << name(layout) << ", " << name(stage));
                CHECK(largest_difference(loop.hdr, volumes.hdr) <= rounding);
            }
}

TEST_CASE("a volume encloses what its light reaches, and is closed", "[cpu]") {
    const std::vector<gpu::vec4> sphere = detail::volume_sphere(), cone = detail::volume_cone();
    for (const auto* mesh : {&sphere, &cone}) {
        REQUIRE(mesh->size() % 3 == 0);
        double volume = 0, inner = 1e9;
        glm::dvec3 area(0);
        for (std::size_t i = 0; i < mesh->size(); i += 3) {
            glm::dvec3 p[3];
            for (std::size_t k = 0; k < 3; ++k) p[k] = {(*mesh)[i + k].x, (*mesh)[i + k].y, (*mesh)[i + k].z};
            const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
            area += normal;
            volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
            const glm::dvec3 from = mesh == &cone ? glm::dvec3(0, 0, 0.5) : glm::dvec3(0);
            inner = std::min(inner, glm::dot(glm::normalize(normal), p[0] - from));
        }
        CHECK(glm::length(area) < 1e-5);  // closed
        CHECK(inner > 0);                 // convex round the point, faces outwards
        const double wanted = mesh == &cone ? std::numbers::pi / 3 : 4 * std::numbers::pi / 3;
        CHECK(volume > wanted);
        CHECK(volume < 1.12 * wanted);
    }
    for (std::size_t i = 0; i < sphere.size(); i += 3) {
        const auto at = [&](std::size_t k) { return glm::dvec3(sphere[i + k].x, sphere[i + k].y, sphere[i + k].z); };
        CHECK(glm::dot(glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0))), at(0)) >= 1);
    }
}
