// SPDX-License-Identifier: MIT
// Dual depth peeling: two layers a pass, from both ends, exact but for fragments of equal depth.
#include <pellucid/passes/dual_peel.hpp>
#include <pellucid/passes/layer_count.hpp>
#include "support/known_scenes.hpp"
#include "support/pass_stage.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

template <rhi::Backend B>
class DualPeeled {
public:
    PassStage<B> stage;

    DualPeeled(typename B::Device& device, const Scene& scene, typename PassStage<B>::Setup setup,
               std::uint32_t max_passes = 0)
        : stage(device, scene, (setup.method = Transparency::dual_peel, setup)) {
        count_.emplace(must(LayerCountPass<B>::create(device, stage.fragments())));
        using enum rhi::TextureUsage;
        using enum rhi::Format;
        for (std::size_t i = 0; i < 2; ++i) {
            range_[i] = stage.target(rg32_float, attachment | sampled, "range");
            front_[i] = stage.target(rgba32_float, attachment | sampled, "front");
        }
        layer_ = stage.target(rgba32_float, attachment | sampled, "layer");
        back_ = stage.target(rgba32_float, attachment | sampled, "back");
        pass.emplace(must(DualPeelPass<B>::create(device, {.fragments = stage.fragments(), .max_passes = max_passes},
                                                  {.hdr = stage.hdr_target(),
                                                   .opaque = stage.depth(),
                                                   .range = {range_[0], range_[1]},
                                                   .front = {front_[0], front_[1]},
                                                   .layer = layer_,
                                                   .back = back_})));
    }

    ImageF draw(const Camera& camera) {
        stage.frame(camera, [&](Frame<B>& f) -> Result<void> {
            count_->record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
            PELLUCID_CHECK(f.flush());
            pass->record(f.commands(), stage.scene().binding(), stage.scene().translucent(), count_->totals().deepest);
            return {};
        });
        return stage.hdr();
    }

    std::optional<DualPeelPass<B>> pass;

private:
    std::optional<LayerCountPass<B>> count_;
    rhi::Unique<typename B::Device, rhi::Texture> range_[2], front_[2], layer_, back_;
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("dual peeling takes two layers a pass until none is left", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::dvec3 background{0.25, 0.5, 0.125};
    for (const std::uint32_t count : {1u, 2u, 3u, 4u, 5u, 8u, 9u, 131u}) {
        std::vector<Layer> layers;
        const Scene scene = stacked_sheets(count, layers);
        DualPeeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)});
        for (int frame = 0; frame < 2; ++frame) {
            INFO(count << " sheets, frame " << frame);
            check_layers(peeled.draw(scene.cameras.front()), scene, layers, background, Transparency::dual_peel,
                         device->info().software);
            CHECK(peeled.pass->passes() == (count + 1) / 2);
            CHECK_FALSE(peeled.pass->truncated());
        }
    }
}

TEMPLATE_LIST_TEST_CASE("dual peeling with too few passes lacks the layers in the middle", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::dvec3 background{0.25, 0.5, 0.125};
    std::vector<Layer> layers;
    const Scene scene = stacked_sheets(9, layers);
    for (std::uint32_t most = 1; most <= 6; ++most) {
        std::vector<Layer> outer = layers;
        if (2 * most < 9) outer.erase(outer.begin() + most, outer.end() - most);
        DualPeeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)}, most);
        INFO("at most " << most << " passes");
        check_layers(peeled.draw(scene.cameras.front()), scene, outer, background, Transparency::dual_peel,
                     device->info().software);
        CHECK(peeled.pass->passes() == std::min(most, 5u));
        CHECK(peeled.pass->truncated() == (most < 5));
    }
}

TEMPLATE_LIST_TEST_CASE("dual peeling loses all but one of several fragments of equal depth", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Two sheets in one slot: in front of all others, in their middle, behind them, alone.  One remains, with the
    // larger of each channel of colour and alpha.
    const glm::dvec3 background{0.25, 0.5, 0.125};
    const Layer a = straight(sheet_kinds[0]), b = straight(sheet_kinds[1]);
    const Layer most{glm::max(a.color, b.color), std::max(a.alpha, b.alpha)}, other = straight(sheet_kinds[2]);
    struct Case {
        std::vector<Sheet> sheets;
        std::vector<Layer> left;
    };
    const auto pair = [](std::uint32_t slot) {
        return std::vector<Sheet>{{.slot = slot, .color = sheet_kinds[0]}, {.slot = slot, .color = sheet_kinds[1]}};
    };
    const auto with = [&](std::uint32_t slot, std::vector<std::uint32_t> others) {
        std::vector<Sheet> out = pair(slot);
        for (const std::uint32_t o : others) out.push_back({.slot = o, .color = sheet_kinds[2]});
        return out;
    };
    const Case cases[] = {{pair(50), {most}},
                          {with(50, {20, 10}), {most, other, other}},
                          {with(50, {90, 10}), {other, most, other}},
                          {with(50, {90, 80}), {other, other, most}}};
    for (const Case& c : cases) {
        const Scene scene = make_sheets(c.sheets);
        DualPeeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)});
        INFO(c.sheets.size() << " sheets");
        check_layers(peeled.draw(scene.cameras.front()), scene, c.left, background, Transparency::dual_peel,
                     device->info().software);
    }
}

TEMPLATE_LIST_TEST_CASE("dual peeling follows the camera from frame to frame", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_linked_chain();
    const Camera first = scene.cameras.front(), other{.world_from_view = look_at({8, 3, 1}, {0, 0, 0})};
    const Camera away{.world_from_view = look_at({0, 0, 50}, {0, 0, 100})};
    const typename PassStage<TestType>::Setup setup{.size = {64, 64}, .background = {0.25f, 0.5f, 0.125f}};
    DualPeeled<TestType> peeled(*device, scene, setup);
    const ImageF a = peeled.draw(first);
    const std::uint32_t passes = peeled.pass->passes();
    const ImageF b = peeled.draw(other);
    CHECK(peeled.pass->passes() > passes);
    const ImageF nothing = peeled.draw(away);
    CHECK(nothing.texel(9, 9)[1] == 0.5f);
    CHECK(different(peeled.draw(first), a) == 0);
    CHECK(peeled.pass->passes() == passes);
    CHECK(different(DualPeeled<TestType>(*device, scene, setup).draw(other), b) == 0);
}
