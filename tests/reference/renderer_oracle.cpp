// SPDX-License-Identifier: MIT
// The reference renderer against a ray caster that shares nothing of its geometry: Möller and Trumbore's intersection
// in world space, in long double, every triangle tried for every pixel, attributes mixed by the hit's own coordinates.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/reference/texture.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;
using reference::Fragment;

namespace {

using Real = long double;
using Vec3 = glm::vec<3, Real>;
using Mat3 = glm::mat<3, 3, Real>;

struct Ray {
    Vec3 origin, direction;
};
/// Through the centre of pixel (x, y); the camera's fields are read anew, not through ClipFromView.
Ray ray_through(const Camera& camera, Extent2D size, int x, int y) {
    const Real right = (2 * (x + Real(0.5)) / size.width - 1) * size.width / size.height;
    const Real up = 1 - 2 * (y + Real(0.5)) / size.height;
    const Mat3 axes(glm::dmat3(camera.world_from_view));
    const Vec3 eye(camera.world_from_view[3]);
    if (camera.projection == Projection::orthographic)
        return {eye + axes * Vec3(right * camera.half_height, up * camera.half_height, 0), axes * Vec3(0, 0, -1)};
    const Real slope = std::tan(Real(0.5) * camera.vertical_fov);
    return {eye, axes * Vec3(right * slope, up * slope, -1)};  // t is the distance along the view's axis
}

struct Triangle {
    const Mesh* mesh;
    const Material* material;
    const std::uint32_t* at;
    std::uint32_t instance;
    Vec3 v[3];
    Mat3 axes, normals;
    bool mirrored;
};

struct Meeting {
    Real t, u, v;
    Real margin;  ///< how far inside: the least of the three coordinates
};
/// Where the ray meets the triangle's plane; nothing where they are parallel.
bool meet(const Ray& ray, const Triangle& triangle, Meeting& out) {
    const Vec3 e1 = triangle.v[1] - triangle.v[0], e2 = triangle.v[2] - triangle.v[0];
    const Vec3 p = glm::cross(ray.direction, e2);
    const Real determinant = glm::dot(e1, p);
    if (determinant == 0) return false;
    const Vec3 s = ray.origin - triangle.v[0], q = glm::cross(s, e1);
    out.u = glm::dot(s, p) / determinant;
    out.v = glm::dot(ray.direction, q) / determinant;
    out.t = glm::dot(e2, q) / determinant;
    out.margin = std::min({out.u, out.v, 1 - out.u - out.v});
    return true;
}

struct Oracle {
    const Scene* scene;
    Camera camera;
    Extent2D size;
    std::vector<Light> lights;
    std::vector<Triangle> triangles;                  // in draw order
    std::vector<reference::SampledTexture> textures;  // of Scene::textures, as colour
    std::vector<reference::SampledTexture> maps;      // of Scene::textures, as data

    void gather() {
        for (const bool blended : {false, true})
            for (std::uint32_t i = 0; i < scene->instances.size(); ++i) {
                const Instance& instance = scene->instances[i];
                const Mesh& mesh = scene->meshes[instance.mesh];
                const Material& material = scene->materials[mesh.material];
                if ((material.alpha_mode == AlphaMode::blend) != blended) continue;
                const glm::mat<4, 4, Real> world(instance.world_from_object);
                const Mat3 axes(glm::dmat3(instance.world_from_object));
                for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
                    Triangle t{.mesh = &mesh, .material = &material, .at = &mesh.indices[k], .instance = i};
                    for (int c = 0; c < 3; ++c)
                        t.v[c] = Vec3(world * glm::vec<4, Real>(Vec3(mesh.positions[t.at[c]]), 1));
                    t.axes = axes;
                    t.normals = glm::transpose(glm::inverse(axes));
                    t.mirrored = glm::determinant(axes) < 0;
                    triangles.push_back(t);
                }
            }
        for (const SceneTexture& t : scene->textures) {
            textures.push_back(reference::sampled_texture(scene->images[t.image].pixels, t.sampler, true));
            maps.push_back(reference::sampled_texture(scene->images[t.image].pixels, t.sampler, false));
        }
    }

    template <class V>
    static V mix3(const V& a, const V& b, const V& c, const Meeting& m) {
        return a * (1 - m.u - m.v) + b * m.u + c * m.v;
    }

