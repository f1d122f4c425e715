// SPDX-License-Identifier: MIT
// Cameras that are moved: they are rigid, give back the camera that they were made of, and do not know frames.
#include "samples/support/cameras.hpp"
#include "support/catch.hpp"
#include <pellucid/scene/demo_scene.hpp>
#include <vector>

using namespace pellucid;
using namespace pellucid::samples;

namespace {

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}
/// How far the axes are from a right-handed orthonormal triple.
double not_rigid(const glm::dmat4& m) {
    const glm::dmat3 axes(m);
    double most = glm::length(glm::cross(axes[0], axes[1]) - axes[2]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(glm::dot(axes[i], axes[j]) - (i == j ? 1.0 : 0.0)));
    return std::max({most, std::abs(m[0][3]), std::abs(m[1][3]), std::abs(m[2][3]), std::abs(m[3][3] - 1)});
}
Camera looking(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up = {0, 1, 0}) {
    Camera camera;
    camera.vertical_fov = 0.7;
    camera.world_from_view = look_at(eye, target, up);
    return camera;
}
Camera rolled(Camera camera, double angle) {
    const glm::dvec4 right = camera.world_from_view[0], up = camera.world_from_view[1];
    camera.world_from_view[0] = std::cos(angle) * right + std::sin(angle) * up;
    camera.world_from_view[1] = std::cos(angle) * up - std::sin(angle) * right;
    return camera;
}
/// Upright views of all kinds, near the poles and on them.
std::vector<Camera> upright_views() {
    std::vector<Camera> views{looking({0, 0, 0}, {0, 0, -1}),
                              looking({3, 2, 5}, {0, 0, 0}),
                              looking({-3, -2, -5}, {1, 2, 3}),
                              looking({1, 7, 2}, {1 + 1e-7, 0, 2}),
                              looking({4, 9, 4}, {4, 0, 4}, {0, 0, -1}),
                              looking({0, 0, 0}, {0, 1, 0}, {1, 0, 0.3}),
                              make_demo_scene().cameras.front()};
    return views;
}

}  // namespace

TEST_CASE("A camera that is moved is the one it was made of, where that has no roll") {
    for (const Camera& view : upright_views()) {
        const glm::dmat4& m = view.world_from_view;
        CAPTURE(m[2].x, m[2].y, m[2].z);
        REQUIRE(not_rigid(m) < 1e-14);
        CHECK(difference(OrbitCamera::from(view, 4.0).camera(view).world_from_view, m) < 1e-12);
        CHECK(difference(FirstPersonCamera::from(view).camera(view).world_from_view, m) < 1e-12);
        CHECK(OrbitCamera::from(view, 4.0).camera(view).near == view.near);
    }
}

TEST_CASE("Roll is dropped: place and line of sight stay, and the view stands upright") {
    for (const Camera& view : {looking({3, 2, 5}, {0, 0, 0}), looking({-1, -2, -5}, {1, 2, 3})})
        for (const double angle : {0.3, -2.0, 3.14159265358979}) {
            const Camera tilted = rolled(view, angle);
            const glm::dmat4 upright = FirstPersonCamera::from(tilted).camera(tilted).world_from_view;
            CHECK(difference(upright, view.world_from_view) < 1e-12);
            CHECK(difference(OrbitCamera::from(tilted, 2.0).camera(tilted).world_from_view, upright) < 1e-12);
        }
}

TEST_CASE("Every motion leaves a rigid, upright view short of the poles") {
    Camera lens;
    OrbitCamera orbit{.target = {1, 2, 3}, .distance = 5, .lens_distance = 5};
    FirstPersonCamera walk;
    for (int i = 0; i < 200; ++i) {
        const double dx = 0.37 * i - 20, dy = std::sin(1.7 * i);
        orbit.orbit(dx, dy);
        orbit.pan(0.1, -0.2, lens);
        walk.look(dx, dy);
        walk.move(0.5, -1, 1, 0.016);
        for (const glm::dmat4& m : {orbit.camera(lens).world_from_view, walk.camera(lens).world_from_view}) {
            CHECK(not_rigid(m) < 1e-14);
            CHECK(m[0].y == 0);
            CHECK(m[1].y > 0.9e-3);
        }
    }
}

TEST_CASE("Straight down stays straight down until it is turned, and is then at the limit") {
    const Camera down = looking({4, 9, 4}, {4, 0, 4}, {0, 0, -1});
    OrbitCamera orbit = OrbitCamera::from(down, 9.0);
    CHECK(glm::length(orbit.target - glm::dvec3(4, 0, 4)) < 1e-12);
    orbit.orbit(0.25, 0);
    CHECK(orbit.pitch == -steepest_pitch);
    const glm::dmat4 turned = orbit.camera(down).world_from_view;
    CHECK(not_rigid(turned) < 1e-14);
    CHECK(glm::length(glm::dvec3(turned[3]) - glm::dvec3(4, 9, 4)) < 0.01);
    orbit.orbit(0, -10);
    CHECK(orbit.pitch == steepest_pitch);
}

