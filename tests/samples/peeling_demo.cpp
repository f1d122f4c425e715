// SPDX-License-Identifier: MIT
// The peeling demonstration: a layer alone is the reference renderer's fragment of that number, and nothing else.
#include <cmath>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include "samples/peeling_demo/sheet.hpp"
#include "samples/peeling_demo/stage.hpp"
#include "support/devices.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::samples;

namespace {

/// Premultiplied radiance of these fragments, nearest first, and the share of the light behind that gets through.
glm::dvec4 composited(std::span<const reference::Fragment> fragments) {
    glm::dvec4 sum(0, 0, 0, 1);
    for (const reference::Fragment& f : fragments) {
        sum += glm::dvec4(sum.w * f.premultiplied, 0);
        sum.w *= 1 - f.alpha;
    }
    return sum;
}

/// Pixels that are looked at, and their fragments: as the scene is, and where corners lie on the grid of 1/256 pixel to
/// which devices move them.  A highlight changes so fast across a pixel of the teapot that the two are up to 0.05
/// apart: each pixel is judged by the nearer one (an H100 shows the second, to seven digits).
struct Probe {
    std::uint32_t x, y;
    std::vector<reference::Fragment> fragments, on_grid;
};
std::vector<Probe> probes(const Scene& scene, const Camera& camera, Extent2D size) {
    reference::RenderOptions options{.size = size, .lights = scene.lights, .stability = true};
    const auto picture = test::must(reference::render(scene, camera, options));
    const auto fragments_at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t grid) {
        options.corner_grid = grid;
        return test::must(reference::fragments_at(scene, camera, options, x, y));
    };
    std::vector<Probe> out;
    // Not too many: every one prepares the scene anew.  All deep ones, and some of the others.
    std::size_t seen = 0;
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            if (*picture.stable.texel(x, y) == 0) continue;
            const std::uint32_t layers = *picture.layers.texel(x, y);
            const std::size_t every = layers == 0 ? 1500 : layers > 4 ? 4 : 60;
            if (++seen % every == 0) out.push_back({x, y, fragments_at(x, y, 0), fragments_at(x, y, 256)});
        }
    return out;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("peeling_demo: layers, alone and composited, are the reference's fragments", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{128, 96};
    constexpr std::uint32_t most = 8;
    const Scene scene = make_peeling_scene();
    const Camera camera = scene.cameras.front();
    static const std::vector<Probe> all = probes(scene, camera, size);
    const auto stage = test::must(PeelingStage<TestType>::create(*device, scene, size));
    (void)test::must(stage->draw(camera));
    const std::uint32_t deepest = stage->layers();
    CHECK(deepest >= 6);
    CHECK(deepest < most);
    double worst = 0, worst_share = 0;
    std::size_t compared[most] = {}, empty = 0;
    for (const bool alone : {true, false})
        for (std::uint32_t k = 0; k < most; ++k) {
            (void)test::must(stage->draw(camera, {.first = alone ? k : 0, .end = k + 1}));
            const ImageF got = test::must(stage->read_layers());
            for (const Probe& p : all) {
                const std::size_t last = std::min<std::size_t>(k + 1, p.fragments.size());
                const std::size_t first = alone ? std::min<std::size_t>(k, last) : 0;
                REQUIRE(p.on_grid.size() == p.fragments.size());
                const glm::dvec4 wanted = composited(std::span(p.fragments).subspan(first, last - first));
                const glm::dvec4 moved = composited(std::span(p.on_grid).subspan(first, last - first));
                const float* t = got.texel(p.x, p.y);
                if (first == last) {
                    ++empty;
                    CHECK((t[0] == 0 && t[1] == 0 && t[2] == 0 && t[3] == 1));
                    continue;
                }
                compared[k] += alone ? 1 : 0;
                worst_share = std::max(worst_share, std::abs(t[3] - wanted.w));
                const auto off = [&](const glm::dvec4& from) {
                    double most_off = 0;
                    for (int c = 0; c < 3; ++c)
                        most_off = std::max(most_off, std::abs(t[c] - from[c]) / (0.01 + from[c]));
                    return most_off;
                };
                worst = std::max(worst, std::min(off(wanted), off(moved)));
            }
        }
    std::printf("%s: %zu pixels, off by %.3g at most (relative), what gets through by %.3g\n", TestType::name,
                all.size(), worst, worst_share);
    for (std::uint32_t k = 0; k < deepest; ++k) std::printf("  layer %u: %zu pixels\n", k + 1, compared[k]);
    CHECK(worst < 1e-3);
    CHECK(worst_share < 1e-6);
    CHECK(empty > 100);
    for (std::uint32_t k = 0; k + 1 < deepest; ++k) CHECK(compared[k] >= 3);
}

TEMPLATE_LIST_TEST_CASE("peeling_demo: all layers composited are the renderer's picture", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = make_peeling_scene();
    const RenderSettings settings{.size = {96, 72},
                                  .transparency = Transparency::peel,
                                  .lighting = LightAssignment::loop,
                                  .background = {0.1f, 0.2f, 0.3f}};
    const auto stage = test::must(PeelingStage<TestType>::create(*device, scene, settings.size, settings.background));
    const auto shot = test::shoot<TestType>(*device, scene, scene.cameras.front(), settings);
    for (const std::uint32_t end : {0u, 20u}) {
        (void)test::must(stage->draw(scene.cameras.front(), {.end = end}));
        CHECK(test::must(stage->read_display()).data == test::must(shot.renderer->read_display()).data);
    }
    (void)test::must(stage->draw(scene.cameras.front(), {.end = 2}));
    CHECK(test::must(stage->read_display()).data != test::must(shot.renderer->read_display()).data);
}

TEMPLATE_LIST_TEST_CASE("peeling_demo: something opaque is refused", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto stage = PeelingStage<TestType>::create(*device, test::varied_scene(), {16, 16});
    REQUIRE_FALSE(stage);
    CHECK(stage.error().code == Errc::invalid_argument);
}

TEST_CASE("peeling_demo: a contact sheet has every picture in its place, and grey between", "[cpu]") {
    std::vector<Image8> pictures;
    for (std::uint8_t i = 0; i < 5; ++i) {
        pictures.emplace_back(3, 2, 4);
        for (std::size_t k = 0; k < pictures.back().data.size(); ++k)
            pictures.back().data[k] = static_cast<std::uint8_t>(40 * i + k);
    }
    const Image8 sheet = contact_sheet(pictures, 3, 2);
    REQUIRE(sheet.width == 3 * 5 + 2);
    REQUIRE(sheet.height == 2 * 4 + 2);
    std::size_t grey = 0;
    for (std::uint32_t y = 0; y < sheet.height; ++y)
        for (std::uint32_t x = 0; x < sheet.width; ++x) {
            const std::uint8_t* t = sheet.texel(x, y);
            const std::uint32_t column = x / 5, row = y / 4, i = row * 3 + column;
            if (x % 5 < 2 || y % 4 < 2 || i >= 5) {
                CHECK((t[0] == 96 && t[1] == 96 && t[2] == 96 && t[3] == 255));
                ++grey;
            } else {
                CHECK(std::equal(t, t + 4, pictures[i].texel(x % 5 - 2, y % 4 - 2)));
            }
        }
    CHECK(grey == 17 * 10 - 5 * 6);
    CHECK(contact_sheet({}, 3).empty());
}
