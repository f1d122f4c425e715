// SPDX-License-Identifier: MIT
// What the G-buffer pass stores: coverage, facing, order, normals, and every packed value.
#include <glm/gtc/matrix_transform.hpp>
#include "reference/sampling.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using reference::CompactTexel;
using test::add;
using test::at;

namespace {
constexpr std::uint32_t n = 64;

/// The compact G-buffer of `scene`, seen by an orthographic camera that looks along -z at [-1,1]².
template <rhi::Backend B>
std::vector<CompactTexel> fill(typename B::Device& device, const Scene& scene) {
    return test::shoot<B>(device, scene, test::flat_camera(), test::settings_for(n)).compact();
}
const CompactTexel& middle(const std::vector<CompactTexel>& texels) {
    return texels[n / 2 * n + n / 2];
}
glm::dvec3 normal(const CompactTexel& t) {
    return reference::direction_from_oct32<double>(t.normal);
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("only depth says what is covered, to the pixel", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    add(scene, test::quad(0.5f, 0.25f), test::matte({0, 0, 0}));  // black, at the world's origin
    const auto texels = fill<TestType>(*device, scene);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const bool inside = x >= n / 4 && x < 3 * n / 4 && y >= 3 * n / 8 && y < 5 * n / 8;
            INFO(x << " " << y);
            REQUIRE((texels[y * n + x].depth != 0) == inside);
            // (far - distance) / (far - near) = (20 - 10) / 19
            if (inside) REQUIRE(texels[y * n + x].depth == Approx(10.0 / 19.0).epsilon(1.2e-7));
        }
}

TEMPLATE_LIST_TEST_CASE("counter-clockwise is the front, also of mirrored instances; both sides where asked for",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const glm::dmat4 mirrored = test::scaled(-1, 1, 1),
                     turned = glm::rotate(glm::dmat4(1), 3.14159265358979, {0, 1, 0});
    Material one_side = test::matte({1, 1, 1}), two_sides = one_side;
    two_sides.double_sided = true;
    struct Case {
        const char* what;
        glm::dmat4 world;
        bool two_sided, seen;
    };
    for (const Case& c :
         {Case{"front", glm::dmat4(1), false, true}, Case{"back", turned, false, false},
          Case{"mirrored front", mirrored, false, true}, Case{"mirrored back", mirrored * turned, false, false},
          Case{"mirrored twice", test::scaled(-1, -1, 1), false, true},
          Case{"mirrored in z: turned inside out", test::scaled(1, 1, -1), false, false},
          Case{"front, double-sided", glm::dmat4(1), true, true}, Case{"back, double-sided", turned, true, true},
          Case{"mirrored back, double-sided", mirrored * turned, true, true},
          Case{"mirrored front, double-sided", mirrored, true, true}}) {
        Scene scene;
        add(scene, test::quad(), c.two_sided ? two_sides : one_side, c.world);
        const auto texels = fill<TestType>(*device, scene);
        INFO(c.what);
        CHECK((middle(texels).depth != 0) == c.seen);
        // The normal is on the side that is seen.
        if (c.seen && middle(texels).depth != 0) CHECK(normal(middle(texels)) == glm::dvec3(0, 0, 1));
    }
}

TEMPLATE_LIST_TEST_CASE("of two equal depths the later draw wins", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const glm::dmat4 slanted = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(0.3, 1, 0.1)));
    for (const bool red_first : {true, false}) {
        Scene scene;
        add(scene, test::quad(), test::matte(red_first ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)), slanted);
        add(scene, test::quad(), test::matte(red_first ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)), slanted);
        const auto texels = fill<TestType>(*device, scene);
        const std::uint32_t wanted = red_first ? 0xFFFF0000u : 0xFF0000FFu;
        std::size_t covered = 0, other = 0;
        for (const CompactTexel& t : texels) {
            covered += t.depth != 0;
            other += t.depth != 0 && t.color != wanted;
        }
        CHECK(covered > n * n / 2);
        CHECK(other == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("the alpha mask cuts below its cutoff and nothing else", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const float alpha : {0.0f, 0.49f, 0.5f, 1.0f})
        for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::opaque}) {
            Scene scene;
            Material m = test::matte({1, 1, 1});
            m.base_color.a = alpha;
            m.alpha_mode = mode;
            add(scene, test::quad(), m);
            INFO("alpha " << alpha << ", mode " << static_cast<int>(mode));
            CHECK((middle(fill<TestType>(*device, scene)).depth != 0) == (mode == AlphaMode::opaque || alpha >= 0.5f));
        }
}

