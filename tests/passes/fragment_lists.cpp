// SPDX-License-Identifier: MIT
// What the lists of fragments hold, read by a walker of the test: every fragment once, in its pixel, in order; each
// tile in the list of its depth; the same in any number of bands.
#include <pellucid/core/half.hpp>
#include <pellucid/passes/fragment_lists.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/shaders/test.hpp>
#include <bit>
#include <random>
#include "support/known_scenes.hpp"
#include "support/pass_stage.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// A fragment as it is stored.
struct Stored {
    glm::uvec4 node{0}, look{0};
    friend bool operator==(const Stored&, const Stored&) = default;
};
struct Found {
    std::vector<std::vector<Stored>> pixels;  ///< rows of pixels, each nearest first
    Image<std::uint32_t> walks;               ///< (class + 1) << 8, and 1 a walk
    Image<std::uint32_t> counts;
    std::size_t bands = 0;
    std::uint64_t bytes = 0;
    friend bool operator==(const Found& a, const Found& b) {
        return a.pixels == b.pixels && a.walks.data == b.walks.data && a.counts.data == b.counts.data;
    }
};

/// Lists the fragments twice, the second time anew, in bands of at most `places`, and walks them.
template <rhi::Backend B>
Found find(typename B::Device& device, const Scene& scene, Extent2D size, FragmentContent content,
           std::uint64_t places = 0) {
    using enum rhi::TextureUsage;
    PassStage<B> stage(device, scene, {.size = size});
    auto count = must(LayerCountPass<B>::create(device, stage.fragments()));
    const std::uint64_t place_bytes = content == FragmentContent::colors ? 16 : 32;
    auto lists = must(FragmentLists<B>::create(
        device, {.fragments = stage.fragments(), .content = content, .memory_budget = places * place_bytes},
        count.counts()));
    Found out;
    std::uint32_t deepest = 0;
    rhi::Unique<typename B::Device, rhi::Texture> found;
    rhi::TextureDesc wide{.format = rhi::Format::rgba32_uint, .usage = storage | copy_source};
    const auto walks = stage.target(rhi::Format::r32_uint, storage | attachment | copy_source, "walks");
    stage.frame(scene.cameras.front(), [&](Frame<B>& f) -> Result<void> {
        const SceneBinding binding = stage.scene().binding();
        count.record(f.commands(), stage.depth(), binding, stage.scene().translucent());
        PELLUCID_CHECK(f.flush());
        for (const gpu::LayerStrip& strip : count.strips()) deepest = std::max(deepest, strip.deepest);
        PELLUCID_TRY(const bool made, lists.prepare(device, count.strips()));
        CHECK(made);
        wide.size = {2 * size.width * deepest, size.height};
        PELLUCID_OWN(found, device, device.make_texture(wide));
        const rhi::GroupDesc desc = lists.walker_group({{0, found}, {5, walks}}, {}, {}, "walker");
        rhi::Unique<typename B::Device, rhi::Group> group;
        PELLUCID_OWN(group, device, device.make_group(desc));
        rhi::Unique<typename B::Device, rhi::Pipeline> pipelines[PELLUCID_LISTS_CLASS_COUNT];
        for (std::uint32_t c = 0; c < PELLUCID_LISTS_CLASS_COUNT; ++c) {
            // With and without the second block a turn: both walk the same.
            const rhi::SpecConstant constants[] = {{2, deepest}, {3, c % 2}};
            PELLUCID_OWN(pipelines[c], device,
                         device.make_pipeline(rhi::ComputePipelineDesc{
                             .compute = lists.lit_later() ? &shaders::test_lists_surfaces_comp
                                                          : &shaders::test_lists_colors_comp,
                             .constants = constants,
                             .pass_group = desc.layout,
                             .scene_group = lists.lit_later() ? scene_group_layout() : rhi::GroupLayout{},
                             .push_bytes = sizeof(gpu::ListBand),
                             .debug_name = "walker"}));
        }
        const rhi::Pipeline each[] = {pipelines[0], pipelines[1], pipelines[2], pipelines[3]};
        for (int again = 0; again < 2; ++again) {  // the second one starts anew
            auto& cmd = f.commands();
            cmd.begin_render({.colors = {{.texture = walks}}, .size = size, .name = "walks"});
            cmd.end_render();
            for (const StripBand& band : lists.bands()) {
                lists.record(cmd, band, stage.depth(), binding, stage.scene().translucent());
                lists.walk(
                    cmd, band, binding,
                    {rhi::use(found, rhi::Access::storage_write), rhi::use(walks, rhi::Access::storage_read_write)},
                    each, group, 0, "walker");
            }
        }
        return f.flush();  // the group and the pipelines go
    });
    out.bands = lists.bands().size();
    out.bytes = lists.bytes();
    out.walks = stage.template read<std::uint32_t>(walks, rhi::Format::r32_uint);
    const ImageF counts = stage.template read<float>(count.counts(), rhi::Format::r32_float);
    const rhi::Texels texels = must(rhi::download<B>(device, found, wide));
    out.counts = Image<std::uint32_t>(size.width, size.height, 1);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            *out.counts.texel(x, y) = static_cast<std::uint32_t>(*counts.texel(x, y));
            std::vector<Stored>& pixel = out.pixels.emplace_back();
            for (std::uint32_t i = 0; i < *out.counts.texel(x, y); ++i) {
                const std::uint32_t at = 2 * (x * deepest + i);
                pixel.push_back({texels.at<glm::uvec4>(at, y), texels.at<glm::uvec4>(at + 1, y)});
            }
        }
    return out;
}

