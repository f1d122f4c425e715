// SPDX-License-Identifier: MIT
// The reference renderer's contract: order and compositing in closed form, layers, stability, threads, errors.
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <pellucid/reference/composite.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;
using reference::Fragment;
using reference::fragments_at;
using reference::Picture;
using reference::render;
using reference::RenderOptions;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

RenderOptions small(glm::dvec3 background = {0, 0, 0}) {
    return {.size = {8, 8}, .background = background};
}
glm::dvec3 pixel(const Picture& p, std::uint32_t x = 3, std::uint32_t y = 4) {
    const float* v = p.radiance.texel(x, y);
    return {v[0], v[1], v[2]};
}
void check_near(glm::dvec3 found, glm::dvec3 expected) {
    for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(expected[c]).epsilon(1.5e-7).margin(1e-30));  // float
}
bool same_bits(const Picture& a, const Picture& b) {
    return a.radiance.data == b.radiance.data && a.layers.data == b.layers.data && a.stable.data == b.stable.data;
}

}  // namespace

TEST_CASE("reference: nothing in the scene is the background, everywhere", "[cpu]") {
    const Picture p =
        must(render({}, flat_camera(), {.size = {5, 3}, .background = {0.25, 1e4, 0}, .stability = true}));
    REQUIRE(p.radiance.width == 5);
    REQUIRE(p.radiance.height == 3);
    for (std::uint32_t i = 0; i < 15; ++i) {
        CHECK(p.radiance.data[3 * i] == 0.25f);
        CHECK(p.radiance.data[3 * i + 1] == 1e4f);
        CHECK(p.layers.data[i] == 0);
        CHECK(p.stable.data[i] == 255);
    }
    CHECK(must(render({}, {}, small())).stable.empty());
    CHECK(must(fragments_at({}, {}, small(), 7, 7)).empty());
}

TEST_CASE("reference: coplanar sheets, the later in front, in either draw order", "[cpu]") {
    for (const double alpha : {0.0, 1 / 255.0, 0.3, 254 / 255.0, 1.0})
        for (const int n : {1, 2, 5, 33})
            for (const bool reversed : {false, true}) {
                CAPTURE(alpha, n, reversed);
                Scene scene;
                std::vector<glm::vec4> colors;
                for (int i = 0; i < n; ++i) {
                    const int k = reversed ? n - 1 - i : i;
                    colors.push_back({0.1f + 0.02f * static_cast<float>(k), 0.9f / static_cast<float>(k + 1), 0.5f,
                                      static_cast<float>(alpha)});
                    add(scene, quad(), flat(colors.back(), AlphaMode::blend));
                }
                const Picture p = must(render(scene, flat_camera(), small({1, 2, 3})));
                // Back to front with "over", which is another formula than the renderer's.
                glm::dvec3 expected(1, 2, 3);
                for (const glm::vec4& c : colors) expected += (glm::dvec3(c) - expected) * static_cast<double>(c.a);
                check_near(pixel(p), expected);
                CHECK(*p.layers.texel(3, 4) == static_cast<std::uint32_t>(n));
                const std::vector<Fragment> f = must(fragments_at(scene, flat_camera(), small(), 3, 4));
                REQUIRE(f.size() == static_cast<std::size_t>(n));
                for (int i = 0; i < n; ++i) {
                    CHECK(f[i].instance == static_cast<std::uint32_t>(n - 1 - i));
                    CHECK(f[i].alpha == static_cast<double>(static_cast<float>(alpha)));
                    CHECK(f[i].depth == 10.0 / 19);
                    CHECK_FALSE(f[i].opaque);
                    CHECK(f[i].premultiplied == f[i].radiance * f[i].alpha);
                }
            }
}