TEMPLATE_LIST_TEST_CASE("normals under non-uniform scale, and axis-aligned ones exactly", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    test::Random random(5);
    for (int i = 0; i < 40; ++i) {
        // A rectangle that looks along `n0` in object space, in an object stretched by (1,1,4) and turned.
        const glm::dvec3 n0 = test::tilted({0, 0, 1}, random.uniform(0, 0.9), random.uniform(0, 6.28));
        const glm::dvec3 side = glm::normalize(glm::cross(n0, glm::dvec3(0, 1, 0)));
        Mesh mesh = test::quad(2, 2);
        const glm::dmat3 turn(side, glm::cross(n0, side), n0);
        for (glm::vec3& p : mesh.positions) p = glm::vec3(turn * glm::dvec3(p));
        mesh.normals.assign(4, glm::vec3(n0));
        const bool mirror = i % 4 == 3;
        const glm::dmat4 world = glm::rotate(glm::dmat4(1), random.uniform(-0.3, 0.3), glm::dvec3(0, 1, 0)) *
                                 test::scaled(mirror ? -1 : 1, 1, 4);
        const glm::dvec3 wanted = glm::normalize(glm::transpose(glm::inverse(glm::dmat3(world))) * n0);
        if (wanted.z < 0.1) continue;
        Scene scene;
        add(scene, mesh, test::matte({1, 1, 1}), world);
        const CompactTexel t = middle(fill<TestType>(*device, scene));
        INFO("case " << i);
        REQUIRE(t.depth != 0);
        CHECK(test::degrees_between(normal(t), wanted) <= 0.01);
    }
    // A floor seen from above, a wall and a side wall: exactly their axes.
    const glm::dvec3 axes[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (const glm::dvec3& axis : axes) {
        Scene scene;
        Mesh mesh = test::quad(2, 2);
        mesh.normals.assign(4, glm::vec3(axis));
        add(scene, mesh, test::matte({1, 1, 1}));
        const auto texels = fill<TestType>(*device, scene);
        for (const CompactTexel& t : texels) REQUIRE(normal(t) == axis);
    }
}

TEMPLATE_LIST_TEST_CASE("roughness has 16 bits, metallic 8, flags and occlusion their own", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < n; ++i) {
        Material m = test::matte({1, 1, 1});
        m.roughness = static_cast<float>(i * 1021 + 17) / 65535.0f;  // exactly a code
        m.metallic = static_cast<float>(i * 4) / 255.0f;
        m.unlit = i % 2 == 1;
        wanted.push_back((i * 1021 + 17) | (i * 4) << 16u | (m.unlit ? PELLUCID_GBUFFER_UNLIT << 24u : 0u));
        add(scene, test::quad(1.0f / n, 1), m, at((2.0 * i + 1) / n - 1, 0, 0));
    }
    const auto texels = fill<TestType>(*device, scene);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            INFO(x << " " << y);
            REQUIRE(texels[y * n + x].material == wanted[x]);
            REQUIRE(texels[y * n + x].color >> 24u == 255u);  // no occlusion
        }
}

