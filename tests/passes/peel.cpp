// SPDX-License-Identifier: MIT
// Exact depth peeling: how many layers it finds, where it stops, and what it leaves in single precision.
#include <pellucid/passes/layer_areas.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/passes/peel.hpp>
#include "support/known_scenes.hpp"
#include "support/pass_stage.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

template <rhi::Backend B>
class Peeled {
public:
    PassStage<B> stage;

    Peeled(typename B::Device& device, const Scene& scene, typename PassStage<B>::Setup setup, PeelDesc desc = {})
        : stage(device, scene, (setup.method = Transparency::peel, setup)), device_(&device) {
        using enum rhi::TextureUsage;
        next_ = stage.target(rhi::Format::r32_float, attachment | sampled, "next");
        layer_ = stage.target(rhi::Format::d32_float, attachment, "layer");
        sum_ = stage.target(rhi::Format::rgba32_float, attachment | sampled | copy_source, "sum");
        count_ = stage.target(rhi::Format::r32_float, attachment | copy_source, "count");
        desc.fragments = stage.fragments();
        pass.emplace(must(PeelPass<B>::create(device, desc,
                                              {.hdr = stage.hdr_target(),
                                               .opaque = stage.depth(),
                                               .next = next_,
                                               .layer = layer_,
                                               .sum = sum_,
                                               .count = count_})));
    }

    /// `areas`: what is known of where the layers are.
    ImageF draw(const Camera& camera, const std::vector<rhi::Rect>& areas = {}) {
        submissions = 0;
        stage.frame(camera, [&](Frame<B>& f) -> Result<void> {
            pass->begin(areas);
            for (bool more = true; more; ++submissions) {
                pass->record_layers(f.commands(), stage.scene().binding(), stage.scene().translucent(),
                                    stage.scene().translucent_reversed());
                PELLUCID_CHECK(f.flush());
                PELLUCID_TRY(more, pass->more(*device_));
            }
            pass->composite(f.commands());
            return {};
        });
        return stage.hdr();
    }
    std::vector<rhi::Rect> count_areas(const Camera& camera, Extent2D size) {
        auto count = must(LayerCountPass<B>::create(*device_, stage.fragments()));
        stage.frame(camera, [&](Frame<B>& f) -> Result<void> {
            count.record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
            return {};
        });
        return layer_areas(count.tile_depths(), size);
    }
    /// Colour and transmittance of all layers.
    ImageF sum() { return stage.template read<float>(sum_, rhi::Format::rgba32_float, 4); }

    std::optional<PeelPass<B>> pass;
    int submissions = 0;  ///< of layers in the last frame

private:
    typename B::Device* device_;
    rhi::Unique<typename B::Device, rhi::Texture> next_, layer_, sum_, count_;
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("peeling finds as many layers as there are, in one batch or several", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::dvec3 background{0.25, 0.5, 0.125};
    // A batch starts with 4 layers and doubles up to 64; one more is needed to see that nothing is left.
    for (const std::uint32_t count : {1u, 3u, 4u, 5u, 11u, 12u, 13u, 130u}) {
        std::vector<Layer> layers;
        const Scene scene = stacked_sheets(count, layers);
        Peeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)});
        ImageF first;
        for (int frame = 0; frame < 2; ++frame) {
            const ImageF got = peeled.draw(scene.cameras.front());
            INFO(count << " sheets, frame " << frame);
            check_layers(got, scene, layers, background, Transparency::peel, device->info().software);
            CHECK(peeled.pass->layers() == count);
            CHECK_FALSE(peeled.pass->truncated());
            if (frame == 0) first = got;
            CHECK(different(got, first) == 0);
            if (frame == 1 && count < 64) CHECK(peeled.submissions == 1);  // the first frame taught it
            if (count == 130) CHECK(peeled.submissions > 1);
        }
        // What gets through, to single precision: two roundings a layer, u = 2^-24 each.
        double through = 1;
        for (const Layer& l : layers) through *= 1 - l.alpha;
        const float got = peeled.sum().texel(5, 5)[3];
        CHECK(std::abs(got - through) <= 2 * count * 0x1p-24 * through * 1.001);
    }
}