    glm::dvec4 look_up(const std::vector<reference::SampledTexture>& list, const TextureRef& ref, const Triangle& t,
                       int x, int y, const Meeting& here) const {
        // uv' = offset + R(rotation) (scale uv), R against the clock where v runs down.
        const auto uv = [&](const Meeting& m) {
            using Vec2 = glm::vec<2, Real>;
            const Vec2 raw =
                mix3(Vec2(t.mesh->uv0[t.at[0]]), Vec2(t.mesh->uv0[t.at[1]]), Vec2(t.mesh->uv0[t.at[2]]), m) *
                Vec2(ref.scale);
            const Real c = std::cos(Real(ref.rotation)), s = std::sin(Real(ref.rotation));
            return Vec2(c * raw.x + s * raw.y, c * raw.y - s * raw.x) + Vec2(ref.offset);
        };
        Meeting beside{}, below{};
        const int other_x = x ^ 1, other_y = y ^ 1;
        meet(ray_through(camera, size, other_x, y), t, beside);
        meet(ray_through(camera, size, x, other_y), t, below);
        const glm::dvec2 dx((uv(beside) - uv(here)) * Real(other_x - x)),
            dy((uv(below) - uv(here)) * Real(other_y - y));
        return reference::sample(list[ref.texture], glm::dvec2(uv(here)), dx, dy);
    }

    /// The fragments of a pixel; false where rounding may decide: an edge, a plane or a tie is too close.
    bool fragments(int x, int y, std::vector<Fragment>& out) const {
        const Ray ray = ray_through(camera, size, x, y);
        out.clear();
        for (std::uint32_t p = 0; p < triangles.size(); ++p) {
            const Triangle& t = triangles[p];
            Meeting m{};
            if (!meet(ray, t, m)) continue;
            const bool orthographic = camera.projection == Projection::orthographic;
            const Real far = orthographic ? camera.far : 1e30L;
            const bool in_depth = m.t > camera.near && m.t < far;
            const Real edge = std::min({std::abs(m.margin), std::abs(m.t - camera.near), std::abs(m.t - far)});
            if (edge < 1e-7L && m.margin > -1e-6L && m.t > 0) return false;
            if (m.margin < 0 || !in_depth) continue;
            const Vec3 outward = glm::cross(t.v[1] - t.v[0], t.v[2] - t.v[0]);
            const Real facing = glm::dot(outward, ray.direction);
            if (std::abs(facing) < 1e-9L * glm::length(outward) * glm::length(ray.direction)) return false;
            const bool front = (facing < 0) != t.mirrored;
            const Material& material = *t.material;
            if (!front && !material.double_sided) continue;
            glm::dvec4 base(material.base_color);
            if (!t.mesh->colors.empty())
                base *= glm::dvec4(mix3(glm::vec<4, Real>(t.mesh->colors[t.at[0]]),
                                        glm::vec<4, Real>(t.mesh->colors[t.at[1]]),
                                        glm::vec<4, Real>(t.mesh->colors[t.at[2]]), m));
            if (material.base_color_texture.used()) base *= look_up(textures, material.base_color_texture, t, x, y, m);
            if (material.alpha_mode == AlphaMode::mask) {
                if (std::abs(base.a - material.alpha_cutoff) < 1e-9) return false;
                if (base.a < material.alpha_cutoff) continue;
            }
            Fragment f{.primitive = p, .instance = t.instance, .opaque = material.alpha_mode != AlphaMode::blend};
            f.depth = static_cast<double>(orthographic ? (far - m.t) / (far - camera.near) : camera.near / m.t);
            f.alpha = f.opaque ? 1.0 : std::clamp(base.a, 0.0, 1.0);
            f.radiance = glm::dvec3(base);
            if (!material.unlit) {
                const auto normal_of = [&](int c) {
                    return glm::normalize(t.normals * Vec3(t.mesh->normals[t.at[c]]));
                };
                const Vec3 mean = mix3(normal_of(0), normal_of(1), normal_of(2), m);
                Vec3 n = mean;
                if (material.normal_texture.used()) {
                    const auto tangent_of = [&](int c) {
                        return glm::normalize(t.axes * Vec3(t.mesh->tangents[t.at[c]]));
                    };
                    const Vec3 tangent = mix3(tangent_of(0), tangent_of(1), tangent_of(2), m);
                    const Real hand = t.mesh->tangents[t.at[0]].w * (t.mirrored ? -1 : 1);
                    const Vec3 texel = Vec3(look_up(maps, material.normal_texture, t, x, y, m)) * Real(2) - Vec3(1);
                    n = tangent * (texel.x * material.normal_scale) +
                        glm::cross(mean, tangent) * (hand * texel.y * material.normal_scale) + mean * texel.z;
                }
                n = glm::normalize(n) * Real(front ? 1 : -1);
                const Vec3 point = ray.origin + ray.direction * m.t;
                const reference::Surface<double> surface{.normal = glm::dvec3(n),
                                                         .base_color = glm::dvec3(base),
                                                         .metallic = material.metallic,
                                                         .roughness = material.roughness,
                                                         .emissive = glm::dvec3(material.emissive)};
                const Vec3 to_eye = orthographic ? -ray.direction : glm::normalize(ray.origin - point);
                f.radiance = reference::surface_radiance(surface, glm::dvec3(point), glm::dvec3(to_eye), lights,
                                                         {0.1, 0.2, 0.3});
            }
            out.push_back(f);
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const Fragment& a, const Fragment& b) { return a.depth > b.depth; });
        for (std::size_t i = 0; i + 1 < out.size(); ++i)
            if (out[i].depth - out[i + 1].depth < 2e-7 * out[i].depth) return false;  // may be one float
        const auto opaque = std::find_if(out.begin(), out.end(), [](const Fragment& f) { return f.opaque; });
        if (opaque != out.end()) out.erase(opaque + 1, out.end());
        return true;
    }
};

