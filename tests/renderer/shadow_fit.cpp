// SPDX-License-Identifier: MIT
// The views of shadow maps: they hold what they must, on grids that stay where they are.
#include <pellucid/reference/shadow_map.hpp>
#include <pellucid/renderer/gpu_shadows.hpp>
#include "support/catch.hpp"
#include "support/shadow_cases.hpp"

using namespace pellucid;

namespace {

constexpr std::uint32_t size = 256;
constexpr Extent2D picture{320, 180};

ShadowScene wide_scene() {
    ShadowScene scene;
    scene.all = {{-40, -1, -60}, {50, 6, 30}};
    scene.casters = {{-10, 0, -20}, {10, 6, 20}};
    return scene;
}
const Light slanted = test::sun({0.4, -1, 0.25});

/// Where the origin of the world lies on a map's grid of texels, in [0,1)², and the size of a texel [m].
glm::dvec3 grid(const Camera& map) {
    const double texel = 2 * map.half_height / size;
    const glm::dvec3 q = glm::transpose(glm::dmat3(map.world_from_view)) * glm::dvec3(map.world_from_view[3]) / texel;
    return {q.x - std::floor(q.x), q.y - std::floor(q.y), texel};
}

}  // namespace

TEST_CASE("a slice's sphere is the smallest there is", "[cpu]") {
    for (const double tangent : {0.05, 0.4, 1.0, 1.7})
        for (const auto& [near, far] : {std::pair{0.1, 0.2}, {0.0, 5.0}, {3.0, 40.0}, {9.0, 9.5}}) {
            const double found = reference::smallest_slice_radius(near, far, tangent);
            const Sphere sphere = slice_sphere(near, far, tangent);
            CHECK(sphere.radius == Approx(found).epsilon(1e-9));
            for (const double end : {near, far})
                CHECK(std::hypot(end + sphere.center.z, end * tangent) <= sphere.radius * (1 + 1e-12));
        }
}

TEST_CASE("cascades show all of the scene that is seen, with room for the filter", "[cpu]") {
    const ShadowScene scene = wide_scene();
    const glm::dvec3 eyes[] = {{0, 2, 20}, {3, 50, 3}, {-200, 30, 40}, {0, 0.2, 0}, {45, 5, -50}};
    for (const glm::dvec3 eye : eyes)
        for (const double fov : {0.2, 0.9, 2.2}) {
            const Camera camera{.vertical_fov = fov, .near = 0.05, .world_from_view = look_at(eye, {1, 1, -7})};
            const ShadowCameras maps = cascades(slanted, camera, picture, scene, size);
            REQUIRE(maps.size() >= 1);
            for (std::size_t k = 1; k < maps.size(); ++k) CHECK(maps[k].half_height > maps[k - 1].half_height);
            const ClipFromView clip = clip_from_view(camera, picture);
            std::uint32_t state = 7, seen = 0;
            const auto random = [&] {
                state = state * 1664525u + 1013904223u;
                return static_cast<double>(state >> 8u) * 0x1p-24;
            };
            for (int i = 0; i < 20000; ++i) {
                const glm::dvec3 p =
                    scene.all.lower + glm::dvec3(random(), random(), random()) * (scene.all.upper - scene.all.lower);
                const glm::dvec3 e = glm::dvec3(rigid_inverse(camera.world_from_view) * glm::dvec4(p, 1));
                if (-e.z < camera.near || std::abs(e.x * clip.sx) > -e.z || std::abs(e.y * clip.sy) > -e.z) continue;
                ++seen;
                bool shown = false;
                for (const Camera& map : maps) {
                    const auto at = reference::ShadowMapView{.camera = map, .size = size}.texel(p);
                    // Two texels that the filter reads.
                    const double room = std::min({at->x, at->y, size - at->x, size - at->y});
                    const double z =
                        (glm::transpose(glm::dmat3(map.world_from_view)) * (p - glm::dvec3(map.world_from_view[3]))).z;
                    shown = shown || (room > 2 && -z <= map.far);
                }
                CHECK(shown);
            }
            if (fov > 0.5) CHECK(seen > 100);
        }
}