TEMPLATE_LIST_TEST_CASE("peeling stops at max_layers depths, and says so where that left something out", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Six depths; three sheets share the second and the fifth one.
    std::vector<Sheet> all;
    std::vector<std::vector<Layer>> depths;  // nearest first
    for (std::uint32_t d = 0; d < 6; ++d) {
        depths.emplace_back();
        for (std::uint32_t i = 0; i < (d % 3 == 1 ? 3u : 1u); ++i) {
            all.push_back({.slot = 100 - 10 * d, .color = sheet_kinds[(d + i) % 3]});
            depths.back().insert(depths.back().begin(), straight(sheet_kinds[(d + i) % 3]));
        }
    }
    const Scene scene = make_sheets(all);
    const glm::dvec3 background{0.25, 0.5, 0.125};
    for (std::uint32_t most = 1; most <= 8; ++most) {
        std::vector<Layer> layers;
        for (std::uint32_t d = 0; d < std::min(most, 6u); ++d)
            layers.insert(layers.end(), depths[d].begin(), depths[d].end());
        Peeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)},
                                {.max_layers = most});
        for (int frame = 0; frame < 2; ++frame) {
            INFO("at most " << most << ", frame " << frame);
            check_layers(peeled.draw(scene.cameras.front()), scene, layers, background, Transparency::peel,
                         device->info().software);
            CHECK(peeled.pass->layers() == std::min(most, 6u));
            CHECK(peeled.pass->truncated() == (most < 6));
        }
    }
}

TEMPLATE_LIST_TEST_CASE("layers before the first one that is wanted are peeled and not composited", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Six depths, three sheets at the second and the fifth one; nothing gets through the first one.
    std::vector<Sheet> all;
    std::vector<std::vector<Layer>> depths;  // nearest first
    for (std::uint32_t d = 0; d < 6; ++d) {
        depths.emplace_back();
        for (std::uint32_t i = 0; i < (d % 3 == 1 ? 3u : 1u); ++i) {
            glm::vec4 color = sheet_kinds[(d + i) % 3];
            if (d == 0) color.a = 1;
            all.push_back({.slot = 100 - 10 * d, .color = color});
            depths.back().insert(depths.back().begin(), straight(color));
        }
    }
    const Scene scene = make_sheets(all);
    const glm::dvec3 background{0.25, 0.5, 0.125};
    Peeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)});
    const std::vector<rhi::Rect> areas(6, {.width = 16, .height = 8});  // each layer's
    const auto check = [&](std::uint32_t first, std::uint32_t most) {
        std::vector<Layer> layers;
        for (std::uint32_t d = first; d < std::min(most, 6u); ++d)
            layers.insert(layers.end(), depths[d].begin(), depths[d].end());
        peeled.pass->set_layers(first, most);
        for (const bool known : {false, true}) {
            INFO("from " << first << " to " << most << (known ? ", areas known" : ""));
            check_layers(peeled.draw(scene.cameras.front(), known ? areas : std::vector<rhi::Rect>{}), scene, layers,
                         background, Transparency::peel, device->info().software);
            double through = 1;
            for (const Layer& l : layers) through *= 1 - l.alpha;
            CHECK(peeled.sum().texel(5, 5)[3] == Approx(through).epsilon(1e-6).margin(1e-7));
        }
    };
    for (std::uint32_t k = 0; k < 8; ++k) check(k, k + 1);  // alone; the last two are not there
    check(1, 6);
    check(2, 4);
    check(0, 6);  // and all again
}

TEMPLATE_LIST_TEST_CASE("what is behind something opaque is no layer, and leaving it out truncates nothing", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    std::vector<Layer> layers;
    const Scene scene = stacked_sheets(5, layers);  // in slots 1 to 5
    layers.resize(2);
    const glm::dvec3 opaque{0.25, 0.5, 0.125};
    for (const std::uint32_t most : {0u, 2u}) {
        Peeled<TestType> peeled(*device, scene,
                                {.size = {16, 8}, .background = glm::vec3(opaque), .opaque_depth = 3.5f / 256},
                                {.max_layers = most});
        INFO("at most " << most);
        check_layers(peeled.draw(scene.cameras.front()), scene, layers, opaque, Transparency::peel,
                     device->info().software);
        CHECK(peeled.pass->layers() == 2);
        CHECK_FALSE(peeled.pass->truncated());
    }
}

