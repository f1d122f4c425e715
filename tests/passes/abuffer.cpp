// SPDX-License-Identifier: MIT
// The A-buffer: the same bits in any number of bands, classes of tiles of any depth, and what a budget refuses.
#include <numeric>
#include <pellucid/passes/abuffer.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <random>
#include "support/known_scenes.hpp"
#include "support/pass_stage.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// An A-buffer with the count that it needs, and the scene it draws.
template <rhi::Backend B>
struct Stored {
    PassStage<B> stage;
    LayerCountPass<B> count;
    AbufferPass<B> pass;

    Stored(typename B::Device& device, const Scene& scene, const typename PassStage<B>::Setup& setup,
           AbufferDesc desc = {})
        : stage(device, scene, setup),
          count(must(LayerCountPass<B>::create(device, stage.fragments()))),
          pass(must(AbufferPass<B>::create(device, (desc.fragments = stage.fragments(), desc), stage.hdr_target(),
                                           count.counts()))),
          device_(&device) {}

    ImageF draw(const Camera& camera) {
        stage.frame(camera, [&](Frame<B>& f) -> Result<void> {
            count.record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
            PELLUCID_CHECK(f.flush());
            PELLUCID_CHECK(pass.prepare(*device_, count.strips()));
            // What was drawn before the flush is still there: the frame is one.
            pass.record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
            return {};
        });
        return stage.hdr();
    }
    [[nodiscard]] const FragmentLists<B>& lists() const { return pass.compositor().lists(); }

private:
    typename B::Device* device_;
};

std::uint64_t sum_of_slots(std::span<const gpu::LayerStrip> strips) {
    return std::accumulate(strips.begin(), strips.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const gpu::LayerStrip& s) { return sum + s.slots; });
}
std::uint64_t largest(std::span<const gpu::LayerStrip> strips) {
    std::uint64_t most = 0;
    for (const gpu::LayerStrip& s : strips) most = std::max<std::uint64_t>(most, s.slots);
    return most;
}

