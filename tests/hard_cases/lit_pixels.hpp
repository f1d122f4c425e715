// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Pictures of white surfaces whose every pixel is judged: by the double reference of what the G-buffer really holds,
/// or by a closed form.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>
#include "support/scene.hpp"

namespace pellucid::test {

/// A half keeps 10 bits behind the leading one and drops the rest.
inline constexpr double half_step = 0x1p-10;
/// The smallest difference of two halves.
inline constexpr double half_least = 0x1p-24;

/// The largest half that is not above `value`, in [2^-14,65504].
[[nodiscard]] inline double half_below(double value) {
    return half_to_float(half_toward_zero(static_cast<float>(value)));
}

/// Whether the half `got` is what is stored of `wanted`, when arithmetic errs by up to `relative` of it.
[[nodiscard]] inline bool is_stored(double got, double wanted, double relative) {
    return got <= wanted * (1 + relative) && got >= wanted * (1 - half_step - relative) - half_least;
}

/// One covered pixel.
struct LitPixel {
    std::uint32_t x = 0, y = 0;
    glm::dvec3 got{0}, wanted{0};
    reference::Surface<double> surface;  ///< as it was stored
    double n_dot_v = 0;
};

/// Draws `scene`, without ambient light, and computes every covered pixel once more in double.  Base colours must be 0
/// or 1, which every driver decodes exactly.
template <rhi::Backend B>
[[nodiscard]] std::vector<LitPixel> lit_pixels(typename B::Device& device, const Scene& scene, const Camera& camera,
                                               RenderSettings settings) {
    settings.keep_gbuffer = true;
    const auto shot = shoot<B>(device, scene, camera, settings);
    const std::vector<reference::CompactTexel> texels = shot.compact();
    const std::vector<Light> lights = reference::lights_in_view(scene.lights, camera);
    Camera eye = camera;
    eye.world_from_view = glm::dmat4(1);
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
    std::vector<LitPixel> out;
    for (std::uint32_t y = 0; y < settings.size.height; ++y)
        for (std::uint32_t x = 0; x < settings.size.width; ++x) {
            const reference::CompactTexel& t = texels[std::size_t{y} * settings.size.width + x];
            if (t.depth == 0) continue;
            const glm::dvec3 p = reference::view_from_depth(
                clip, reference::ndc_from_pixel<double>(x, y, settings.size), double{t.depth});
            const glm::dvec3 to_eye = reference::direction_to_eye(eye, p);
            LitPixel pixel{.x = x, .y = y, .surface = reference::unpack_surface<double>(t)};
            for (int c = 0; c < 3; ++c) {
                REQUIRE((pixel.surface.base_color[c] == 0 || pixel.surface.base_color[c] == 1));
                pixel.got[c] = shot.hdr.texel(x, y)[c];
            }
            pixel.n_dot_v = glm::dot(pixel.surface.normal, to_eye);
            pixel.wanted = reference::surface_radiance(pixel.surface, p, to_eye, lights, glm::dvec3(0),
                                                       static_cast<reference::BrdfModel>(settings.brdf));
            out.push_back(pixel);
        }
    return out;
}

/// The largest differences of red, relative to what is wanted.  What is stored is up to `half_step` below.
struct LitError {
    double below = 0, above = 0;
    std::size_t nonfinite = 0;
};
[[nodiscard]] inline LitError lit_error(const std::vector<LitPixel>& pixels) {
    LitError out;
    for (const LitPixel& p : pixels) {
        out.nonfinite += !(std::isfinite(p.got.x) && p.got.x >= 0);
        out.below = std::max(out.below, (p.wanted.x - p.got.x - half_least) / p.wanted.x);
        out.above = std::max(out.above, (p.got.x - p.wanted.x) / p.wanted.x);
    }
    return out;
}

/// A wall over all of `flat_camera`'s view whose normals, not unit, run from `left` to `right`; `up` is added at the
/// top and subtracted at the bottom.
[[nodiscard]] inline Mesh turning_wall(const glm::dvec3& left, const glm::dvec3& right,
                                       const glm::dvec3& up = glm::dvec3(0)) {
    Mesh mesh = quad();
    mesh.normals = {glm::vec3(left + up), glm::vec3(left - up), glm::vec3(right - up), glm::vec3(right + up)};
    return mesh;
}

/// Squares that face the eye of `flat_camera`, `columns`² of them in rows from the top left, each of its own material.
[[nodiscard]] inline Scene material_tiles(std::uint32_t columns, const std::function<Material(std::uint32_t)>& of) {
    Scene scene;
    const float half = 1.0f / static_cast<float>(columns);
    for (std::uint32_t i = 0; i < columns * columns; ++i)
        add(scene, quad(half, half), of(i),
            at((2.0 * (i % columns) + 1) / columns - 1, 1 - (2.0 * (i / columns) + 1) / columns, 0));
    return scene;
}

/// A sun in the eye of `flat_camera`, so that N = V = L on what faces it.
[[nodiscard]] inline Light sun_in_the_eye(float lux = 1) {
    return {.kind = LightKind::directional, .intensity = lux, .direction = {0, 0, -1}};
}

}  // namespace pellucid::test