/// Every pixel of a tile that has any fragment was walked once, by the class of its deepest pixel, and no other pixel.
void check_walks(const Found& found) {
    std::size_t wrong = 0;
    for (std::uint32_t top = 0; top < found.walks.height; top += PELLUCID_LAYERS_TILE)
        for (std::uint32_t left = 0; left < found.walks.width; left += PELLUCID_LAYERS_TILE) {
            const std::uint32_t bottom = std::min(top + PELLUCID_LAYERS_TILE, found.walks.height);
            const std::uint32_t right = std::min(left + PELLUCID_LAYERS_TILE, found.walks.width);
            std::uint32_t deepest = 0;
            for (std::uint32_t y = top; y < bottom; ++y)
                for (std::uint32_t x = left; x < right; ++x) deepest = std::max(deepest, *found.counts.texel(x, y));
            const std::uint32_t wanted = deepest == 0 ? 0 : (PELLUCID_LISTS_CLASS(deepest) + 1) << 8 | 1;
            for (std::uint32_t y = top; y < bottom; ++y)
                for (std::uint32_t x = left; x < right; ++x) wrong += *found.walks.texel(x, y) != wanted;
        }
    CHECK(wrong == 0);
}

std::uint32_t unorm16(float v) {
    return static_cast<std::uint32_t>(v * 65535.0f + 0.5f);
}
/// An unlit sheet as the lists hold it, but for its draw order, and a surface's unused normal, roughness and the like.
/// Colours and alpha have few enough bits to be exact.
Stored stored(FragmentContent content, float depth, const glm::vec4& color, std::uint32_t instance) {
    const bool surface = content == FragmentContent::surfaces;
    const auto alpha = static_cast<std::uint32_t>(color.a * (255 * 2056) + 0.5f);
    const glm::vec3 c = surface ? glm::vec3(color) : glm::vec3(color) * color.a;
    // The low bits of alpha are the signs of the halves.
    const std::uint32_t first =
        half_toward_zero(c.r) | (alpha & 1u) << 15 | (half_toward_zero(c.g) | (alpha >> 1 & 1u) << 15) << 16;
    const std::uint32_t second = half_toward_zero(c.b) | (alpha >> 2 & 1u) << 15;
    Stored out{.node = {std::bit_cast<std::uint32_t>(depth), 0, 0, 0}};
    if (surface)
        out.look = {unorm16(color.r) | unorm16(color.g) << 16, unorm16(color.b) | (alpha >> 3) << 16, first,
                    second | instance << 16};
    else
        out.node.z = first, out.node.w = second | (alpha >> 3) << 16;
    return out;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lists hold every fragment in its pixel, in order, and tiles by their depth", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // 0 to 40 layers, at both sides of every class's limit; the last of each is coplanar with the one before it.
    constexpr std::uint32_t layers[] = {0, 0, 1, 4, 5, 8, 9, 16, 17, 40};
    Patches patches("lists", 2, 5);
    struct Drawn {
        std::size_t patch;
        std::uint32_t slot;
    };
    std::vector<Drawn> draws;
    for (std::size_t patch = 0; patch < std::size(layers); ++patch)
        for (std::uint32_t i = 0; i < layers[patch]; ++i)
            draws.push_back({patch, 1 + 5 * (i + 1 == layers[patch] && i > 0 ? i - 1 : i)});
    std::shuffle(draws.begin(), draws.end(), std::mt19937(5));
    // Colours of few bits, so that their products are exact.
    const auto color = [](std::size_t draw) {
        const auto part = [](std::size_t k) { return static_cast<float>(k % 16) / 16.0f; };
        return glm::vec4(part(draw), part(3 * draw + 1), part(7 * draw), draw % 3 ? 0.5f : 0.25f);
    };
    for (std::size_t d = 0; d < draws.size(); ++d) patches.add(draws[d].patch, draws[d].slot, color(d));
    patches.scene().cameras = {patches.known().camera};
    for (const FragmentContent content : {FragmentContent::colors, FragmentContent::surfaces}) {
        std::vector<std::vector<Stored>> wanted(patches.count());
        for (std::size_t patch = 0; patch < patches.count(); ++patch) {
            std::vector<std::size_t> mine;  // farthest first, of one depth the first drawn first
            for (std::size_t d = 0; d < draws.size(); ++d)
                if (draws[d].patch == patch) mine.push_back(d);
            std::stable_sort(mine.begin(), mine.end(),
                             [&](std::size_t a, std::size_t b) { return draws[a].slot < draws[b].slot; });
            for (auto d = mine.rbegin(); d != mine.rend(); ++d)
                wanted[patch].push_back(stored(content, static_cast<float>(draws[*d].slot) / 256.0f, color(*d),
                                               static_cast<std::uint32_t>(*d)));
        }
        const Extent2D size = patches.known().settings.size;
        const Found whole = find<TestType>(*device, patches.scene(), size, content);
        CHECK(whole.bands == 1);
        check_walks(whole);
        std::size_t miscounted = 0, different = 0, disordered = 0;
        for (std::uint32_t y = 0; y < size.height; ++y)
            for (std::uint32_t x = 0; x < size.width; ++x) {
                const std::vector<Stored>& got = whole.pixels[std::size_t{y} * size.width + x];
                const std::vector<Stored>& right = wanted[patches.known().at(x, y)];
                miscounted += got.size() != right.size();
                for (std::size_t i = 0; i < std::min(got.size(), right.size()); ++i) {
                    Stored s = got[i];
                    disordered += i > 0 && s.node.x == got[i - 1].node.x && s.node.y >= got[i - 1].node.y;
                    s.node.y = 0;
                    if (content == FragmentContent::surfaces) s.node.z = s.node.w = 0;
                    different += s != right[i];
                }
            }
        INFO((content == FragmentContent::colors ? "colors" : "surfaces"));
        CHECK(miscounted == 0);
        CHECK(disordered == 0);
        CHECK(different == 0);
        // A strip has 128 pixels; one that has 57 layers is the largest.
        const Found bands = find<TestType>(*device, patches.scene(), size, content, 64 * 57);
        CHECK(bands.bands == 2);  // 5, 13 and 25 layers fit together
        CHECK(bands == whole);
    }
}