/// Translucent rectangles in all directions, without the floor.
Scene quads(std::uint32_t count) {
    Scene scene = make_random_quads(count, 3);
    scene.instances.erase(scene.instances.begin());
    return scene;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("an A-buffer in bands gives the same bits as in one piece", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = quads(64);
    const Camera& camera = scene.cameras.front();
    const typename PassStage<TestType>::Setup setup{.size = {60, 253}, .background = {0.25f, 0.5f, 0.125f}};
    Stored<TestType> whole(*device, scene, setup);
    const ImageF wanted = whole.draw(camera);
    CHECK(whole.lists().bands().size() == 1);
    const std::uint64_t total = sum_of_slots(whole.count.strips()), one = largest(whole.count.strips());
    const std::vector<gpu::LayerStrip> strips(whole.count.strips().begin(), whole.count.strips().end());
    constexpr std::uint64_t node = PELLUCID_LISTS_TEXEL_BYTES, row = node << PELLUCID_LISTS_WIDTH_BITS;
    CHECK(whole.lists().bytes() == (total * node + row - 1) / row * row);
    for (const std::uint64_t places : {total, total - 1, total / 2, total / 8, one}) {
        REQUIRE(places >= one);
        Stored<TestType> banded(*device, scene, setup, {.memory_budget = places * node});
        const ImageF got = banded.draw(camera);
        INFO(places << " of " << total << " places: " << banded.lists().bands().size() << " bands");
        std::printf("%llu of %llu places on %s: %zu bands, pool of %llu bytes\n",
                    static_cast<unsigned long long>(places), static_cast<unsigned long long>(total), TestType::name,
                    banded.lists().bands().size(), static_cast<unsigned long long>(banded.lists().bytes()));
        // The pool has whole rows of texels, and at least one.
        constexpr std::uint64_t width = 1u << PELLUCID_LISTS_WIDTH_BITS;
        const std::uint64_t room = places > width ? places - places % width : places;
        CHECK(banded.lists().bands().size() == must(split_strips(strips, room, node)).size());
        CHECK((banded.lists().bands().size() > 1) == (room < total));
        CHECK(banded.lists().bytes() < places * node + row);  // whole rows of the pool's image
        CHECK(different(got, wanted) == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("a budget below one strip is refused, and the device goes on", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = quads(64);
    RenderSettings settings = settings_for(64);
    settings.transparency = Transparency::abuffer;
    const Camera& camera = scene.cameras.front();
    const ImageF wanted = shoot<TestType>(*device, scene, camera, settings).hdr;
    Stored<TestType> whole(*device, scene, {.size = settings.size});
    (void)whole.draw(camera);
    const std::uint64_t one = largest(whole.count.strips()) * PELLUCID_LISTS_TEXEL_BYTES;
    std::size_t first = 0;
    while (whole.count.strips()[first].slots * std::uint64_t{PELLUCID_LISTS_TEXEL_BYTES} < one) ++first;

    settings.memory_budget = one - 1;
    const auto renderer = must(Renderer<TestType>::create(*device, scene, settings));
    for (int frame = 0; frame < 3; ++frame) {
        const auto refused = renderer->render(camera);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == Errc::invalid_argument);
        const std::string& message = refused.error().message;
        INFO(message);
        CHECK(message.find("rows " + std::to_string(8 * first) + " to " + std::to_string(8 * first + 7)) !=
              std::string::npos);
        CHECK(message.find(std::to_string(one) + " bytes") != std::string::npos);
        CHECK(message.find(std::to_string(one - PELLUCID_LISTS_TEXEL_BYTES) + " bytes") != std::string::npos);
    }
    // Another renderer, then this one with a camera that sees nothing, then everything again.
    settings.memory_budget = one;
    CHECK(different(shoot<TestType>(*device, scene, camera, settings).hdr, wanted) == 0);
    CHECK(renderer->render({.world_from_view = look_at({0, 0, 50}, {0, 0, 100})}));
    CHECK_FALSE(renderer->render(camera));
}

TEMPLATE_LIST_TEST_CASE("pixels of 1 to 40 layers are sorted by tiles of their depth", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    Patches patches("1 to 40 layers", 8, 5, 8, {0.25f, 0.5f, 0.125f});
    std::vector<std::pair<std::size_t, std::uint32_t>> sheets;  // patch and slot
    std::vector<std::vector<Layer>> layers(patches.count());
    const auto color = [](std::size_t patch, std::uint32_t slot) {
        const auto code = [](std::size_t k) { return static_cast<float>(k % 256) / 255.0f; };
        return glm::vec4(code(31 * slot + patch), code(97 * slot), code(57 * slot), code(5 + slot % 40));
    };
    for (std::size_t patch = 0; patch < patches.count(); ++patch)
        for (std::uint32_t i = 0; i <= patch; ++i) sheets.emplace_back(patch, 1 + 6 * i);
    std::shuffle(sheets.begin(), sheets.end(), std::mt19937(11));
    for (const auto& [patch, slot] : sheets) patches.add(patch, slot, color(patch, slot));
    for (std::size_t patch = 0; patch < patches.count(); ++patch) {
        for (std::size_t i = patch + 1; i-- > 0;)
            layers[patch].push_back(straight(color(patch, static_cast<std::uint32_t>(1 + 6 * i))));
        patches.expect(patch, layers[patch]);
    }
    check_exact<TestType>(*device, patches.known(), {Transparency::abuffer});
}

TEMPLATE_LIST_TEST_CASE("an A-buffer ends where less gets through than asked", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const std::uint32_t count : {7u, 40u}) {  // one window of the sort, and several
        std::vector<Sheet> sheets;
        std::vector<Layer> all;
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec4 color{i % 2 ? 1.0f : 0.25f, 0.5f, i % 3 ? 0.125f : 1.0f, 0.5f};
            sheets.push_back({.slot = 1 + i, .color = color});
            all.insert(all.begin(), straight(color));
        }
        const glm::dvec3 background{0.25, 0.5, 0.125};
        const Scene scene = make_sheets(sheets);
        for (const float least : {0.0626f, 0.6f}) {
            std::vector<Layer> some;
            for (double through = 1; some.size() < all.size() && through > least; through *= 0.5)
                some.push_back(all[some.size()]);
            Stored<TestType> stored(*device, scene, {.size = {16, 16}, .background = glm::vec3(background)},
                                    {.min_transmittance = least});
            const ImageF got = stored.draw(scene.cameras.front());
            INFO(count << " sheets, " << some.size() << " composited");
            check_layers(got, scene, some, background, Transparency::abuffer, device->info().software);
            // The promise: no more than that share of the largest radiance behind is lost or gained.
            const glm::dvec3 truth = over(all, background);
            for (int c = 0; c < 3; ++c)
                CHECK(std::abs(got.texel(3, 3)[c] - truth[c]) <= least + 0x1p-9);  // all radiance is at most 1
        }
    }
}

TEMPLATE_LIST_TEST_CASE("an A-buffer grows, shrinks and empties with what the camera sees", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = quads(48);
    const Camera near = scene.cameras.front(), away{.world_from_view = look_at({0, 0, 50}, {0, 0, 100})};
    const Camera far{.world_from_view = look_at({0, 3, 40}, {0, 0, 0})};
    const typename PassStage<TestType>::Setup setup{.size = {64, 64}, .background = {0.25f, 0.5f, 0.125f}};
    Stored<TestType> stored(*device, scene, setup);
    const ImageF nothing = stored.draw(away);
    CHECK(stored.lists().bands().size() == 0);
    CHECK(stored.lists().bytes() == 0);
    for (std::size_t i = 0; i < nothing.data.size(); i += 4)
        REQUIRE((nothing.data[i] == 0.25f && nothing.data[i + 1] == 0.5f && nothing.data[i + 2] == 0.125f));
    const ImageF small = stored.draw(far);
    const std::uint64_t little = stored.lists().bytes();
    const ImageF large = stored.draw(near);
    CHECK(stored.lists().bytes() >= little);
    CHECK(different(large, small) > 1000);
    CHECK(different(stored.draw(far), small) == 0);
    CHECK(different(stored.draw(away), nothing) == 0);
    CHECK(different(stored.draw(near), large) == 0);
    CHECK(different(Stored<TestType>(*device, scene, setup).draw(near), large) == 0);
}
