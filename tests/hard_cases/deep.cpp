// SPDX-License-Identifier: MIT
// Many thin layers: what is lost in one of them is lost hundreds of times.
#include <algorithm>
#include <numeric>
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// All instances, of one material and where their meshes are, as triangles of one mesh in the same order.
void merge(Scene& scene) {
    Mesh all = scene.meshes.front();
    all.positions.clear();
    all.normals.clear();
    all.indices.clear();
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
        all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
        for (const std::uint32_t i : mesh.indices) all.indices.push_back(first + i);
    }
    update_bounds(all);
    scene.meshes = {all};
    scene.instances = {{0, glm::dmat4(1)}};
}

/// `count` sheets of one colour and alpha a: colour (1 - (1 - a)^n) + (1 - a)^n background.  Drawn nearest, farthest,
/// second nearest, …
KnownScene equal_sheets(std::uint32_t count, float alpha, Extent2D size) {
    const glm::vec3 color{0.75f, 0.3125f, 0.0625f};
    const glm::dvec3 background{0.25, 0.5, 0.125};
    std::vector<Sheet> sheets;
    for (std::uint32_t i = 0; i < count; ++i)
        sheets.push_back({.slot = 1 + (i % 2 ? i / 2 : count - 1 - i / 2), .color = glm::vec4(color, alpha)});
    KnownScene known =
        uniform_scene(std::to_string(count) + " sheets of alpha " + std::to_string(alpha), make_sheets(sheets, 14),
                      size, {std::vector<Layer>(count, straight(glm::vec4(color, alpha))), background, {}});
    const double through = std::pow(1 - static_cast<double>(alpha), count);
    known.pixels[0].radiance = (1 - through) * glm::dvec3(color) + through * background;
    known.settings.background = glm::vec3(background);
    if (count > 64) merge(known.scene);  // a draw a sheet and a layer: validation makes millions of them slow
    return known;
}

/// `count` layers of a single mesh over a small patch, `distinct` depths of them, each with a colour of its own, alpha
/// 1/1024.  Vertex colours repeat with period 16, so the answer is a geometric series for each of the 16.
KnownScene one_mesh(std::uint32_t count, std::uint32_t distinct) {
    Patches patches(std::to_string(count) + " layers in " + std::to_string(distinct) + " depths over a few pixels", 2,
                    1, 14, {0.25f, 0.5f, 0.125f});
    patches.add(0, 1, flat({1, 1, 1, 0x1p-10f}, AlphaMode::blend));
    Mesh& mesh = patches.scene().meshes[0];
    mesh = {};
    const std::uint32_t each = count / distinct;
    std::vector<std::uint32_t> order(count);  // the position from behind that is drawn next
    std::iota(order.begin(), order.end(), 0u);
    // 5 is odd: every depth comes up once a round; within a depth the order of drawing is the order of positions.
    for (std::uint32_t i = 0; i < count; ++i) order[i] = (i * 5 % distinct) * each + i / distinct;
    const auto red_of = [](std::uint32_t position) { return static_cast<float>(position % 16 * 17) / 255.0f; };
    for (const std::uint32_t position : order) {
        // The corner at the top left, 3.2 pixels of 0.25 m each way.
        const auto z = static_cast<float>(-1 + std::ldexp(static_cast<double>(1 + position / each), -14));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec2 p : {glm::vec2(-2, 1), glm::vec2(-2, 0.2f), glm::vec2(-1.2f, 1)})
            mesh.positions.push_back({p, z});
        mesh.normals.insert(mesh.normals.end(), 3, {0, 0, 1});
        mesh.colors.insert(mesh.colors.end(), 3, {red_of(position), 1, 0, 1});
        for (std::uint32_t i = 0; i < 3; ++i) mesh.indices.push_back(first + i);
    }
    mesh.material = 0;
    update_bounds(mesh);
    KnownScene known = patches.known();
    const double a = 0x1p-10, t = 1 - a;
    KnownPixel deep{.behind = glm::dvec3(known.settings.background)};
    for (std::uint32_t i = 0; i < count; ++i) deep.layers.push_back({glm::dvec3(red_of(count - 1 - i), 1, 0) * a, a});
    // Layer i from the front sends a t^i; those of one colour are 16 apart.
    double red = 0;
    for (std::uint32_t i = 0; i < 16; ++i)
        red += a * red_of(15 - i) * std::pow(t, i) * (1 - std::pow(t, count)) / (1 - std::pow(t, 16));
    deep.radiance = glm::dvec3(red, 1 - std::pow(t, count), 0) + std::pow(t, count) * deep.behind;
    known.pixels = {deep, known_pixel({}, deep.behind)};
    known.at = [](std::uint32_t x, std::uint32_t y) { return std::size_t{x + y + 1 < 3.2 ? 0u : 1u}; };
    return known;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: 64, 128 and 512 thin sheets", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const std::uint32_t count : {64u, 128u, 512u})
        for (const float alpha : {1.0f / 255.0f, 0.02f}) {
            if (count == 512 && alpha == 0.02f) continue;  // peeling so many takes seconds: once is enough
            const KnownScene known = equal_sheets(count, alpha, {16, 8});
            check_known(known);
            check_exact<TestType>(*device, known);
            if (count == 128) check_within<TestType>(*device, known, Transparency::dual_peel);
        }
}

TEMPLATE_LIST_TEST_CASE("hard cases: 4096 layers over a few pixels", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene some = one_mesh(4096, 128);
    check_known(some);
    check_exact<TestType>(*device, some, methods_exact(Exactness::yes));
    const KnownScene all = one_mesh(4096, 4096);  // 4096 layers of peeling would take a software driver minutes
    check_known(all);
    check_exact<TestType>(*device, all, {Transparency::abuffer});
    // Finding light among its neighbours takes interleaved lighting more turns of loops than some devices allow: it
    // draws the picture or says so.
    RenderSettings settings = some.settings;
    settings.transparency = Transparency::interleaved;
    const auto renderer = must(Renderer<TestType>::create(*device, some.scene, settings));
    if (const auto drawn = renderer->render(some.camera); drawn) {
        check_picture(must(renderer->read_hdr()), some, Transparency::interleaved, TestType::name,
                      device->info().software);
    } else {
        CHECK(device->info().max_loop_turns != 0);
        CHECK(drawn.error().code == Errc::unsupported);
        INFO(drawn.error().message);
        CHECK(drawn.error().message.find("4096 translucent fragments") != std::string::npos);
    }
}

TEST_CASE("hard cases: deep pixels are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{equal_sheets(128, 0.02f, {16, 8}), one_mesh(512, 64)});
}
