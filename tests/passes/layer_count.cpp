// SPDX-License-Identifier: MIT
// Counts of fragments: exact, whatever the alpha, and summed by strips of eight rows.
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/reference/renderer.hpp>
#include "support/known_scenes.hpp"
#include "support/pass_stage.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

struct Counted {
    Image<std::uint32_t> counts;
    std::vector<gpu::LayerStrip> strips;
    std::vector<std::uint32_t> tile_depths;
    LayerTotals totals;
};

template <rhi::Backend B>
Counted count(typename B::Device& device, const Scene& scene, const Camera& camera, Extent2D size,
              float opaque_depth = 0) {
    PassStage<B> stage(device, scene, {.size = size, .opaque_depth = opaque_depth});
    auto pass = must(LayerCountPass<B>::create(device, stage.fragments()));
    for (int frame = 0; frame < 2; ++frame)  // the second one starts anew
        stage.frame(camera, [&](Frame<B>& f) -> Result<void> {
            pass.record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
            return {};
        });
    Counted out{.counts = Image<std::uint32_t>(size.width, size.height, 1),
                .strips = {pass.strips().begin(), pass.strips().end()},
                .tile_depths = {pass.tile_depths().begin(), pass.tile_depths().end()},
                .totals = pass.totals()};
    const ImageF counts = stage.template read<float>(pass.counts(), rhi::Format::r32_float);
    for (std::size_t i = 0; i < counts.data.size(); ++i) {
        out.counts.data[i] = static_cast<std::uint32_t>(counts.data[i]);
        REQUIRE(static_cast<float>(out.counts.data[i]) == counts.data[i]);
    }
    return out;
}

