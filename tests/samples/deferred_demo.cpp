// SPDX-License-Identifier: MIT
// The deferred demonstration: lights stay clear of what there is, and a frame is what a new stage draws at that time.
#include <algorithm>
#include "samples/deferred_demo/stage.hpp"
#include "support/devices.hpp"
#include "support/light_cases.hpp"

using namespace pellucid;
using namespace pellucid::samples;

TEST_CASE("deferred_demo: its lights come back after a turn, go evenly, and touch nothing", "[cpu]") {
    const Scene scene = make_demo_scene();
    REQUIRE(scene.lights.size() == 8);
    std::vector<Light> lights = scene.lights, before = scene.lights, start = scene.lights;
    orbit_lights(start, 0);
    orbit_lights(before, 0);
    for (int i = 1; i <= 480; ++i) {
        const double seconds = light_turn * i / 480;
        orbit_lights(lights, seconds);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const glm::dvec3 at = lights[k].position;
            CHECK(at.y == scene.lights[k].position.y);
            CHECK(glm::distance(at, before[k].position) < 0.06);
            for (const Instance& instance : scene.instances) {
                const Mesh& mesh = scene.meshes[instance.mesh];
                const glm::dvec3 local(rigid_inverse(instance.world_from_object) * glm::dvec4(at, 1));
                const glm::dvec3 nearest = glm::clamp(local, glm::dvec3(mesh.lower), glm::dvec3(mesh.upper));
                CHECK(glm::distance(local, nearest) > 0.1);
            }
        }
        before = lights;
    }
    for (std::size_t k = 0; k < lights.size(); ++k) CHECK(glm::distance(lights[k].position, start[k].position) < 1e-12);
}

TEST_CASE("deferred_demo: the camera begins as the scene's and keeps its target in the middle", "[cpu]") {
    const Scene scene = make_demo_scene();
    const Camera start = scene.cameras.front();
    const Bounds bounds = scene_bounds(scene);
    const OrbitCamera orbit = OrbitCamera::from(start, bounds);
    for (int i = 0; i <= 20; ++i) {
        const Camera camera = glide(start, bounds, 0.5 * i);
        const glm::dvec3 seen(rigid_inverse(camera.world_from_view) * glm::dvec4(orbit.target, 1));
        CHECK(std::hypot(seen.x, seen.y) < 1e-12);
        if (i % 20 == 0)
            for (int c = 0; c < 4; ++c)
                CHECK(glm::distance(camera.world_from_view[c], start.world_from_view[c]) < 1e-12);
        else if (i % 10 != 0)
            CHECK(glm::distance(camera.world_from_view[3], start.world_from_view[3]) > 0.5);
    }
}

TEMPLATE_LIST_TEST_CASE("deferred_demo: a frame is what a new stage draws at that time and size", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    RenderSettings settings{.size = {96, 54}};
    auto stage = test::must(DeferredStage<TestType>::create(*device, settings));
    const Camera camera = stage.scene().cameras.front();
    const auto picture = [&](DeferredStage<TestType>& of, double seconds) {
        (void)test::must(of.draw(camera, seconds));
        return test::must(of.renderer().read_hdr());
    };
    const ImageF first = picture(stage, 0);
    for (const Extent2D size : {Extent2D{96, 54}, {64, 64}}) {
        settings.size = size;
        test::must(stage.resize(size));
        const ImageF later = picture(stage, 3.7);
        REQUIRE(later.width == size.width);
        auto fresh = test::must(DeferredStage<TestType>::create(*device, settings));
        CHECK(test::different_pixels(picture(fresh, 3.7), later) == 0);
        if (size.width == first.width) CHECK(test::different_pixels(first, later) > 2000);
    }
    const auto refused = stage.resize({0, 54});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::invalid_argument);
    CHECK(picture(stage, 3.7).width == 64);
}