TEST_CASE("reference: an opaque surface in front, behind and in the same plane as sheets", "[cpu]") {
    const glm::vec4 glass(0.2f, 0.4f, 0.6f, 0.25f), wall(0.9f, 0.1f, 0.3f, 0.5f);  // an opaque material's alpha is 1
    const glm::dvec3 over = 0.25 * glm::dvec3(0.2f, 0.4f, 0.6f) + 0.75 * glm::dvec3(0.9f, 0.1f, 0.3f);
    for (const double z : {-1.0, 0.0, 1.0})
        for (const bool opaque_first : {false, true}) {
            CAPTURE(z, opaque_first);
            Scene scene;
            if (opaque_first) add(scene, quad(), flat(wall), at(0, 0, z));
            add(scene, quad(), flat(glass, AlphaMode::blend));
            if (!opaque_first) add(scene, quad(), flat(wall), at(0, 0, z));
            const Picture p = must(render(scene, flat_camera(), small({5, 5, 5})));
            const std::vector<Fragment> f = must(fragments_at(scene, flat_camera(), small(), 2, 2));
            // In the same plane the blended one is in front: it comes later in draw order, whatever the scene's order.
            check_near(pixel(p), z == 1.0 ? glm::dvec3(0.9f, 0.1f, 0.3f) : over);
            CHECK(*p.layers.texel(3, 4) == (z == 1.0 ? 0u : 1u));
            REQUIRE(f.size() == (z == 1.0 ? 1u : 2u));
            CHECK(f.back().opaque);
            CHECK(f.back().alpha == 1);
            CHECK(f.back().primitive < 2);  // opaque ones are numbered first
            if (f.size() == 2) CHECK(f[0].primitive >= 2);
        }
    // Two opaque ones in one plane: the later.
    Scene scene;
    add(scene, quad(), flat({1, 0, 0, 1}));
    add(scene, quad(), flat({0, 1, 0, 1}));
    check_near(pixel(must(render(scene, flat_camera(), small()))), {0, 1, 0});
}

TEST_CASE("reference: depths that are one float are a tie, depths that are two are not", "[cpu]") {
    // Depth (z + 10)/19 = 10/19 + z/19; a float near 0.526 has steps of 6e-8.
    for (const double gap : {1e-12, 1e-9, 1e-5}) {
        Scene scene;
        add(scene, quad(), flat({1, 0, 0, 0.5f}, AlphaMode::blend), at(0, 0, gap));  // nearer, but drawn first
        add(scene, quad(), flat({0, 1, 0, 0.5f}, AlphaMode::blend));
        const bool tie = static_cast<float>((10 + gap) / 19) == static_cast<float>(10.0 / 19);
        CHECK(tie == (gap < 1e-6));
        const std::vector<Fragment> f = must(fragments_at(scene, flat_camera(), small(), 1, 1));
        REQUIRE(f.size() == 2);
        CHECK(f[0].instance == (tie ? 1u : 0u));
    }
}

TEST_CASE("reference: radiance has no upper limit, in front of glass or behind it", "[cpu]") {
    Scene scene;
    Material lamp = flat({0, 0, 0, 1});
    lamp.unlit = false;
    lamp.emissive = {1e4f, 2e5f, 1};
    lamp.base_color = {0, 0, 0, 1};
    add(scene, quad(), lamp, at(0, 0, -1));
    add(scene, quad(), flat({0.5f, 0.5f, 0.5f, 0.5f}, AlphaMode::blend));
    check_near(pixel(must(render(scene, flat_camera(), small()))), {5000.25, 100000.25, 0.75});
    // A blended surface that shines: alpha dims its own light too.
    lamp.base_color.a = 0.25f;
    lamp.alpha_mode = AlphaMode::blend;
    Scene front;
    add(front, quad(), lamp);
    check_near(pixel(must(render(front, flat_camera(), small({8, 8, 8})))), {2506, 50006, 6.25});
}

TEST_CASE("reference: blended surfaces can be left out, and a scene may have none", "[cpu]") {
    Scene scene;
    add(scene, quad(), flat({0.5f, 0.5f, 0.5f, 0.5f}, AlphaMode::blend), at(0, 0, 1));
    add(scene, quad(0.5f, 0.5f), flat({1, 0, 0, 1}));
    RenderOptions without = small({0, 0, 1});
    without.translucent = false;
    const Picture p = must(render(scene, flat_camera(), without));
    check_near(pixel(p), {1, 0, 0});
    check_near(pixel(p, 0, 0), {0, 0, 1});
    for (const std::uint32_t layers : p.layers.data) CHECK(layers == 0);
    Scene opaque_only;
    add(opaque_only, quad(0.5f, 0.5f), flat({1, 0, 0, 1}));
    CHECK(same_bits(p, must(render(opaque_only, flat_camera(), small({0, 0, 1})))));
}