TEST_CASE("moving and turning the camera leaves the grid of texels where it is", "[cpu]") {
    const ShadowScene scene = wide_scene();
    const auto maps_at = [&](glm::dvec3 eye, glm::dvec3 target) {
        return cascades(slanted, {.vertical_fov = 0.9, .near = 0.1, .world_from_view = look_at(eye, target)}, picture,
                        scene, size);
    };
    const glm::dvec3 eye(2, 3, 19), target(1, 1, -7);
    const ShadowCameras first = maps_at(eye, target);
    REQUIRE(first.size() == PELLUCID_SHADOW_CASCADES);
    const double texel = 2 * first[0].half_height / size;
    std::size_t moved = 0;
    for (int i = 1; i <= 64; ++i) {
        const glm::dvec3 step = static_cast<double>(i) / 64 * texel * glm::dvec3(1, 0.3, -0.7);
        const double angle = i * 0.1;
        for (const ShadowCameras& maps :
             {maps_at(eye + step, target + step), maps_at(eye + 20.0 * step, target + 20.0 * step),
              maps_at(eye, eye + glm::dvec3(std::sin(angle), -0.2, std::cos(angle)))}) {
            REQUIRE(maps.size() == first.size());
            for (std::size_t k = 0; k < maps.size(); ++k) {
                const glm::dvec3 off = grid(maps[k]) - grid(first[k]);
                // The grid's phase may come out as 0 or as 1.
                CHECK(std::abs(off.x - std::round(off.x)) < 1e-7);
                CHECK(std::abs(off.y - std::round(off.y)) < 1e-7);
                CHECK(off.z == 0);
                moved += maps[k].world_from_view != first[k].world_from_view;
            }
        }
    }
    CHECK(moved > 0);  // the maps do follow
}

TEST_CASE("maps of lights with a place show what the light shines on, with room for the filter", "[cpu]") {
    const ShadowScene scene = wide_scene();
    const WorldBox box = scene.casters;
    for (const double outer : {0.01, 0.5, widest_shadow_spot}) {
        const Light light = test::torch({0, 9, 3}, {4, 0, 0}, outer);
        const ShadowCameras maps = placed_maps(light, 1, scene, std::span(&box, 1), size);
        REQUIRE(maps.size() == 1);
        const glm::dvec3 side = glm::normalize(glm::cross(light.direction, glm::dvec3(0.3, 0.2, 0.9)));
        for (int i = 0; i < 32; ++i) {
            const glm::dvec3 way = glm::normalize(
                std::cos(outer) * light.direction +
                std::sin(outer) * (std::cos(i * 0.2) * side + std::sin(i * 0.2) * glm::cross(light.direction, side)));
            const auto at = reference::ShadowMapView{.camera = maps[0], .size = size}.texel(light.position + 5.0 * way);
            REQUIRE(at);
            CHECK(std::min({at->x, at->y, size - at->x, size - at->y}) > 2.9);
        }
    }
    const Light light = test::bulb({0, 9, 3});
    const ShadowCameras faces = placed_maps(light, PELLUCID_SHADOW_FACES, scene, std::span(&box, 1), size);
    REQUIRE(faces.size() == PELLUCID_SHADOW_FACES);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 d(std::sin(i * 1.3), std::sin(i * 2.1 + 1), std::sin(i * 0.7 + 2));
        const glm::dvec3 a = glm::abs(d);
        const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
        const auto face = static_cast<std::size_t>(2 * axis + (d[axis] >= 0 ? 0 : 1));
        const auto at = reference::ShadowMapView{.camera = faces[face], .size = size}.texel(light.position + d);
        REQUIRE(at);
        CHECK(std::min({at->x, at->y, size - at->x, size - at->y}) > 2.9);
    }
    // The nearest that casts is beyond the near plane, in the corners of a face too.
    const double nearest = glm::distance(light.position, glm::clamp(light.position, box.lower, box.upper));
    CHECK(faces[0].near < nearest / std::sqrt(3.0));
    CHECK(faces[0].near > nearest / 2);
}

TEST_CASE("only what is in a map or before it is drawn into it", "[cpu]") {
    const Camera map{.projection = Projection::orthographic,
                     .half_width = 1,
                     .half_height = 1,
                     .near = 0,
                     .far = 10,
                     .world_from_view = glm::dmat4(1)};
    const auto casts = [&](glm::dvec3 middle) {
        return casts_into({middle - 0.1, middle + 0.1}, clip_from_view(map, {16, 16}), glm::dmat4(1));
    };
    CHECK(casts({0, 0, -5}));
    CHECK(casts({1.05, 0, -5}));
    CHECK(casts({0, 0, -0.05}));
    CHECK_FALSE(casts({1.2, 0, -5}));
    CHECK_FALSE(casts({0, -1.2, -5}));
    CHECK_FALSE(casts({0, 0, 0.2}));
    CHECK(casts({0, 0, -12}));  // beyond the far end: nothing clips there
}