/// The strips' sums, from the counts.
void check_sums(const Counted& counted) {
    const Image<std::uint32_t>& counts = counted.counts;
    LayerTotals totals;
    REQUIRE(counted.strips.size() == (counts.height + 7) / 8);
    for (std::uint32_t s = 0; s < counted.strips.size(); ++s) {
        gpu::LayerStrip wanted{};
        for (std::uint32_t y = 8 * s; y < std::min(8 * s + 8, counts.height); ++y)
            for (std::uint32_t first = 0; first < counts.width; first += 8) {
                std::uint32_t deepest = 0;
                for (std::uint32_t x = first; x < std::min(first + 8, counts.width); ++x) {
                    const std::uint32_t n = *counts.texel(x, y);
                    wanted.fragments += n;
                    wanted.covered += n > 0;
                    deepest = std::max(deepest, n);
                }
                wanted.deepest = std::max(wanted.deepest, deepest);
                wanted.slots += 8 * deepest;
            }
        const gpu::LayerStrip& got = counted.strips[s];
        INFO("strip " << s);
        CHECK(got.fragments == wanted.fragments);
        CHECK(got.deepest == wanted.deepest);
        CHECK(got.covered == wanted.covered);
        CHECK(got.slots == wanted.slots);
        totals.fragments += wanted.fragments;
        totals.pixels += wanted.covered;
        totals.deepest = std::max(totals.deepest, wanted.deepest);
    }
    const std::uint32_t columns = (counts.width + 7) / 8;
    std::vector<std::uint32_t> depths(std::size_t{columns} * counted.strips.size());
    for (std::uint32_t y = 0; y < counts.height; ++y)
        for (std::uint32_t x = 0; x < counts.width; ++x) {
            std::uint32_t& depth = depths[y / 8 * columns + x / 8];
            depth = std::max(depth, *counts.texel(x, y));
        }
    CHECK(counted.tile_depths == depths);
    CHECK(counted.totals.fragments == totals.fragments);
    CHECK(counted.totals.pixels == totals.pixels);
    CHECK(counted.totals.deepest == totals.deepest);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("counts are those of the reference renderer, and strips add them up", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    struct Case {
        const char* what;
        Scene scene;
        Extent2D size;
    };
    Scene quads = make_random_quads(48, 5);
    quads.instances.erase(quads.instances.begin());  // the floor, which is opaque
    const Case cases[] = {{"quads", quads, {96, 64}},
                          {"chain", make_linked_chain(), {65, 33}},
                          {"cycle", make_cyclic_triangles(), {7, 5}},
                          {"chain, one pixel", make_linked_chain(), {1, 1}}};
    for (const Case& c : cases) {
        INFO(c.what);
        const Camera& camera = c.scene.cameras.front();
        const Counted counted = count<TestType>(*device, c.scene, camera, c.size);
        check_sums(counted);
        const auto reference = must(reference::render(c.scene, camera, {.size = c.size, .stability = true}));
        std::size_t unstable = 0, unstable_other = 0, other = 0;
        for (std::size_t i = 0; i < counted.counts.data.size(); ++i) {
            const bool stable = reference.stable.data[i] == 255;
            unstable += !stable;
            (stable ? other : unstable_other) += counted.counts.data[i] != reference.layers.data[i];
        }
        std::printf("%s on %s: %llu fragments, up to %u; of %zu unstable pixels %zu count otherwise\n", c.what,
                    TestType::name, static_cast<unsigned long long>(counted.totals.fragments), counted.totals.deepest,
                    unstable, unstable_other);
        CHECK(other == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("alpha does not count, the opaque depth does", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    std::vector<Sheet> sheets;
    for (std::uint32_t i = 0; i < 10; ++i)
        sheets.push_back({.slot = 20 + 20 * i, .color = {1, 1, 1, static_cast<float>(i % 3) / 2.0f}});
    const Scene scene = make_sheets(sheets);
    // Slot k has depth k/256; the test is greater or equal.
    const std::pair<float, std::uint32_t> cases[] = {{0.0f, 10},        {20.0f / 256, 10}, {20.0f / 256 + 0x1p-24f, 9},
                                                     {100.0f / 256, 6}, {200.0f / 256, 1}, {201.0f / 256, 0},
                                                     {1.0f, 0}};
    for (const auto& [depth, wanted] : cases) {
        const Counted counted = count<TestType>(*device, scene, scene.cameras.front(), {40, 24}, depth);
        INFO("opaque at " << depth);
        CHECK(miscounted(counted.counts, [n = wanted](std::uint32_t, std::uint32_t) { return n; }) == 0);
        CHECK(counted.totals.fragments == std::uint64_t{40} * 24 * wanted);
        check_sums(counted);
    }
}

TEMPLATE_LIST_TEST_CASE("70000 fragments of one pixel are counted to the last", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 70000;  // more than 16 bits hold
    Scene scene = make_sheets({{.slot = 1, .color = {1, 1, 1, 0.5f}}});
    Mesh& mesh = scene.meshes[0];
    // 1.6 pixels of 1/8 m wide and high: it holds the centre of the first one alone.
    mesh.positions = {{-1, 1, -0.5f}, {-1, 0.8f, -0.5f}, {-0.8f, 1, -0.5f}};
    mesh.indices.clear();
    for (std::uint32_t i = 0; i < n; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1, 2});
    update_bounds(mesh);
    const Counted counted = count<TestType>(*device, scene, scene.cameras.front(), {16, 16});
    CHECK(miscounted(counted.counts, [](std::uint32_t x, std::uint32_t y) { return x == 0 && y == 0 ? n : 0u; }) == 0);
    CHECK(counted.totals.fragments == n);
    CHECK(counted.totals.deepest == n);
    CHECK(counted.totals.pixels == 1);
}

TEMPLATE_LIST_TEST_CASE("layers can be asked for after a frame of any method", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_random_quads(24, 9);  // over an opaque floor
    const Extent2D size{64, 48};
    const auto reference = must(reference::render(scene, scene.cameras.front(), {.size = size, .stability = true}));
    Image<std::uint32_t> first;
    for (const Transparency method : all_methods()) {
        RenderSettings settings = settings_for(1);
        settings.size = size;
        settings.transparency = method;
        const auto shot = shoot<TestType>(*device, scene, scene.cameras.front(), settings);
        const Image<std::uint32_t> counts = must(shot.renderer->count_layers());
        INFO(name(method));
        std::size_t other = 0;
        for (std::size_t i = 0; i < counts.data.size(); ++i)
            other += reference.stable.data[i] == 255 && counts.data[i] != reference.layers.data[i];
        CHECK(other == 0);
        if (first.empty()) first = counts;
        CHECK(different(counts, first) == 0);                              // unstable pixels too
        CHECK(different(must(shot.renderer->read_hdr()), shot.hdr) == 0);  // the picture is still there
    }
    RenderSettings settings = settings_for(1);
    settings.size = size;
    settings.transparency = Transparency::none;
    const auto shot = shoot<TestType>(*device, scene, scene.cameras.front(), settings);
    const auto none = must(shot.renderer->count_layers());
    CHECK((none.width == size.width && none.height == size.height && none.channels == 1));
    CHECK(miscounted(none, [](std::uint32_t, std::uint32_t) { return 0u; }) == 0);
}