TEST_CASE("Orbiting keeps the distance, and the scene goes with the pointer") {
    const Camera view = looking({0, 0, 5}, {0, 0, 0});
    OrbitCamera orbit = OrbitCamera::from(view, 5.0);
    for (const auto& [dx, dy] : {std::pair{0.4, 0.0}, {0.1, 0.3}, {-2.0, -0.9}}) {
        orbit.orbit(dx, dy);
        const glm::dvec3 eye(orbit.camera(view).world_from_view[3]);
        CHECK(glm::length(eye - orbit.target) == Approx(5).epsilon(1e-14));
        CHECK(orbit.target == glm::dvec3(0, 0, 0));
    }
    // What is in front of the middle moves to the right and down in the picture when the pointer does.
    orbit = OrbitCamera::from(view, 5.0);
    orbit.orbit(0.1, 0.1);
    const glm::dvec4 seen = rigid_inverse(orbit.camera(view).world_from_view) * glm::dvec4(0, 0, 1, 1);
    CHECK(seen.x > 0.09);
    CHECK(seen.y < -0.09);
}

TEST_CASE("Panning by a share of the height moves the target by so much of the picture") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Camera view = looking({2, 3, 5}, {0, 1, 0});
        view.projection = projection;
        view.half_height = 1.5;
        view.far = 100;
        OrbitCamera orbit = OrbitCamera::from(view, 6.0);
        orbit.dolly(0.5);
        const glm::dvec3 held = orbit.target;
        orbit.pan(0.25, 0.125, view);
        const Camera after = orbit.camera(view);
        const ClipFromView clip = clip_from_view(after, {100, 100});
        const glm::dvec3 e(rigid_inverse(after.world_from_view) * glm::dvec4(held, 1));
        const double w = e.z * clip.wz + clip.ww;
        CHECK((e.x * clip.sx + clip.ox) / w == Approx(0.5).epsilon(1e-12));
        CHECK((e.y * clip.sy + clip.oy) / w == Approx(-0.25).epsilon(1e-12));
    }
}

TEST_CASE("Coming closer scales the picture and cuts nothing off that was not") {
    Camera view = looking({0, 0, 6}, {0, 0, 0});
    view.near = 4;
    OrbitCamera orbit = OrbitCamera::from(view, 6.0);
    orbit.dolly(0.5);
    CHECK(orbit.distance == 3);
    CHECK(orbit.camera(view).near == Approx(1));  // the plane z = 2, as before
    orbit.dolly(0.5);
    CHECK(orbit.camera(view).near == Approx(1.5e-3));
    orbit.dolly(1e9);
    CHECK(orbit.distance == 6e4);
    CHECK(orbit.camera(view).near == 4);
    view.projection = Projection::orthographic;
    orbit.dolly(0.5 * 6 / orbit.distance);
    const Camera closer = orbit.camera(view);
    CHECK(closer.half_height == Approx(0.5 * view.half_height));
    CHECK(closer.half_width == Approx(0.5 * view.half_width));
    CHECK(closer.world_from_view[3].z == Approx(6));
}

TEST_CASE("The target is in front of the camera, whatever it looks at") {
    const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
    CHECK(OrbitCamera::from(looking({0, 0, 5}, {0, 0, 0}), bounds).distance == Approx(5));
    CHECK(OrbitCamera::from(looking({0, 0, 5}, {3, 0, 1}), bounds).distance == Approx(4));
    CHECK(OrbitCamera::from(looking({0, 0, 5}, {0, 0, 9}), bounds).distance == Approx(0.1 * std::sqrt(3.0)));
    CHECK(OrbitCamera::from(looking({0, 0, 5}, {0, 0, 9}), Bounds{}).distance == 1);
}

TEST_CASE("A walk does not depend on the frame rate, and diagonals are no faster") {
    FirstPersonCamera once{.yaw = 0.7, .pitch = -0.4, .speed = 3};
    FirstPersonCamera often = once;
    once.move(1, 0, 1, 2.0);
    for (int i = 0; i < 1000; ++i) often.move(1, 0, 1, 0.002);
    CHECK(glm::length(once.position - often.position) < 1e-12);
    CHECK(glm::length(once.position) == Approx(6).epsilon(1e-12));
    FirstPersonCamera slow{.speed = 3};
    slow.move(0, 0, 0.5, 1.0);
    CHECK(glm::length(slow.position - glm::dvec3(0, 0, -1.5)) < 1e-15);
    slow.move(0, 0.5, 0, 1.0);
    slow.move(0.5, 0, 0, 1.0);
    CHECK(glm::length(slow.position - glm::dvec3(1.5, 1.5, -1.5)) < 1e-15);
}

TEST_CASE("Looking to the right and down") {
    Camera lens;
    FirstPersonCamera walk;
    walk.look(0.5, 0.25);
    const glm::dvec3 forward = -glm::dvec3(walk.camera(lens).world_from_view[2]);
    CHECK(forward.x == Approx(std::sin(0.5) * std::cos(0.25)));
    CHECK(forward.y == Approx(-std::sin(0.25)));
}
