// SPDX-License-Identifier: MIT
// Shadow maps against closed forms: the filter at a straight edge, planes that must not shadow themselves, shadows
// where they belong and nowhere else.
#include <cstdio>
#include <pellucid/renderer/gpu_shadows.hpp>
#include "support/shadow_cases.hpp"

using namespace pellucid;
using test::add;

namespace {

/// One and a half that a box of three reaches, half a texel's diagonal that rasterising rounds to, and what the
/// receiver's plane is moved by.
constexpr double reach = 3;  // [texel]

double largest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

/// A floor that a sun shines on from the left, and a sheet over the left half of it.
struct EdgeCase {
    Scene scene;
    bool along_x = true;  // the shadow's edge is crossed along x
    glm::dvec3 edge{0, 0, 0};
};
EdgeCase edge_case(bool along_x) {
    EdgeCase c{.scene = {}, .along_x = along_x};
    test::add_floor(c.scene, 4);
    const glm::dvec3 across = along_x ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    test::add_sheet(c.scene, glm::dvec3(0, 1, 0) - 3.0 * across, 3);
    c.scene.lights = {test::sun(0.5 * across + glm::dvec3(0, -1, 0))};
    c.edge = 0.5 * across;  // where the sheet's edge at 0, 1 m up, throws its shadow
    return c;
}

/// For each pixel of a row over the edge in steps of 1/64 texel: the share of light, and that of the closed form.
template <rhi::Backend B>
double edge_error(typename B::Device& device, bool along_x) {
    const EdgeCase c = edge_case(along_x);
    constexpr std::uint32_t maps = 512, pixels = 512;
    const RenderSettings settings = test::shadow_settings(maps, pixels);
    // The grid of texels does not depend on the camera here: the whole scene is in one map.
    auto first = test::shoot<B>(device, c.scene, test::plan_camera(c.edge, 1), settings);
    REQUIRE(first.renderer->shadows()->cameras(0).size() == 1);
    const Camera map = first.renderer->shadows()->cameras(0)[0];
    const auto view = reference::ShadowMapView{.camera = map, .size = maps};
    const glm::dvec3 across = along_x ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec2 step = *view.texel(across) - *view.texel(glm::dvec3(0));
    const int axis = std::abs(step.x) > std::abs(step.y) ? 0 : 1;
    REQUIRE(std::abs(step[1 - axis]) < 1e-9);
    const double half = 4 / std::abs(step[axis]);  // 8 texels over 512 pixels
    const Camera camera = test::plan_camera(c.edge, half);
    const auto pair = test::shadow_pair<B>(device, c.scene, camera, settings);
    const std::vector<double> share = pair.share();
    // Which texels hold the sheet: their depth is in front of the floor's.
    const rhi::Texels depths = test::must(pair.with.renderer->read_shadow_map(0));
    const ClipFromView clip = clip_from_view(map, {maps, maps});
    const glm::dvec3 on_floor = glm::transpose(glm::dmat3(map.world_from_view)) * -glm::dvec3(map.world_from_view[3]);
    const auto lit = [&](glm::ivec2 texel) {
        const auto stored = depths.at<float>(static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y));
        // Halfway between the floor below the texel and the sheet 1 m above it.
        const double per_metre = clip.zz;
        const glm::dvec2 away = glm::dvec2(texel) + 0.5 - *view.texel(glm::dvec3(0));
        const glm::dvec3 n = glm::transpose(glm::dmat3(map.world_from_view)) * glm::dvec3(0, 1, 0);
        const double metres = 2 * map.half_height / maps;
        const double floor_z = on_floor.z - (n.x * away.x - n.y * away.y) * metres / n.z;
        return stored < (floor_z + 0.3) * per_metre + clip.zw;
    };
    double worst = 0;
    std::size_t between = 0;
    const std::uint32_t middle = pixels / 2 + 3;
    for (std::uint32_t i = 0; i < pixels; ++i) {
        const std::uint32_t x = along_x ? i : middle, y = along_x ? middle : i;
        const glm::dvec2 at = *view.texel(test::plan_point(c.edge, half, pixels, x, y));
        // The nearest change from dark to lit along the axis.
        const double forward = step[axis] > 0 ? 1 : -1;
        glm::ivec2 texel(glm::floor(at));
        texel[axis] -= static_cast<int>(6 * forward);
        int n = 0;
        while (!lit(texel) && n++ < 12) texel[axis] += static_cast<int>(forward);
        REQUIRE(n > 0);
        const double border = forward > 0 ? texel[axis] : texel[axis] + 1;
        const double expected = reference::edge_light((at[axis] - border) * forward);
        between += expected > 0 && expected < 1;
        worst = std::max(worst, std::abs(share[std::size_t{y} * pixels + x] - expected));
    }
    CHECK(between >= 3 * 64 - 2);
    return worst;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a straight edge is a ramp of three texels, within 1/512 at 64 places in each", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const bool along_x : {true, false}) {
        const double worst = edge_error<TestType>(*device, along_x);
        std::printf("%s: the filter is up to %.5f off the closed form (1/512 = %.5f)\n", TestType::name, worst,
                    1. / 512);
        CHECK(worst <= 1.0 / 512);
    }
}