TEST_CASE("reference: lights, ambient and model are the caller's; unlit surfaces ignore them", "[cpu]") {
    Scene scene;
    add(scene, quad(0.5f, 1), matte({0.5f, 0.25f, 1}), at(-0.5, 0, 0));
    add(scene, quad(0.5f, 1), flat({0.5f, 0.25f, 1, 1}), at(0.5, 0, 0));
    scene.lights.push_back({.kind = LightKind::directional, .intensity = 9, .direction = {0, 0, -1}});
    RenderOptions options = small();
    check_near(pixel(must(render(scene, flat_camera(), options)), 1), {0, 0, 0});  // the scene's own are not used
    options.ambient = {1, 2, 3};
    check_near(pixel(must(render(scene, flat_camera(), options)), 1), {0.5, 0.5, 3});
    options.ambient = {0, 0, 0};
    options.lights = scene.lights;
    for (const auto model :
         {reference::BrdfModel::gltf, reference::BrdfModel::seed, reference::BrdfModel::blinn_phong}) {
        options.brdf = model;
        const Picture p = must(render(scene, flat_camera(), options));
        const reference::Surface<double> s{.normal = {0, 0, 1}, .base_color = {0.5, 0.25, 1}};
        check_near(pixel(p, 1), 9.0 * reference::evaluate_brdf(model, s, {0, 0, 1}, {0, 0, 1}).total());
        check_near(pixel(p, 6), {0.5, 0.25, 1});
    }
}

TEST_CASE("reference: a pixel is stable where an edge is more than 1/64 pixel away", "[cpu]") {
    // The right edge of an opaque quad at 0.5 + offset in pixel 4 of 8; its diagonal is half a pixel off the centres.
    for (const double offset : {-1 / 32.0, -1 / 100.0, 1 / 100.0, 1 / 32.0}) {
        Scene scene;
        add(scene, quad(), flat({1, 1, 1, 1}), at((4.5 + offset) / 4 - 2, 0, 0));
        RenderOptions options = small();
        options.stability = true;
        const Picture p = must(render(scene, flat_camera(), options));
        for (std::uint32_t y = 1; y < 8; ++y)
            for (std::uint32_t x = 0; x < 8; ++x) {
                CAPTURE(offset, x, y);
                CHECK((*p.stable.texel(x, y) == 255) == !(x == 4 && std::abs(offset) < 1 / 64.0));
                CHECK(p.radiance.texel(x, y)[0] == ((x + 0.5 < 4.5 + offset) ? 1.0f : 0.0f));
            }
    }
    // Where two triangles meet the primitive changes, also in the middle of a quad: only diagonal steps find this one.
    Scene diagonal;
    add(diagonal, quad(), flat({1, 1, 1, 1}), at(1.25 / 64 * 0.25, 0, 0));
    RenderOptions options = small();
    options.stability = true;
    const Picture across = must(render(diagonal, flat_camera(), options));
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) CHECK((*across.stable.texel(x, y) == 255) == (x != y));
    // Something so small that one of the eight points alone meets it.
    for (int step = 0; step < 9; ++step) {
        Scene speck;
        const double right = step % 3 - 1, up = step / 3 - 1;
        add(speck, quad(1e-3f, 1e-3f), flat({1, 1, 1, 1}), at((right / 64 - 0.5) / 4, (up / 64 + 0.5) / 4, 0));
        const Picture p = must(render(speck, flat_camera(), options));
        for (std::uint32_t y = 0; y < 8; ++y)
            for (std::uint32_t x = 0; x < 8; ++x) CHECK((*p.stable.texel(x, y) == 255) == !(x == 3 && y == 3));
    }
    // Two blended sheets that cross in a line through the middle of pixel 3: their order changes there.
    Scene crossing;
    const Material half = flat({1, 1, 1, 0.5f}, AlphaMode::blend);
    add(crossing, quad(4, 4), half, glm::rotate(at(-0.125, 0, 0), 0.3, glm::dvec3(0, 1, 0)));
    add(crossing, quad(4, 4), half, glm::rotate(at(-0.125, 0, 0), -0.3, glm::dvec3(0, 1, 0)));
    const Picture p = must(render(crossing, flat_camera(), options));
    for (std::uint32_t x = 0; x < 8; ++x) CHECK((*p.stable.texel(x, 1) == 255) == (x != 3));
}

