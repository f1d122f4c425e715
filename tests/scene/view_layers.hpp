// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a scene's camera sees at each pixel centre, in double precision: every surface, from front to back.
#include <pellucid/scene/scene.hpp>
#include <glm/matrix.hpp>
#include <algorithm>
#include <cmath>
#include <vector>
#include "support/catch.hpp"

namespace pellucid::test {

struct Layer {
    double depth = 0;  ///< reversed: greater is nearer
    std::size_t instance = 0;
};

/// Layers of `scene.cameras[0]` on a square picture, for each pixel; both sides of a triangle count.  Nothing may reach
/// behind the eye.
inline std::vector<std::vector<Layer>> view_layers(const Scene& scene, std::uint32_t size) {
    const ClipFromView clip = clip_from_view(scene.cameras.at(0), {size, size});
    const glm::dmat4 view_from_world = glm::inverse(scene.cameras[0].world_from_view);
    std::vector<std::vector<Layer>> pixels(std::size_t{size} * size);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        const glm::dmat4 view_from_object = view_from_world * scene.instances[i].world_from_object;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            glm::dvec3 p[3];  // pixels, pixels, depth: affine on a flat triangle
            for (std::size_t c = 0; c < 3; ++c) {
                const glm::dvec4 e = view_from_object * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[t + c]]), 1);
                const double w = e.z * clip.wz + clip.ww;
                REQUIRE(w > 0);
                p[c] = {(0.5 + 0.5 * (e.x * clip.sx + clip.ox) / w) * size,
                        (0.5 - 0.5 * (e.y * clip.sy + clip.oy) / w) * size, (e.z * clip.zz + clip.zw) / w};
            }
            const auto cross = [](glm::dvec3 a, glm::dvec3 b) { return a.x * b.y - a.y * b.x; };
            const double twice_area = cross(p[1] - p[0], p[2] - p[0]);
            if (twice_area == 0) continue;
            const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
            const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
            const auto limited = [&](double v) { return static_cast<std::uint32_t>(std::clamp(v, 0.0, double(size))); };
            for (std::uint32_t y = limited(top); y < limited(bottom + 1); ++y)
                for (std::uint32_t x = limited(left); x < limited(right + 1); ++x) {
                    const glm::dvec3 center(x + 0.5, y + 0.5, 0);
                    double weight[3], sum = 0;
                    for (std::size_t c = 0; c < 3; ++c) {
                        weight[c] = cross(p[(c + 1) % 3] - center, p[(c + 2) % 3] - center) / twice_area;
                        sum += weight[c] * p[c].z;
                    }
                    if (weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0)
                        pixels[std::size_t{y} * size + x].push_back({sum, i});
                }
        }
    }
    for (std::vector<Layer>& layers : pixels)
        std::stable_sort(layers.begin(), layers.end(),
                         [](const Layer& a, const Layer& b) { return a.depth > b.depth; });
    return pixels;
}

/// In how many pixels some layer of instance `a` is before (not only next to) some layer of instance `b`.
inline std::size_t pixels_before(const std::vector<std::vector<Layer>>& pixels, std::size_t a, std::size_t b) {
    std::size_t count = 0;
    for (const std::vector<Layer>& layers : pixels) {
        bool seen = false, found = false;
        for (const Layer& layer : layers) {
            seen = seen || layer.instance == a;
            found = found || (seen && layer.instance == b);
        }
        count += found ? 1 : 0;
    }
    return count;
}

}  // namespace pellucid::test