TEMPLATE_LIST_TEST_CASE("lists are the same, bit for bit, in any number of bands", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    Scene scene = make_random_quads(64, 3);
    scene.instances.erase(scene.instances.begin());  // the floor
    for (const FragmentContent content : {FragmentContent::colors, FragmentContent::surfaces}) {
        const Found whole = find<TestType>(*device, scene, {60, 61}, content);
        CHECK(whole.bands == 1);
        check_walks(whole);
        std::size_t disordered = 0;
        std::vector<gpu::LayerStrip> strips;
        for (std::uint32_t strip = 0; strip < whole.counts.height; strip += PELLUCID_LAYERS_TILE) {
            strips.emplace_back();
            for (std::uint32_t y = strip; y < std::min(strip + PELLUCID_LAYERS_TILE, whole.counts.height); ++y)
                for (std::uint32_t left = 0; left < whole.counts.width; left += PELLUCID_LAYERS_GROUP) {
                    std::uint32_t deepest = 0;
                    for (std::uint32_t x = left; x < std::min(left + PELLUCID_LAYERS_GROUP, whole.counts.width); ++x)
                        deepest = std::max(deepest, *whole.counts.texel(x, y));
                    strips.back().slots += PELLUCID_LAYERS_GROUP * deepest;
                }
        }
        std::uint64_t places = 0, most = 0;
        for (const gpu::LayerStrip& s : strips) places += s.slots, most = std::max<std::uint64_t>(most, s.slots);
        for (const std::vector<Stored>& pixel : whole.pixels)
            for (std::size_t i = 1; i < pixel.size(); ++i) {
                const auto nearer = std::bit_cast<float>(pixel[i - 1].node.x),
                           farther = std::bit_cast<float>(pixel[i].node.x);
                disordered += !(nearer > farther || (nearer == farther && pixel[i - 1].node.y > pixel[i].node.y));
            }
        CHECK(disordered == 0);
        constexpr std::uint64_t width = 1u << PELLUCID_LISTS_WIDTH_BITS;
        REQUIRE(most <= width);  // so that a budget of `most` places holds every strip
        for (const std::uint64_t budget : {places - 1, places / 3, most}) {
            // An image has whole rows, and at least one.
            const std::uint64_t room = budget > width ? budget - budget % width : budget;
            const Found cut = find<TestType>(*device, scene, {60, 61}, content, budget);
            INFO(budget << " of " << places << " places");
            CHECK(cut.bands > 1);
            CHECK(cut.bands == must(split_strips(strips, room, 16)).size());
            CHECK(cut == whole);
        }
    }
}

