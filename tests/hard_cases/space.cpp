// SPDX-License-Identifier: MIT
// Where things are: at the world's origin, at the far plane and far away, scaled, and in pictures as long as there are.
#include <encodings/positions.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include "hard_cases/lit_pixels.hpp"
#include "reference/sampling.hpp"

using namespace pellucid;
using namespace pellucid::test;

TEMPLATE_LIST_TEST_CASE("hard cases: the world's origin is no background", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 64;
    // From 5 mm away, straight down and along the floor.
    for (const glm::dvec3& eye : {glm::dvec3(0, 0.005, 0), glm::dvec3(0.004, 0.003, 0)}) {
        Scene scene;
        add(scene, make_plane(100, 100), matte({1, 1, 1}));
        scene.lights = {{.kind = LightKind::directional, .direction = {0, -1, 0}}};
        const Camera camera{.near = 1e-4, .world_from_view = look_at(eye, {0, 0, 0}, {0, 0, -1})};
        const auto pixels = lit_pixels<TestType>(*device, scene, camera, settings_for(n));
        CHECK(pixels.size() == n * n);
        for (const LitPixel& p : pixels) REQUIRE(is_stored(p.got.x, p.wanted.x, 1e-5));
        // length(position) < 0.001 as a test for the background makes holes in this picture.
        const ClipFromView clip = clip_from_view(camera, {n, n});
        std::size_t holes = 0;
        for (std::uint32_t y = 0; y < n; ++y)
            for (std::uint32_t x = 0; x < n; ++x) {
                const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, {n, n});
                const glm::dvec3 ray =
                    reference::relative_from_view(camera, glm::dvec3(ndc.x / clip.sx, ndc.y / clip.sy, -1));
                holes += glm::length(eye - ray * (eye.y / ray.y)) < 0.001;
            }
        CHECK(holes > 50);
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: black walls up to an ulp before the far plane are no background", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Depth 0, what the buffer is cleared to, is all that says background.
    const Camera camera{.projection = Projection::orthographic, .near = 0, .far = 1};
    for (const double distance : {0.0, 0.5, 1 - 0x1p-24})
        for (const bool unlit : {false, true})
            for (const bool keep_gbuffer : {false, true}) {
                RenderSettings settings = settings_for(16);
                settings.background = {0.25f, 0.5f, 0.75f};
                settings.keep_gbuffer = keep_gbuffer;
                Scene scene;
                Mesh mesh = quad(0.5f, 2);
                for (glm::vec3& p : mesh.positions) p.z = static_cast<float>(-distance);
                update_bounds(mesh);
                add(scene, mesh, unlit ? flat({0, 0, 0, 1}) : matte({0, 0, 0}));
                if (!unlit) scene.lights = {sun_in_the_eye(0)};
                const auto shot = shoot<TestType>(*device, scene, camera, settings);
                std::size_t other = 0;
                for (std::uint32_t i = 0; i < 256; ++i) {
                    const bool inside = i % 16 >= 4 && i % 16 < 12;
                    for (int c = 0; c < 3; ++c)
                        other += shot.hdr.texel(i % 16, i / 16)[c] != (inside ? 0.0f : settings.background[c]);
                }
                INFO("at " << distance << (unlit ? ", unlit" : ", lit") << (keep_gbuffer ? ", kept" : ""));
                CHECK(other == 0);
            }
}

TEMPLATE_LIST_TEST_CASE("hard cases: a wall at 0.99 of a view a million times as deep as near", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr double near = 0.1, far = 1e5, distance = 0.99 * far;
    const RenderSettings settings = settings_for(64);
    const Camera camera{.near = near, .world_from_view = at(0.1, -0.2, 0.3)};
    Scene scene;
    const auto half = static_cast<float>(distance);
    add(scene, quad(half, half), matte({1, 1, 1}), camera.world_from_view * at(0, 0, -distance));
    const auto texels = shoot<TestType>(*device, scene, camera, settings).compact();
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
    const bench::PositionEncoding* standard = nullptr;
    for (const bench::PositionEncoding& e : bench::position_encodings)
        if (std::string(e.name) == "D32F standard") standard = &e;
    REQUIRE(standard != nullptr);
    const bench::PositionView view(camera, settings.size, standard->range, far);
    double worst = 0, worst_standard = 0;
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, settings.size);
            const glm::dvec3 wanted(ndc.x * distance / clip.sx, ndc.y * distance / clip.sy, -distance);
            const float depth = texels[y * 64 + x].depth;
            REQUIRE(depth != 0);
            const auto error = [&](const glm::dvec3& p) { return glm::length(p - wanted) / glm::length(wanted); };
            worst = std::max(worst, error(reference::view_from_depth(clip, ndc, double{depth})));
            worst_standard =
                std::max(worst_standard, error(bench::through_position(*standard, view, glm::vec2(ndc), wanted)));
        }
    std::printf("%s: at 0.99 far: off by %.3g, standard depth by %.3g\n", TestType::name, worst, worst_standard);
    CHECK(worst <= 2.5e-7);
    CHECK(worst_standard > 1e-3);
}

TEST_CASE("hard cases: normals that are scaled like positions", "[cpu]") {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0, 1, 1));
    for (const double mirror : {1.0, -1.0}) {
        const glm::dmat4 stretched = scaled(mirror, 1, 4);
        const glm::dvec3 wanted = glm::normalize(glm::dvec3(0, 4, 1));
        gpu::DrawRecord record{};
        place(record, stretched);
        const auto column = [](const gpu::vec3& v) { return glm::dvec3(v.x, v.y, v.z); };
        const glm::dvec3 ours = column(record.normal_x) * normal.x + column(record.normal_y) * normal.y +
                                column(record.normal_z) * normal.z;
        CHECK(degrees_between(ours, wanted) < 0.01);
        CHECK(degrees_between(glm::dmat3(stretched) * normal, wanted) == Approx(62).margin(0.1));
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: pictures 16384 pixels long", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const std::uint32_t longest = std::min(16384u, device->info().max_texture_size);
    for (const Extent2D size : {Extent2D{longest, 1}, Extent2D{1, longest}}) {
        Scene scene;  // the view is 2 m high and as wide as the picture's shape makes it
        const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
        add(scene, quad(1.25f * aspect, 1.25f), matte({1, 1, 1}));
        scene.lights = {sun_in_the_eye()};
        RenderSettings settings = settings_for(1);
        settings.size = size;
        const auto pixels = lit_pixels<TestType>(*device, scene, flat_camera(), settings);
        INFO(size.width << "x" << size.height);
        CHECK(pixels.size() == longest);
        for (const LitPixel& p : pixels) REQUIRE(is_stored(p.got.x, p.wanted.x, 1e-5));
    }
}