glm::vec3 random_vec3(Random& random, double low, double high) {
    return {static_cast<float>(random.uniform(low, high)), static_cast<float>(random.uniform(low, high)),
            static_cast<float>(random.uniform(low, high))};
}

/// A few meshes of a few triangles each, with every kind of material, placed by any kind of matrix, mirrored too.
Scene random_scene(Random& random) {
    Scene scene;
    for (int k = 0; k < 2; ++k) {
        Image8 image(16, 8, 4);
        for (std::uint8_t& code : image.data) code = static_cast<std::uint8_t>(random.uniform(k == 0 ? 0 : 90, 256));
        scene.images.push_back({std::move(image), ""});
        TextureSampler sampler;
        sampler.wrap_u = random.uniform() < 0.5 ? TextureWrap::mirror : TextureWrap::repeat;
        scene.textures.push_back({static_cast<std::uint32_t>(k), sampler});
    }
    for (int i = 0; i < 7; ++i) {
        Material m;
        m.base_color = glm::vec4(random_vec3(random, 0, 1), random.uniform(0.1, 1));
        m.metallic = static_cast<float>(random.uniform());
        m.roughness = static_cast<float>(random.uniform(0.2, 1));
        m.emissive = random_vec3(random, 0, 0.5);
        m.alpha_mode = i == 0 ? AlphaMode::opaque : i == 1 ? AlphaMode::mask : AlphaMode::blend;
        m.alpha_cutoff = 0.2f;
        m.double_sided = i % 3 != 0;
        m.unlit = random.uniform() < 0.3;
        if (random.uniform() < 0.5)
            m.base_color_texture = {
                .texture = 0,
                .offset = {0.3f, -0.2f},
                .scale = {static_cast<float>(random.uniform(0.2, 3)), static_cast<float>(random.uniform(0.2, 3))},
                .rotation = static_cast<float>(random.uniform(-4, 4))};
        if (random.uniform() < 0.5) m.normal_texture = {.texture = 1}, m.normal_scale = 0.7f;
        Mesh mesh;
        mesh.material = static_cast<std::uint32_t>(i);
        const auto triangles = static_cast<std::uint32_t>(random.uniform(3, 13));
        const double size = random.uniform() < 0.3 ? 9 : 2.5;  // large ones reach behind the eye
        for (std::uint32_t v = 0; v < 3 * triangles; ++v) {
            mesh.positions.push_back(random_vec3(random, -size, size));
            const glm::dvec3 normal = random.direction(),
                             other = glm::normalize(glm::cross(normal, random.direction()));
            mesh.normals.push_back(glm::vec3(normal));
            mesh.tangents.push_back(glm::vec4(glm::vec3(other), v / 3 % 2 ? 1 : -1));
            mesh.uv0.push_back(glm::vec2(random_vec3(random, -2, 2)));
            if (i % 2) mesh.colors.push_back(glm::vec4(random_vec3(random, 0, 1), random.uniform(0.2, 1)));
            mesh.indices.push_back(v);
        }
        // Normals that agree within a triangle, or interpolation could pass near the zero vector.
        for (std::uint32_t v = 0; v < 3 * triangles; ++v)
            mesh.normals[v] = glm::normalize(mesh.normals[v - v % 3] * 2.0f + 0.5f * mesh.normals[v]);
        update_bounds(mesh);
        scene.materials.push_back(m);
        scene.meshes.push_back(std::move(mesh));
    }
    for (std::uint32_t i = 0; i < 21; ++i) {
        glm::dmat4 world = glm::rotate(at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)),
                                       random.uniform(0, 6), random.direction());
        world = world * scaled(random.uniform(0.4, 1.5), random.uniform(0.4, 1.5), random.uniform() < 0.5 ? 0.8 : -0.8);
        world[1] += 0.3 * world[0];  // sheared
        scene.instances.push_back({i % 7, world});
    }
    scene.lights = varied_scene().lights;
    return scene;
}

}  // namespace