TEST_CASE("reference: a pixel is not stable where a device may order depths otherwise", "[cpu]") {
    const Material half = flat({1, 1, 1, 0.5f}, AlphaMode::blend);
    RenderOptions options = small();
    options.stability = true;
    struct Case {
        double apart, tilt;  // [m], [rad]
        bool stable;
    };
    // A pixel is 1/4 m wide.  Sheets at 45 degrees: moving the corners of both by 1/512 pixel, against each other,
    // moves one through the other if they are 2/4/512 m apart or less.  Moving the sample never does.
    const double slanted = std::numbers::pi / 4, through = 2.0 / 4 / 512;
    for (const Case c :
         {Case{0, 0, true}, Case{1e-9, 0, false}, Case{1e-7, 0, false}, Case{1e-5, 0, true}, Case{0, slanted, true},
          Case{1e-5, slanted, false}, Case{0.98 * through, slanted, false}, Case{1.02 * through, slanted, true}}) {
        Scene scene;
        const auto tilted = [&](double z) { return glm::rotate(at(0.3, 0.2, z), c.tilt, glm::dvec3(0, 1, 0)); };
        add(scene, quad(4, 4), half, tilted(0));
        add(scene, quad(4, 4), half, tilted(c.apart));
        const auto fragments = must(reference::fragments_at(scene, flat_camera(), options, 2, 3));
        REQUIRE(fragments.size() == 2);
        CAPTURE(c.apart, c.tilt, fragments[0].depth, fragments[1].depth);
        const Picture p = must(render(scene, flat_camera(), options));
        CHECK((*p.stable.texel(2, 3) == 255) == c.stable);
    }
}

TEST_CASE("reference: corners move to the nearest point of a grid", "[cpu]") {
    // The right edge at 4.5 + offset/256 of 8 pixels: a centre on it is not covered.
    struct Case {
        double offset;
        bool covered, covered_on_grid;
    };
    for (const Case c :
         {Case{0.3, true, false}, Case{0.7, true, true}, Case{-0.3, false, false}, Case{1, true, true}}) {
        Scene scene;
        add(scene, quad(), flat({1, 1, 1, 1}), at((4.5 + c.offset / 256) / 4 - 2, 0, 0));
        RenderOptions options = small();
        CAPTURE(c.offset);
        CHECK(pixel(must(render(scene, flat_camera(), options)), 4).x == (c.covered ? 1 : 0));
        options.corner_grid = 256;
        CHECK(pixel(must(render(scene, flat_camera(), options)), 4).x == (c.covered_on_grid ? 1 : 0));
    }
    // What is interpolated moves along: a slope whose corners are 0.3/256 pixel beside the grid is where it would be on
    // it.
    Mesh slope = quad(4, 4);
    for (glm::vec3& p : slope.positions) p.z = p.x;
    RenderOptions options = small();
    const auto depth = [&](double offset, std::uint32_t grid) {
        Scene scene;
        add(scene, slope, flat({1, 1, 1, 1}), at(offset / 256 / 4, 0, 0));
        options.corner_grid = grid;
        return must(fragments_at(scene, flat_camera(), options, 3, 4)).front().depth;
    };
    CHECK(depth(0.3, 256) == Approx(depth(0, 0)).epsilon(1e-12));
    CHECK(std::abs(depth(0.3, 0) - depth(0, 0)) > 1e-6 * depth(0, 0));
    CHECK(depth(0, 256) == depth(0, 0));
}

TEST_CASE("reference: fragments_at tells what made the pixel", "[cpu]") {
    const Scene scene = make_demo_scene();
    RenderOptions options{
        .size = {64, 48}, .background = {0.1, 0.2, 0.3}, .lights = scene.lights, .ambient = {0.1, 0.1, 0.1}};
    const Picture p = must(render(scene, scene.cameras[0], options));
    std::uint32_t deepest = 0;
    for (std::uint32_t y = 2; y < 48; y += 9)
        for (std::uint32_t x = 2; x < 64; x += 5) {
            const std::vector<Fragment> f = must(fragments_at(scene, scene.cameras[0], options, x, y));
            reference::Composite c;
            std::uint32_t layers = 0;
            for (std::size_t i = 0; i < f.size(); ++i) {
                c.put_behind(f[i].premultiplied, f[i].alpha);
                layers += !f[i].opaque;
                CHECK(f[i].opaque == (i + 1 == f.size() && f[i].alpha == 1));
                if (i > 0) CHECK(f[i - 1].depth >= f[i].depth);
            }
            const glm::dvec3 sum = c.over(options.background);
            CAPTURE(x, y);
            for (int k = 0; k < 3; ++k) REQUIRE(p.radiance.texel(x, y)[k] == static_cast<float>(sum[k]));
            REQUIRE(*p.layers.texel(x, y) == layers);
            deepest = std::max(deepest, layers);
        }
    CHECK(deepest >= 4);
}