TEMPLATE_LIST_TEST_CASE("a plane at 0 to 89 degrees does not shadow itself", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene turned;  // a row of squares, the sun over them, each turned a degree more
    for (int angle = 0; angle < 90; ++angle)
        add(turned, test::quad(1, 1), test::matte({0.8f, 0.8f, 0.8f}),
            test::at(2.5 * angle - 112, 0, 0) *
                glm::rotate(glm::dmat4(1), glm::radians(-90.0 + angle), glm::dvec3(1, 0, 0)));
    turned.lights = {test::sun({0, -1, 0})};
    const Camera beside{.projection = Projection::orthographic,
                        .half_width = 114,
                        .half_height = 1.2,
                        .near = 1,
                        .far = 100,
                        .world_from_view = look_at({0, 20, 20}, {0, 0, 0})};
    for (const std::uint32_t maps : {64u, 512u}) {
        RenderSettings settings = test::shadow_settings(maps);
        settings.size = {1900, 20};
        const auto pair = test::shadow_pair<TestType>(*device, turned, beside, settings);
        std::size_t seen = 0;
        for (std::size_t i = 0; i < pair.without.hdr.data.size(); i += 4) seen += pair.without.hdr.data[i] > 0;
        INFO("directional, maps of " << maps);
        CHECK(seen > 10000);
        CHECK(pair.changed() == 0);
    }
    // A light low over a plane shines on it at every angle: 0.1 m up, 6 m away is 89°.
    Scene wide;
    test::add_floor(wide, 6);
    for (const Light& light : {test::bulb({0.013, 0.1, 0.007}), test::torch({-0.2, 0.1, 0.1}, {6, 0, 0.3}, 1.0),
                               test::torch({0, 0.1, 0}, {3, 0, 3}, 1.5)})
        for (const std::uint32_t maps : {64u, 512u})
            for (const double half : {6.0, 0.3}) {
                wide.lights = {light};
                const auto pair = test::shadow_pair<TestType>(*device, wide, test::plan_camera({0, 0, 0}, half),
                                                              test::shadow_settings(maps, 256));
                INFO((light.kind == LightKind::point ? "point" : "spot")
                     << ", maps of " << maps << ", " << half << " m");
                CHECK(pair.changed() == 0);
            }
}