TEST_CASE("the turns that a walk takes, and the deepest walk of so many turns", "[cpu]") {
    for (const std::uint32_t visit : {0u, 1u, 12u})
        for (const std::uint32_t layers : {0u, 1u, 16u, 17u, 32u, 33u, 500u, 4096u, 100000u}) {
            // As the shader's loops go: a window of 16 for each 16 layers, and in each all of them, 32 a turn.
            std::uint64_t turns = 0;
            for (std::uint64_t rank = 0; rank < layers; rank += 16) {
                ++turns;
                for (std::uint64_t start = 0; start < layers; start += 32) ++turns;
                turns += std::min<std::uint64_t>(16, layers - rank) * visit;
            }
            INFO(layers << " layers, " << visit << " turns a visit");
            CHECK(walk_turns(layers, visit) == turns);
        }
    for (const std::uint32_t visit : {0u, 1u, 12u})
        for (const std::uint32_t turns : {1u, 2u, 100u, 65535u, 1000000u}) {
            const std::uint32_t most = deepest_walk(turns, visit);
            INFO(turns << " turns, " << visit << " a visit: " << most);
            CHECK(walk_turns(most, visit) <= turns);
            CHECK(walk_turns(most + 1, visit) > turns);
        }
    CHECK(deepest_walk(65535, 0) == 5760);
    CHECK(deepest_walk(0, 12) == 1u << 24);  // no limit but that of the counts
}

TEMPLATE_LIST_TEST_CASE("a pixel deeper than the device can walk is refused with a sentence", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const rhi::DeviceInfo& info = device->info();
    CHECK((info.max_loop_turns == rhi::llvmpipe_loop_turns) == info.software);
    const Scene scene = make_cyclic_triangles();
    PassStage<TestType> stage(*device, scene, {.size = {16, 24}});
    auto count = must(LayerCountPass<TestType>::create(*device, stage.fragments()));
    for (const std::uint32_t visit : {0u, 12u}) {
        auto lists = must(FragmentLists<TestType>::create(
            *device, {.fragments = stage.fragments(), .visit_turns = visit}, count.counts()));
        const std::uint32_t most = deepest_walk(info.max_loop_turns, visit);
        if (info.max_loop_turns == 0) continue;
        std::vector<gpu::LayerStrip> strips(3, {.slots = 8});
        strips[1] = {.deepest = most, .slots = 8 * most};
        CHECK(lists.prepare(*device, strips));
        strips[1] = {.deepest = most + 1, .slots = 8 * (most + 1)};
        const auto refused = lists.prepare(*device, strips);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == Errc::unsupported);
        const std::string& message = refused.error().message;
        INFO(message);
        CHECK(message.find("rows 8 to 15 has " + std::to_string(most + 1) + " translucent") != std::string::npos);
        CHECK(message.find("which sort " + std::to_string(most) + ":") != std::string::npos);
    }
}
