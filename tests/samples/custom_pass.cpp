// SPDX-License-Identifier: MIT
// The pass of a user's own against its formula, in double, from the same depths and the same picture.
#include <cmath>
#include "samples/custom_pass/edges.hpp"
#include "support/gpu.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::samples;

namespace {

/// The formula of edges.comp.
double line_at(const Image<float>& depth, int x, int y, const gpu::Edges& edges) {
    const auto at = [&](int column, int row) -> double {
        return *depth.texel(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    };
    const int right = static_cast<int>(depth.width) - 1, bottom = static_cast<int>(depth.height) - 1;
    const auto bend = [&](int dx, int dy) {
        const int i = std::clamp(x, dx, right - dx), k = std::clamp(y, dy, bottom - dy);
        const double a = at(i - dx, k - dy), b = at(i, k), c = at(i + dx, k + dy);
        const double nearest = std::max({a, b, c});
        return nearest > 0 ? std::abs(a + c - 2 * b) / nearest : 0;
    };
    const double bent = std::max(bend(1, 0), bend(0, 1));
    return std::clamp((bent - edges.threshold) / edges.softness, 0.0, 1.0) * edges.line.w;
}

template <rhi::Backend B>
struct Drawn {
    Image<float> depth;
    Image8 picture, lines;
};

template <rhi::Backend B>
Drawn<B> draw(typename B::Device& device, const Scene& scene, const Camera& camera, const gpu::Edges& edges) {
    constexpr Extent2D size{150, 96};  // no whole number of groups
    RenderSettings settings{.size = size, .transparency = Transparency::sorted, .keep_gbuffer = true};
    auto renderer = test::must(Renderer<B>::create(device, scene, settings));
    (void)test::must(renderer->render(camera));
    auto pass = test::must(EdgesPass<B>::create(device, renderer->display(), renderer->gbuffer().depth, settings.size));
    test::run(device, [&](auto& commands) { pass.record(commands, edges); });
    return {test::read<float>(device, renderer->gbuffer().depth, size, 1), test::must(renderer->read_display()),
            test::read<std::uint8_t>(device, pass.target(), size, 4)};
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("custom_pass: lines are where its formula has them", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const gpu::Edges edges{.line = {1, 0.25f, 0.5f, 0.75f}};
    const auto drawn = draw<TestType>(*device, test::varied_scene(), test::varied_camera(), edges);
    std::size_t full = 0, part = 0, none = 0;
    double worst = 0;
    for (std::uint32_t y = 0; y < drawn.depth.height; ++y)
        for (std::uint32_t x = 0; x < drawn.depth.width; ++x) {
            const double line = line_at(drawn.depth, static_cast<int>(x), static_cast<int>(y), edges);
            (line == 0 ? none : line == edges.line.w ? full : part) += 1;
            const float color[] = {edges.line.x, edges.line.y, edges.line.z};
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double was = drawn.picture.texel(x, y)[c];
                const double wanted = was + (255.0 * color[c] - was) * line;
                worst = std::max(worst, std::abs(drawn.lines.texel(x, y)[c] - wanted));
            }
            CHECK(drawn.lines.texel(x, y)[3] == 255);
        }
    // Rounded to whole codes.  Depths are subtracted in single precision, which 1 / softness makes larger.
    CHECK(worst <= 0.5 + 255 * 0x1p-22 / edges.softness);
    CHECK(none > 8000);
    CHECK(full > 300);
    CHECK(part > 100);
}

TEMPLATE_LIST_TEST_CASE("custom_pass: a plane has no line, however steep, and a crease has one", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add(scene, make_plane(400, 400), test::matte({0.5f, 0.5f, 0.5f}));
    const Camera low{.near = 0.1, .world_from_view = look_at({0, 1, 0}, {0, 0.6, -4})};
    const gpu::Edges edges{.line = {1, 0, 0, 1}, .threshold = 1e-4f, .softness = 1e-4f};
    const auto red = [](const Image8& picture, std::uint32_t first_row) {
        std::size_t count = 0;
        for (std::uint32_t y = first_row; y < picture.height; ++y)
            for (std::uint32_t x = 0; x < picture.width; ++x) {
                const std::uint8_t* t = picture.texel(x, y);
                count += t[0] == 255 && t[1] == 0 && t[2] == 0;
            }
        return count;
    };
    const auto plane = draw<TestType>(*device, scene, low, edges);
    const std::uint32_t below = 60;  // the horizon is above
    REQUIRE(*plane.depth.texel(0, below) > 0);
    CHECK(*plane.depth.texel(0, 95) > 2 * *plane.depth.texel(0, below));
    CHECK(red(plane.lines, below) == 0);
    CHECK(red(plane.lines, 0) >= 150);  // the horizon
    // A wall on the floor: a line along its foot.
    test::add(scene, test::quad(50, 50), test::matte({0.5f, 0.5f, 0.5f}), test::at(0, 0, -2.5));
    const auto wall = draw<TestType>(*device, scene, low, edges);
    CHECK(red(wall.lines, below) >= 150);
    CHECK(red(wall.lines, below) <= 2 * 150);
}