TEMPLATE_LIST_TEST_CASE("peeling ends where no more gets through than asked", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    std::vector<Sheet> all;
    std::vector<Layer> layers;
    for (std::uint32_t i = 0; i < 20; ++i) {
        const glm::vec4 color{i % 2 ? 1.0f : 0.25f, 0.5f, i % 3 ? 0.125f : 1.0f, 0.5f};
        all.push_back({.slot = 1 + i, .color = color});
        layers.insert(layers.begin(), straight(color));
    }
    const Scene scene = make_sheets(all);
    const glm::dvec3 background{0.25, 0.5, 0.125}, truth = over(layers, background);
    for (const float least : {0.0f, 0.25f, 0.24f, 0.01f, 0.6f}) {  // 2^-2 itself is "no more"
        std::vector<Layer> some;
        for (double through = 1; some.size() < layers.size() && through > least; through *= 0.5)
            some.push_back(layers[some.size()]);
        Peeled<TestType> peeled(*device, scene, {.size = {16, 8}, .background = glm::vec3(background)},
                                {.min_transmittance = least});
        const ImageF got = peeled.draw(scene.cameras.front());
        INFO("least " << least << ", " << some.size() << " layers");
        check_layers(got, scene, some, background, Transparency::peel, device->info().software);
        CHECK(peeled.pass->layers() == some.size());
        for (int c = 0; c < 3; ++c) CHECK(std::abs(got.texel(3, 3)[c] - truth[c]) <= least + 0x1p-10);
    }
}

TEMPLATE_LIST_TEST_CASE("peeling follows the camera from frame to frame", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_linked_chain();
    const Camera first = scene.cameras.front(), other{.world_from_view = look_at({8, 3, 1}, {0, 0, 0})};
    const Camera away{.world_from_view = look_at({0, 0, 50}, {0, 0, 100})};
    const typename PassStage<TestType>::Setup setup{.size = {64, 64}, .background = {0.25f, 0.5f, 0.125f}};
    Peeled<TestType> peeled(*device, scene, setup);
    const ImageF a = peeled.draw(first);
    const std::uint32_t layers = peeled.pass->layers();
    CHECK(layers >= 4);
    const ImageF b = peeled.draw(other);
    CHECK(peeled.pass->layers() > layers);  // along the necklace
    (void)peeled.draw(away);
    CHECK(peeled.pass->layers() == 0);
    CHECK(different(peeled.draw(first), a) == 0);
    CHECK(peeled.pass->layers() == layers);
    CHECK(different(Peeled<TestType>(*device, scene, setup).draw(other), b) == 0);
}

TEMPLATE_LIST_TEST_CASE("drawing layers only where counts say there are any changes no bit", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Extent2D size{72, 52};
    for (const Scene& scene : {make_linked_chain(), make_intersecting_planes(), make_random_quads(24)})
        for (const std::uint32_t most : {0u, 3u}) {
            const typename PassStage<TestType>::Setup setup{.size = size, .background = {0.25f, 0.5f, 0.125f}};
            const Camera& camera = scene.cameras.front();
            Peeled<TestType> whole(*device, scene, setup, {.max_layers = most});
            Peeled<TestType> bounded(*device, scene, setup, {.max_layers = most});
            const std::vector<rhi::Rect> areas = bounded.count_areas(camera, size);
            REQUIRE(areas.size() > 1);
            REQUIRE((areas.back().width < size.width || areas.back().height < size.height));
            const ImageF expected = whole.draw(camera);
            CHECK(different(bounded.draw(camera, areas), expected) == 0);
            CHECK(different(bounded.sum(), whole.sum()) == 0);
            CHECK(bounded.pass->layers() == whole.pass->layers());
            CHECK(bounded.pass->truncated() == whole.pass->truncated());
            // Where no two fragments of the deepest pixel have the same depth, the counts are all there is to know.
            if (most == 0) CHECK(bounded.pass->layers() <= areas.size());
            // Rectangles that leave something out do change the picture: they are heeded.
            std::vector<rhi::Rect> fewer(areas.begin(), areas.begin() + 1);
            CHECK(different(bounded.draw(camera, fewer), expected) > 0);
        }
}
