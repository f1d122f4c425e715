// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Scenes of many lights and views into them that light assignment must get right.
#include <pellucid/scene/light_field.hpp>
#include <string>
#include <vector>
#include "support/scene.hpp"

namespace pellucid::test {

struct LightCase {
    std::string name;
    Scene scene;
    Camera camera;
    Extent2D size{83, 49};  ///< no whole number of tiles
};

/// A floor, a sphere on it and a pane over both, without lights, seen from above.
[[nodiscard]] inline Scene lit_table() {
    Scene scene;
    add(scene, make_plane(8, 8), matte({0.8f, 0.7f, 0.5f}, 0.5f));
    add(scene, make_uv_sphere(0.5f, 24, 48), {.base_color = {0.9f, 0.8f, 0.4f, 1}, .metallic = 1, .roughness = 0.3f},
        at(0, 0.5, 0));
    Material glass = matte({0.3f, 0.8f, 0.4f}, 0.4f);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    glass.double_sided = true;
    add(scene, quad(1.2f, 0.8f), glass, at(0.6, 0.9, 0.9));
    return scene;
}
[[nodiscard]] inline Camera table_camera() {
    return {.near = 0.1, .world_from_view = look_at({0.3, 2.6, 4}, {0, 0.2, 0})};
}
/// A light at `position` that reaches `range`.
[[nodiscard]] inline Light lamp(glm::dvec3 position, float range, float intensity = 2) {
    return {.color = {1, 0.8f, 0.6f}, .intensity = intensity, .range = range, .position = position};
}
[[nodiscard]] inline Light down_light(glm::dvec3 position, float range, double inner, double outer) {
    return {.kind = LightKind::spot,
            .color = {0.6f, 0.8f, 1},
            .intensity = 3,
            .range = range,
            .inner_cone = inner,
            .outer_cone = outer,
            .position = position,
            .direction = {0, -1, 0}};
}

[[nodiscard]] inline std::vector<LightCase> light_cases() {
    std::vector<LightCase> cases;
    const auto table = [&](const char* name, std::vector<Light> lights) -> LightCase& {
        LightCase c{.name = name, .scene = lit_table(), .camera = table_camera()};
        c.scene.lights = std::move(lights);
        cases.push_back(std::move(c));
        return cases.back();
    };
    table("no light but a sun", {{.kind = LightKind::directional, .direction = {0, -1, 0}}});
    table("one light", {lamp({0.5, 0.7, 0.5}, 1)});
    table("16 equal lights in one place", std::vector<Light>(16, lamp({0.8, 0.3, 0.8}, 0.4f, 0.1f)));
    table("one light over everything", {lamp({0, 6, 0}, 100, 40)});
    table("lights without a range among others",
          {lamp({1, 1, 1}, 0),
           lamp({-1, 0.5, 1}, 1),
           lamp({0, 2, 0}, 0),
           down_light({1, 2, 0}, 0, 0.2, 0.5),
           {.kind = LightKind::directional, .intensity = 0.5f, .direction = {0, -1, 0}},
           lamp({1, 0.5, -1}, 1)});
    table("behind the eye, round the eye, and across the near plane",
          {lamp({0.3, 3.6, 6}, 0.9f), lamp({0.3, 2.6, 4.2}, 4), lamp({0.3, 2.6, 4.2}, 0.3f),
           lamp({0.3, 2.55, 3.93}, 0.2f), lamp({0.29, 2.55, 3.9}, 2.5f)});
    table("spots of all widths", {down_light({0, 1.5, 1}, 2, 0, 0.004), down_light({1, 1.2, 0.5}, 1.5f, 0.1, 0.3),
                                  down_light({-1, 1, 0.5}, 1.5f, 0.5, 0.78), down_light({-1, 1, -1}, 2, 0.5, 0.79),
                                  down_light({1, 0.8, -0.5}, 1.5f, 0.2, 1.2), down_light({0, 0.9, 0}, 3, 1.5, 1.5707)});
    for (const std::uint32_t count : {17u, 32u, 1025u, 256u}) {
        LightCase c{.name = std::to_string(count) + " lights in a field",
                    .scene = make_light_field({.lights = count}),
                    .camera = {}};
        c.camera = c.scene.cameras.front();
        cases.push_back(std::move(c));
    }
    LightCase flat = cases.back();
    flat.name += ", orthographic";
    flat.camera = {.projection = Projection::orthographic,
                   .half_width = 9,
                   .half_height = 6,
                   .near = 0,
                   .far = 60,
                   .world_from_view = look_at({9, 12, 16}, {0, 0, 0})};
    LightCase low = cases.back();
    low.name += ", along the floor";
    low.camera.world_from_view = look_at({0.3, 0.4, 6}, {0.3, 0.35, 0});
    cases.push_back(std::move(flat));
    cases.push_back(std::move(low));
    return cases;
}

/// Pixels whose bits differ in any channel.
[[nodiscard]] inline std::size_t different_pixels(const ImageF& a, const ImageF& b) {
    REQUIRE(a.data.size() == b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.data.size(); i += a.channels)
        count += std::memcmp(&a.data[i], &b.data[i], 4 * a.channels) != 0;
    return count;
}

}  // namespace pellucid::test