TEST_CASE("reference: the same bits for any number of threads, and again", "[cpu]") {
    const Scene scene = make_demo_scene();
    RenderOptions options{.size = {113, 77}, .lights = scene.lights, .stability = true, .threads = 1};
    const Picture one = must(render(scene, scene.cameras[0], options));
    for (const std::uint32_t threads : {0u, 1u, 2u, 3u, 16u, ~0u}) {
        options.threads = threads;
        CHECK(same_bits(one, must(render(scene, scene.cameras[0], options))));
    }
}

TEST_CASE("reference: progress rises to 1, one call at a time", "[cpu]") {
    struct Told {
        std::atomic<int> inside{0};
        std::vector<double> fractions;
        bool alone = true;
    } told;
    RenderOptions options{.size = {200, 170}};
    options.user = &told;
    options.progress = [](void* user, double fraction) {
        auto& t = *static_cast<Told*>(user);
        t.alone = t.alone && t.inside.fetch_add(1) == 0;
        t.fractions.push_back(fraction);
        t.inside.fetch_sub(1);
    };
    (void)must(render(make_demo_scene(), {.world_from_view = at(0, 2, 9)}, options));
    CHECK(told.alone);
    REQUIRE(told.fractions.size() > 10);
    CHECK(told.fractions.front() > 0);
    CHECK(told.fractions.back() == 1);
    for (std::size_t i = 1; i < told.fractions.size(); ++i) CHECK(told.fractions[i] > told.fractions[i - 1]);
}

TEST_CASE("reference: what it cannot draw it says in one sentence", "[cpu]") {
    Scene scene;
    add(scene, quad(), flat({1, 1, 1, 1}));
    const auto says = [&](const Camera& camera, const RenderOptions& options, const char* words) {
        const auto picture = render(scene, camera, options);
        const auto fragments = fragments_at(scene, camera, options, 0, 0);
        INFO((picture ? "no error" : picture.error().message));
        CHECK_FALSE(picture);
        if (picture) return;
        CHECK(picture.error().code == Errc::invalid_argument);
        CHECK(picture.error().message.find(words) != std::string::npos);
        CHECK_FALSE(fragments);
    };
    says(flat_camera(), {.size = {0, 8}}, "0x8; each side must be 1 to 16384");
    says(flat_camera(), {.size = {8, 20000}}, "8x20000");
    says(flat_camera(), {.background = {0, infinity, 0}}, "background");
    says(flat_camera(), {.ambient = {0, 0, std::nan("")}}, "ambient");
    says(flat_camera(), {.corner_grid = 65537}, "65537 steps a pixel");
    says(flat_camera(), {.lights = {{}, {.intensity = -1, .name = "lamp"}}}, "light 1 (\"lamp\"): its intensity");
    Camera camera{.name = "front"};
    camera.world_from_view[3][0] = std::nan("");
    says(camera, small(), "the camera \"front\": an element of world_from_view");
    camera.world_from_view = scaled(2, 2, 2);
    says(camera, small(), "not rigid");
    camera.world_from_view = scaled(-1, 1, 1);
    says(camera, small(), "not rigid");
    camera = {.vertical_fov = 3.2};
    says(camera, small(), "vertical_fov");
    camera = {.near = 0};
    says(camera, small(), "near");
    camera = flat_camera();
    camera.half_height = -1;
    says(camera, small(), "half_height");
    camera = flat_camera();
    camera.far = camera.near;
    says(camera, small(), "far");
    scene.instances[0].world_from_object[2][1] = infinity;
    says(flat_camera(), small(), "instance 0: an element of world_from_object");
    const auto outside = fragments_at({}, flat_camera(), small(), 8, 0);
    REQUIRE_FALSE(outside);
    CHECK(outside.error().message.find("(8, 0)") != std::string::npos);
}