TEST_CASE("reference: the same fragments and the same sum as brute force, pixel for pixel", "[cpu]") {
    Random random(11);
    int compared = 0, passed_over = 0, fragments_seen = 0;
    double worst_depth = 0, worst_radiance = 0, worst_alpha = 0, worst_sum = 0;
    for (int round = 0; round < 12; ++round) {
        const Scene scene = random_scene(random);
        Camera camera{.vertical_fov = random.uniform(0.4, 2), .near = random.uniform(0.05, 1)};
        if (round % 3 == 0) camera = {.projection = Projection::orthographic, .half_height = 2, .near = 0.5, .far = 6};
        camera.world_from_view = look_at(random.direction() * 3.0, random.direction() * 0.3, random.direction());
        const reference::RenderOptions options{
            .size = {21, 16}, .background = {0.3, 0.6, 0.9}, .lights = scene.lights, .ambient = {0.1, 0.2, 0.3}};
        Oracle oracle{.scene = &scene, .camera = camera, .size = options.size, .lights = scene.lights};
        oracle.gather();
        const reference::Picture picture = must(reference::render(scene, camera, options));
        std::vector<Fragment> expected;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 21; ++x) {
                if (!oracle.fragments(x, y, expected)) {
                    ++passed_over;
                    continue;
                }
                ++compared;
                CAPTURE(round, x, y);
                const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
                const std::vector<Fragment> found = must(reference::fragments_at(scene, camera, options, column, row));
                REQUIRE(found.size() == expected.size());
                Real left = 1;
                Vec3 sum(0);
                for (std::size_t i = 0; i < found.size(); ++i) {
                    ++fragments_seen;
                    REQUIRE(found[i].primitive == expected[i].primitive);
                    REQUIRE(found[i].instance == expected[i].instance);
                    REQUIRE(found[i].opaque == expected[i].opaque);
                    worst_depth = std::max(worst_depth, std::abs(found[i].depth - expected[i].depth));
                    worst_alpha = std::max(worst_alpha, std::abs(found[i].alpha - expected[i].alpha));
                    for (int c = 0; c < 3; ++c)
                        worst_radiance =
                            std::max(worst_radiance, std::abs(found[i].radiance[c] - expected[i].radiance[c]) /
                                                         std::max(1.0, expected[i].radiance[c]));
                    sum += left * Real(expected[i].alpha) * Vec3(expected[i].radiance);
                    left *= 1 - Real(expected[i].alpha);
                }
                sum += left * Vec3(options.background);
                for (int c = 0; c < 3; ++c) {
                    const Real pixel = picture.radiance.texel(column, row)[c];
                    worst_sum =
                        std::max(worst_sum, static_cast<double>(std::abs(pixel - sum[c]) / std::max<Real>(1, sum[c])));
                }
            }
    }
    std::printf(
        "oracle: %d pixels with %d fragments compared, %d too close to call; largest differences: depth %.1e, alpha "
        "%.1e, "
        "radiance %.1e, float picture %.1e\n",
        compared, fragments_seen, passed_over, worst_depth, worst_alpha, worst_radiance, worst_sum);
    CHECK(compared > 3500);
    CHECK(fragments_seen > 3 * compared);
    CHECK(passed_over < 100);
    CHECK(worst_depth < 1e-12);
    CHECK(worst_alpha < 1e-10);
    CHECK(worst_radiance < 1e-10);
    CHECK(worst_sum < 1e-7);  // one rounding to float
}
