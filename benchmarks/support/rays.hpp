// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a pixel of a small scene shows, in double: rays through pixel centres against every triangle.
#include <algorithm>
#include <glm/glm.hpp>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include <pellucid/scene/scene.hpp>
#include <vector>

namespace pellucid::bench {

/// A point of a surface on a ray.
struct Hit {
    std::uint32_t instance = 0;
    const Material* material = nullptr;
    glm::dvec3 position{0, 0, 0};  ///< [m] view space
    glm::dvec3 normal{0, 0, 1};    ///< view space, unit, interpolated, on the side that is seen
    [[nodiscard]] double depth() const { return -position.z; }
};

/// The scene in view space for a perspective camera, with bounds for each instance.  Untextured materials only.
class RayScene {
public:
    RayScene(const Scene& scene, const Camera& camera, Extent2D size)
        : scene_(scene), clip_(clip_from_view(camera, size)), size_(size) {
        const glm::dmat4 view_from_world = rigid_inverse(camera.world_from_view);
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[instance.mesh];
            const glm::dmat4 m = view_from_world * instance.world_from_object;
            const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(m)));
            Placed placed{.mesh = &mesh};
            for (const glm::vec3& p : mesh.positions)
                placed.positions.push_back(glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1)));
            for (const glm::vec3& n : mesh.normals) placed.normals.push_back(glm::normalize(normals * glm::dvec3(n)));
            for (const glm::dvec3& p : placed.positions) placed.center += p / double(placed.positions.size());
            for (const glm::dvec3& p : placed.positions)
                placed.radius = std::max(placed.radius, glm::length(p - placed.center));
            placed_.push_back(std::move(placed));
        }
    }

    /// All hits of the ray through (x, y) [pixel, the centre of pixel 0 is 0.5], nearest first.
    [[nodiscard]] std::vector<Hit> hits(double x, double y) const {
        const glm::dvec3 way(((2.0 * x / size_.width - 1.0) - clip_.ox) / clip_.sx,
                             ((1.0 - 2.0 * y / size_.height) - clip_.oy) / clip_.sy, -1.0);
        std::vector<Hit> out;
        for (std::uint32_t i = 0; i < placed_.size(); ++i) {
            const Placed& p = placed_[i];
            const double along = glm::dot(p.center, way) / glm::dot(way, way);
            const glm::dvec3 off = p.center - way * along;
            if (glm::dot(off, off) > p.radius * p.radius * (1 + 1e-9)) continue;
            for (std::size_t t = 0; t + 2 < p.mesh->indices.size(); t += 3) intersect(i, t, way, out);
        }
        std::stable_sort(out.begin(), out.end(), [](const Hit& a, const Hit& b) { return a.depth() < b.depth(); });
        // A ray through an edge between two triangles meets both.
        const auto same = [](const Hit& a, const Hit& b) {
            return a.instance == b.instance && b.depth() - a.depth() < 1e-9 * b.depth();
        };
        out.erase(std::unique(out.begin(), out.end(), same), out.end());
        return out;
    }
    /// Whether the corners of pixel (x, y) show the same instances in the same order as its centre.
    [[nodiscard]] bool inside_of_surfaces(std::uint32_t x, std::uint32_t y) const {
        const std::vector<Hit> center = hits(x + 0.5, y + 0.5);
        for (const double dx : {-0.02, 1.02})
            for (const double dy : {-0.02, 1.02}) {
                const std::vector<Hit> corner = hits(x + dx, y + dy);
                if (!std::equal(center.begin(), center.end(), corner.begin(), corner.end(),
                                [](const Hit& a, const Hit& b) { return a.instance == b.instance; }))
                    return false;
            }
        return true;
    }

private:
    struct Placed {
        const Mesh* mesh = nullptr;
        std::vector<glm::dvec3> positions = {}, normals = {};
        glm::dvec3 center{0, 0, 0};
        double radius = 0;
    };

    void intersect(std::uint32_t instance, std::size_t first, const glm::dvec3& way, std::vector<Hit>& out) const {
        const Placed& p = placed_[instance];
        const std::uint32_t* index = p.mesh->indices.data() + first;
        const glm::dvec3 &a = p.positions[index[0]], &b = p.positions[index[1]], &c = p.positions[index[2]];
        // Signed volumes of the ray, which starts at the origin, with the edges.
        const double wa = glm::dot(way, glm::cross(c, b));
        const double wb = glm::dot(way, glm::cross(a, c));
        const double wc = glm::dot(way, glm::cross(b, a));
        const double sum = wa + wb + wc;
        if (sum == 0 || wa * sum < 0 || wb * sum < 0 || wc * sum < 0) return;
        const Material& material = scene_.materials[p.mesh->material];
        const glm::dvec3 plane = glm::cross(b - a, c - a);
        const bool front = glm::dot(plane, way) < 0;
        if (!front && !material.double_sided) return;
        const double t = glm::dot(plane, a) / glm::dot(plane, way);
        if (!(t > 0)) return;
        const glm::dvec3 normal =
            glm::normalize((p.normals[index[0]] * wa + p.normals[index[1]] * wb + p.normals[index[2]] * wc) / sum);
        out.push_back(
            {.instance = instance, .material = &material, .position = way * t, .normal = front ? normal : -normal});
    }

    const Scene& scene_;
    ClipFromView clip_;
    Extent2D size_;
    std::vector<Placed> placed_;
};

/// The surface of a hit, its normal in view space.
[[nodiscard]] inline reference::Surface<double> surface_of(const Hit& hit) {
    const Material& m = *hit.material;
    return {.normal = hit.normal,
            .base_color = glm::dvec3(m.base_color),
            .metallic = m.metallic,
            .roughness = m.roughness,
            .occlusion = 1,
            .emissive = glm::dvec3(m.emissive)};
}

}  // namespace pellucid::bench