TEMPLATE_LIST_TEST_CASE("a box on a floor: dark where its shadow is, lit elsewhere, but for what the filter reads",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add_floor(scene, 3);
    add(scene, make_box({1, 1, 1}), test::matte({0.5f, 0.5f, 0.5f}), test::at(0, 0.5, 0));
    // Whether the way from a point of the floor to the light meets the box.
    const auto blocked = [](glm::dvec3 p, glm::dvec3 way) {
        double enter = 0, leave = 1;
        const glm::dvec3 lower(-0.5, 0, -0.5), upper(0.5, 1, 0.5);
        for (int i = 0; i < 3; ++i) {
            const double a = (lower[i] - p[i]) / way[i], b = (upper[i] - p[i]) / way[i];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter < leave;
    };
    struct Case {
        Light light;
        glm::dvec3 way{0};  // to a light that is infinitely far away; 0: to its place
    };
    const glm::dvec3 low(-1.3, -1, -0.4), high(0.3, -1, 0.5);
    for (const Case& c : {Case{test::sun(low), -20.0 * low}, Case{test::sun(high), -20.0 * high},
                          Case{test::bulb({1.4, 2.2, 0.9})}, Case{test::torch({1.4, 2.2, 0.9}, {0, 0.4, 0}, 0.7)}}) {
        scene.lights = {c.light};
        constexpr std::uint32_t maps = 256, pixels = 128;
        const double half = 2.5;
        const auto pair = test::shadow_pair<TestType>(*device, scene, test::plan_camera({0, 0, 0}, half),
                                                      test::shadow_settings(maps, pixels));
        const std::vector<double> share = pair.share();
        const GpuShadows<TestType>& shadows = *pair.with.renderer->shadows();
        std::size_t light_leaks = 0, dark_leaks = 0, dark = 0;
        for (std::uint32_t y = 0; y < pixels; ++y)
            for (std::uint32_t x = 0; x < pixels; ++x) {
                const glm::dvec3 p = test::plan_point({0, 0, 0}, half, pixels, x, y);
                if (std::abs(p.x) < 0.55 && std::abs(p.z) < 0.55) continue;  // the box itself is seen
                // [m] of `reach` texels on the floor, where the map has most of it to a texel.
                double metres = 0;
                for (const Camera& map : shadows.cameras(0)) {
                    const reference::ShadowMapView view{.camera = map, .size = maps};
                    const auto at = view.texel(p);
                    if (!at || at->x < 0 || at->y < 0 || at->x > maps || at->y > maps) continue;
                    double fewest = 1e30;
                    for (int i = 0; i < 16; ++i) {
                        const glm::dvec3 d(0.01 * std::cos(i * 0.3927), 0, 0.01 * std::sin(i * 0.3927));
                        fewest = std::min(fewest, glm::distance(*at, view.texel(p + d).value_or(*at)));
                    }
                    metres = std::max(metres, 0.01 * reach / fewest);
                }
                int hidden = 0;
                for (int i = 0; i < 17; ++i) {
                    const double r = i == 16 ? 0 : metres, angle = i * 0.3927;
                    const glm::dvec3 q = p + glm::dvec3(r * std::cos(angle), 0, r * std::sin(angle));
                    hidden += blocked(q, c.way != glm::dvec3(0) ? c.way : c.light.position - q);
                }
                const double s = share[std::size_t{y} * pixels + x];
                light_leaks += hidden == 17 && s > 0;
                dark_leaks += hidden == 0 && s < 1;
                dark += hidden == 17;
            }
        INFO("light " << static_cast<int>(c.light.kind));
        CHECK(dark > 50);
        CHECK(light_leaks == 0);
        CHECK(dark_leaks == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("outside of a map, behind a spot and on its border there is light, and numbers are numbers",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add_floor(scene, 6);
    test::add_sheet(scene, {0, 0.3, 0}, 0.2f);
    // Upwards; along the floor, half of which is behind it; as wide as one map can be, and wider.
    for (const Light& light :
         {test::torch({0, 0.5, 0}, {0, 3, 0.1}, 0.5), test::torch({0.1, 0.5, 0.2}, {3, 0.4, 0}, 0.8),
          test::torch({0, 2, 0}, {0.1, 0, 0}, widest_shadow_spot), test::torch({0, 0.5, 0}, {0.5, 0, 0}, 1.57),
          test::torch({0, 1, 0}, {0.3, 0, 0}, 0.02)}) {
        scene.lights = {light};
        const auto pair =
            test::shadow_pair<TestType>(*device, scene, test::plan_camera({0, 0, 0}, 5), test::shadow_settings(32, 64));
        for (const float v : pair.with.hdr.data) REQUIRE(std::isfinite(v));
        const std::vector<double> share = pair.share();
        CHECK(largest(share) <= 1);
        // The sheet is in the middle: nothing is in shadow far away from it and from its shadow.
        for (std::uint32_t i = 0; i < 64; ++i)
            if (light.outer_cone > 0.1) CHECK(share[i] == 1);
    }
}

TEMPLATE_LIST_TEST_CASE("each of two suns has its own shadow", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add_floor(scene, 3);
    test::add_sheet(scene, {0, 1, 0}, 0.5f);
    const Light a = test::sun({1, -1, 0.2}, 1), b = test::sun({-1, -1, 0.1}, 2);
    const auto shot = [&](std::vector<Light> lights) {
        scene.lights = std::move(lights);
        return test::shoot<TestType>(*device, scene, test::plan_camera({0, 0, 0}, 2.5), test::shadow_settings(256)).hdr;
    };
    const ImageF of_a = shot({a}), of_b = shot({b}), both = shot({a, b});
    std::size_t only_a = 0, only_b = 0;
    for (std::size_t i = 0; i < both.data.size(); i += 4) {
        const float sum = of_a.data[i] + of_b.data[i];
        CHECK(std::abs(both.data[i] - sum) <= sum * 2 * 0x1p-10);
        only_a += of_a.data[i] == 0 && of_b.data[i] > 0;
        only_b += of_b.data[i] == 0 && of_a.data[i] > 0;
    }
    CHECK(only_a > 50);
    CHECK(only_b > 50);
    // One of them may be told not to cast.
    Light free = a;
    free.shadows = false;
    const ImageF one = shot({free, b});
    std::size_t dark = 0;
    for (std::size_t i = 0; i < one.data.size(); i += 4) dark += one.data[i] < 0.5f * of_b.data[i] + 0.01f;
    CHECK(dark == 0);
}

TEMPLATE_LIST_TEST_CASE("cascades: a plane to the horizon has no seam, and a shadow crosses them all", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add_floor(scene, 100);
    const Light light = test::sun({0.4, -1, 0.15});
    scene.lights = {light};
    RenderSettings settings = test::shadow_settings(256);
    settings.size = {192, 128};
    const Camera camera{.vertical_fov = 0.9, .near = 0.1, .world_from_view = look_at({0, 2, 60}, {0, 0, 30})};
    const auto plain = test::shadow_pair<TestType>(*device, scene, camera, settings);
    REQUIRE(plain.with.renderer->shadows()->cameras(0).size() == PELLUCID_SHADOW_CASCADES);
    CHECK(plain.changed() == 0);
    // A roof 6 m wide along the way that is looked.
    Material both = test::matte({0.5f, 0.5f, 0.5f});
    both.double_sided = true;
    add(scene, test::quad(3, 150), both,
        test::at(-1, 4, 0) * glm::rotate(glm::dmat4(1), -0.5 * glm::pi<double>(), glm::dvec3(1, 0, 0)));
    const auto pair = test::shadow_pair<TestType>(*device, scene, camera, settings);
    const std::vector<double> share = pair.share();
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
    std::size_t dark = 0, wrong = 0, rows = 0;
    for (std::uint32_t y = 0; y < settings.size.height; ++y) {
        std::size_t in_row = 0;
        for (std::uint32_t x = 0; x < settings.size.width; ++x) {
            const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, settings.size);
            const glm::dvec3 way =
                glm::dmat3(camera.world_from_view) * glm::dvec3(ndc.x / clip.sx, ndc.y / clip.sy, -1);
            if (way.y >= -0.02) continue;  // a pixel there is longer than any texel
            const glm::dvec3 eye(camera.world_from_view[3]), p = eye + way * (eye.y / -way.y);
            const double across = p.x - 4 * 0.4 + 1;  // from the middle of the roof's shadow
            // Texels of the coarsest cascade are below 1.2 m; finer ones begin nearer.
            const double coarse = 3 * 1.2;
            if (std::abs(across) < 3 - 2.9 || std::abs(across) > 3 + coarse) {
                const double s = share[std::size_t{y} * settings.size.width + x];
                const bool inside = std::abs(across) < 3;
                dark += inside;
                in_row += inside;
                wrong += inside ? s > 0 : s < 1;
            }
        }
        rows += in_row != 0;
    }
    CHECK(rows > 40);
    CHECK(dark > 100);
    CHECK(wrong == 0);
}

TEMPLATE_LIST_TEST_CASE("faces of a cube of maps: no seam on a ball around the light, nor in a shadow across them",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    Mesh shell = make_icosphere(2, 4);
    for (std::size_t i = 0; i < shell.indices.size(); i += 3) std::swap(shell.indices[i], shell.indices[i + 1]);
    for (glm::vec3& n : shell.normals) n = -n;
    add(scene, shell, test::matte({0.8f, 0.8f, 0.8f}));
    scene.lights = {test::bulb({0.05, -0.03, 0.02})};
    for (const glm::dvec3 corner : {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, -1), glm::dvec3(1, -1, -1)}) {
        Camera camera{.vertical_fov = 1.7, .near = 0.1, .world_from_view = look_at(-0.5 * corner, corner)};
        for (const std::uint32_t maps : {64u, 512u}) {
            const auto pair = test::shadow_pair<TestType>(*device, scene, camera, test::shadow_settings(maps, 128));
            INFO("towards (" << corner.x << ", " << corner.y << ", " << corner.z << "), maps of " << maps);
            CHECK(pair.changed() == 0);
        }
        // A small sheet before the corner where three faces meet: all of its shadow's core is dark.
        Scene with = scene;
        Material both = test::matte({0.5f, 0.5f, 0.5f});
        both.double_sided = true;
        const glm::dvec3 middle = glm::dvec3(scene.lights[0].position) + 0.4 * corner;
        add(with, test::quad(0.15f, 0.15f), both, look_at(middle, 2.0 * middle));
        const auto pair = test::shadow_pair<TestType>(*device, with, camera, test::shadow_settings(256, 128));
        const std::vector<double> share = pair.share();
        const reference::ClipCoefficients<double> clip(clip_from_view(camera, {128, 128}));
        std::size_t dark = 0, lit = 0;
        for (std::uint32_t y = 0; y < 128; ++y)
            for (std::uint32_t x = 0; x < 128; ++x) {
                const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, {128, 128});
                const glm::dvec3 eye(camera.world_from_view[3]),
                    way = glm::normalize(glm::dmat3(camera.world_from_view) *
                                         glm::dvec3(ndc.x / clip.sx, ndc.y / clip.sy, -1));
                // Where the ball is met, and how far off the light's way to the sheet's middle that is.
                const double along = glm::dot(way, eye),
                             far = -along + std::sqrt(along * along - glm::dot(eye, eye) + 4);
                const glm::dvec3 from = glm::normalize(eye + far * way - scene.lights[0].position);
                const double off = std::acos(std::min(1.0, glm::dot(from, glm::normalize(corner))));
                // The sheet hides itself and what is right behind it from the eye.
                if (glm::length(glm::cross(way, middle - eye)) < 0.3) continue;
                dark += off < 0.12 && share[std::size_t{y} * 128 + x] == 0;
                lit += off < 0.12 && share[std::size_t{y} * 128 + x] > 0;
                if (off > 0.4) CHECK(share[std::size_t{y} * 128 + x] == 1);
            }
        CHECK(lit == 0);
    }
}
