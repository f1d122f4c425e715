// SPDX-License-Identifier: MIT
// The detector against the reference renderer: in random scenes where it says exact, the order in which sorting draws
// is the order of the true depths at every pixel.
#include <algorithm>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/sort_conflicts.hpp>
#include <random>
#include "support/catch.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::add;

namespace {
constexpr std::uint32_t n = 24;

struct Random {
    std::mt19937 engine;
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine()) * 0x1p-32);
    }
    int below(int end) { return static_cast<int>((*this)(0, end)); }
};

/// Translucent bodies and panes of all kinds, turned, stretched and mirrored, often too near to each other.
Scene random_scene(Random& random) {
    Scene scene;
    const int count = 1 + random.below(4);
    const double room = random(0.5, 6);
    for (int i = 0; i < count; ++i) {
        Material m = test::flat({0.5f, 0.5f, 0.5f, 0.5f}, AlphaMode::blend);
        m.double_sided = random.below(4) != 0;
        Mesh mesh;
        switch (random.below(7)) {
            case 0:
                mesh = make_cube(1);
                break;
            case 1:
                mesh = make_uv_sphere(0.6f, 6, 9);
                break;
            case 2:
                mesh = make_icosphere(0.6f, 1);
                break;
            case 3:
                mesh = make_plane(1.2f, 0.8f);
                break;
            case 4:
                mesh = make_torus(0.5f, 0.2f, 9, 6);
                break;
            case 5: {  // a bent sheet
                mesh = make_plane(1.2f, 1.2f);
                mesh.positions[0].y += static_cast<float>(random(-0.5, 0.5));
                break;
            }
            default: {  // a body with a dent or a bump
                mesh = make_icosphere(0.6f, 1);
                mesh.positions[random.engine() % mesh.positions.size()] *= static_cast<float>(random(0.5, 1.5));
                break;
            }
        }
        update_bounds(mesh);
        const auto axis = glm::normalize(glm::dvec3(random(-1, 1), random(-1, 1), random(-1, 1)));
        const double flip = random.below(3) == 0 ? -1 : 1;
        add(scene, std::move(mesh), m,
            test::at(random(-0.8, 0.8), random(-0.8, 0.8), random(-room, room)) *
                glm::rotate(glm::dmat4(1), random.below(3) == 0 ? 0.0 : random(0, 6.3), axis) *
                test::scaled(flip * random(0.2, 1.2), random(0.2, 1.2), random(0.2, 1.2)));
    }
    return scene;
}
Camera random_camera(Random& random) {
    // Mostly from some way off, sometimes from among the bodies.
    const double distance = random.below(4) == 0 ? random(0.1, 2) : random(6, 9);
    Camera camera{.near = random(0.001, 0.5),
                  .world_from_view = look_at({random(-1.5, 1.5), random(-1.5, 1.5), distance}, {0, 0, 0})};
    if (random.below(3) == 0) {
        camera.projection = Projection::orthographic;
        camera.half_width = camera.half_height = random(0.5, 2);
        camera.far = 16;
    }
    return camera;
}

/// How sorting draws: places of instances from the back to the front, by the depth of the middle of their bounds.
std::vector<int> places(const Scene& scene, const Camera& camera) {
    const glm::dmat4 view_from_world = glm::inverse(camera.world_from_view);
    std::vector<double> depth;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::dvec4 middle(0.5 * (glm::dvec3(mesh.lower) + glm::dvec3(mesh.upper)), 1);
        depth.push_back(-(view_from_world * instance.world_from_object * middle).z);
    }
    std::vector<std::size_t> order(depth.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    std::vector<int> place(depth.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
    return place;
}

/// Whether a triangle turns its front to the camera, mirrored instances turned back.
bool front(const Scene& scene, const Camera& camera, std::uint32_t instance, std::uint32_t triangle) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes[placed.mesh];
    const glm::dmat4 view = glm::inverse(camera.world_from_view) * placed.world_from_object;
    glm::dvec3 p[3];
    for (std::uint32_t c = 0; c < 3; ++c)
        p[c] = glm::dvec3(view * glm::dvec4(mesh.positions[mesh.indices[3 * triangle + c]], 1));
    const glm::dvec3 to_eye = camera.projection == Projection::perspective ? -p[0] : glm::dvec3(0, 0, 1);
    const bool mirrored = glm::determinant(glm::dmat3(placed.world_from_object)) < 0;
    return (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), to_eye) > 0) != mirrored;
}
}  // namespace

TEST_CASE("where the detector says exact, sorting draws every pixel from the back to the front", "[cpu]") {
    Random random{std::mt19937(7)};
    int exact = 0, wrong_elsewhere = 0;
    std::size_t pairs_of_instances = 0, pairs_of_sides = 0, ties = 0;
    constexpr int scenes = 2000;
    for (int s = 0; s < scenes; ++s) {
        const Scene scene = random_scene(random);
        const Camera camera = random_camera(random);
        const bool says_exact = find_sort_conflicts(scene, camera, {n, n}).exact();
        exact += says_exact ? 1 : 0;
        std::vector<std::uint32_t> first{0};  // primitive of each instance
        for (const Instance& i : scene.instances)
            first.push_back(first.back() + static_cast<std::uint32_t>(scene.meshes[i.mesh].indices.size() / 3));
        const std::vector<int> place = places(scene, camera);
        const reference::RenderOptions options{.size = {n, n}, .threads = 1};
        const reference::Picture picture = test::must(reference::render(scene, camera, options));
        std::size_t wrong = 0;
        for (std::uint32_t pixel = 0; pixel < n * n; ++pixel) {
            if (picture.layers.data[pixel] < 2) continue;
            struct Drawn {
                int place;
                bool front;
                std::uint32_t primitive;
                float depth;
                [[nodiscard]] auto key() const { return std::tuple(place, front, primitive); }
            };
            std::vector<Drawn> drawn;
            for (const reference::Fragment& f :
                 test::must(reference::fragments_at(scene, camera, options, pixel % n, pixel / n)))
                drawn.push_back({place[f.instance], front(scene, camera, f.instance, f.primitive - first[f.instance]),
                                 f.primitive, static_cast<float>(f.depth)});
            std::sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.key() < b.key(); });
            for (std::size_t i = 1; i < drawn.size(); ++i) {
                const Drawn &behind = drawn[i - 1], &over = drawn[i];
                (behind.place == over.place ? pairs_of_sides : pairs_of_instances) += says_exact ? 1 : 0;
                ties += says_exact && behind.depth == over.depth ? 1 : 0;
                const bool sides_meet = behind.place == over.place && !behind.front && over.front;
                wrong += behind.depth > over.depth || (behind.depth == over.depth && !sides_meet) ? 1 : 0;
            }
        }
        if (says_exact) {
            INFO("scene " << s);
            CHECK(wrong == 0);
        } else {
            wrong_elsewhere += wrong != 0 ? 1 : 0;
        }
    }
    CAPTURE(exact, wrong_elsewhere, pairs_of_instances, pairs_of_sides, ties);
    CHECK(exact > scenes / 6);
    CHECK(wrong_elsewhere > scenes / 6);  // and the scenes are hard enough that there is something to find
    CHECK(pairs_of_instances > 500);
    CHECK(pairs_of_sides > 10000);
}