TEMPLATE_LIST_TEST_CASE("vertex colours k/255 come out exactly, up to the driver's sRGB encoding", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    for (std::uint32_t i = 0; i < 256; ++i) {  // a mosaic of 16 × 16 tiles
        Mesh mesh = test::quad(1.0f / 16, 1.0f / 16);
        const auto k = static_cast<float>(i);
        mesh.colors.assign(4, {k / 255.0f, (255 - k) / 255.0f, 1, 1});
        add(scene, mesh, i % 2 ? test::flat({1, 1, 1, 1}) : test::matte({1, 1, 1}),
            at((2.0 * (i % 16) + 1) / 16 - 1, 1 - (2.0 * (i / 16) + 1) / 16, 0));
    }
    const auto shot = test::shoot<TestType>(*device, scene, test::flat_camera(), test::settings_for(n));
    const auto texels = shot.compact();
    double worst = 0;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t k = y / 4 * 16 + x / 4;
            const CompactTexel& t = texels[y * n + x];
            INFO("k " << k);
            // Drivers round their own approximation of the encoding: software ones are off by up to 0.15 of a code.
            for (const auto& [code, value] : {std::pair{t.color & 0xFFu, k}, {t.color >> 8u & 0xFFu, 255 - k}})
                worst = std::max(worst, std::abs(code - 255 * reference::srgb_from_linear(value / 255.0)));
            REQUIRE((t.color >> 16u & 0xFFu) == 255u);
            if (k % 2 == 0) continue;
            // An unlit surface carries its colour as emitted radiance: k/255 to the last bit that a half keeps.
            const float* hdr = shot.hdr.texel(x, y);
            REQUIRE(hdr[0] == half_to_float(half_toward_zero(static_cast<float>(k) / 255.0f)));
        }
    std::printf("%s: sRGB encoding: %.3f of a code from the exact value\n", TestType::name, worst);
    CHECK(worst <= 0.65);
}

TEMPLATE_LIST_TEST_CASE("both layouts hold the same surface", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::varied_scene();
    RenderSettings settings = test::settings_for(128);
    const Camera camera = test::varied_camera();
    const auto compact = test::shoot<TestType>(*device, scene, camera, settings).compact();
    settings.gbuffer = GBufferLayout::classic;
    const auto classic = test::shoot<TestType>(*device, scene, camera, settings);
    const auto read = [&](std::size_t i) -> rhi::Texels { return test::must(classic.renderer->read_gbuffer(i)); };
    const rhi::Texels position = read(0), normals = read(1), base = read(2), material = read(3);
    const rhi::Texels depth = read(Renderer<TestType>::depth_index);
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
    std::size_t covered = 0;
    double worst_angle = 0, worst_position = 0, worst_roughness = 0;
    for (std::uint32_t y = 0; y < 128; ++y)
        for (std::uint32_t x = 0; x < 128; ++x) {
            const CompactTexel& t = compact[y * 128 + x];
            REQUIRE(t.depth == depth.at<float>(x, y));  // bit for bit
            if (t.depth == 0) continue;
            ++covered;
            REQUIRE((base.at<std::uint32_t>(x, y) & 0xFFFFFFu) == (t.color & 0xFFFFFFu));
            const auto halves = normals.at<std::array<std::uint16_t, 4>>(x, y);
            const glm::dvec3 stored(half_to_float(halves[0]), half_to_float(halves[1]), half_to_float(halves[2]));
            worst_angle = std::max(worst_angle, test::degrees_between(stored, normal(t)));
            const auto m = material.at<std::uint32_t>(x, y);
            // The classic target's code is rounded by the driver, and 127.5 is a tie: an H200 gives 127, Mesa 128.
            const int codes_apart = std::abs(int(m & 0xFFu) - int(t.material >> 16u & 0xFFu));
            REQUIRE(codes_apart <= (device->info().software ? 0 : 1));
            worst_roughness =
                std::max(worst_roughness, std::abs((m >> 8u & 0xFFu) / 255.0 - (t.material & 0xFFFFu) / 65535.0));
            const auto p = position.at<std::array<float, 4>>(x, y);
            const glm::dvec3 view = reference::view_from_depth(
                clip, reference::ndc_from_pixel<double>(x, y, settings.size), double{t.depth});
            const glm::dvec3 world =
                glm::dvec3(camera.world_from_view[3]) + reference::relative_from_view(camera, view);
            worst_position = std::max(worst_position, glm::length(world - glm::dvec3(p[0], p[1], p[2])));
        }
    CHECK(covered > 128 * 128 / 2);
    // Halves toward zero lose up to 2^-10 of a component (0.056° at 45°, less elsewhere), octahedral codes 0.0025°.
    CHECK(worst_angle <= 0.06);
    CHECK(worst_roughness <= 0.5 / 255 + 1e-5);
    CHECK(worst_position <= 5e-6);  // a few ulp of 4 m
}
