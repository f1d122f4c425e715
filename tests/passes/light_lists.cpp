// SPDX-License-Identifier: MIT
// Lists of lights: the same picture as a loop over all lights, bit for bit, for every case and method of transparency;
// and lists that are short.
#include <bit>
#include <cstring>
#include <pellucid/reference/light_lists.hpp>
#include "support/light_cases.hpp"

using namespace pellucid;

namespace {

constexpr LightAssignment with_lists[] = {LightAssignment::tiled, LightAssignment::clustered};

RenderSettings settings_of(const test::LightCase& c, LightAssignment lighting, Transparency transparency) {
    RenderSettings settings = test::settings_for(1);
    settings.size = c.size;
    settings.lighting = lighting;
    settings.transparency = transparency;
    settings.keep_gbuffer = false;
    return settings;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lists give the picture of the loop, bit for bit", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const test::LightCase& c : test::light_cases()) {
        RenderSettings settings = settings_of(c, LightAssignment::loop, Transparency::sorted);
        settings.exact = true;
        const auto loop = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        for (const LightAssignment method : with_lists) {
            settings.lighting = method;
            const auto lists = test::shoot<TestType>(*device, c.scene, c.camera, settings);
            INFO(c.name << ", " << name(method));
            CHECK(test::different_pixels(loop.hdr, lists.hdr) == 0);
            const RenderStats stats = lists.renderer->stats();
            CHECK(stats.lighting == (scene_needs(c.scene, settings).placed == 0 ? LightAssignment::loop : method));
        }
    }
}

TEMPLATE_LIST_TEST_CASE("so they do for every method of transparency, stage, layout and build", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    test::LightCase c{.name = "field", .scene = make_light_field({.lights = 300}), .camera = {}, .size = {96, 60}};
    c.camera = c.scene.cameras.front();
    struct Variant {
        Transparency transparency = Transparency::sorted;
        ShadingStage stage = ShadingStage::compute;
        GBufferLayout layout = GBufferLayout::compact;
        bool exact = true;
    };
    std::vector<Variant> variants{{.stage = ShadingStage::fragment},
                                  {.layout = GBufferLayout::classic},
                                  {.transparency = Transparency::none},
                                  {.exact = false}};
    for (const Transparency method : {Transparency::abuffer, Transparency::peel, Transparency::interleaved,
                                      Transparency::interleaved_skyx, Transparency::dual_peel})
        variants.push_back({.transparency = method});
    variants.push_back({.transparency = Transparency::abuffer, .stage = ShadingStage::fragment});
    for (const Variant& v : variants) {
        RenderSettings settings = settings_of(c, LightAssignment::loop, v.transparency);
        settings.shading = v.stage;
        settings.gbuffer = v.layout;
        settings.exact = v.exact;
        const auto loop = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        for (const LightAssignment method : with_lists) {
            settings.lighting = method;
            const auto lists = test::shoot<TestType>(*device, c.scene, c.camera, settings);
            INFO(name(v.transparency) << ", " << name(v.stage) << ", " << name(v.layout) << ", " << name(method)
                                      << (v.exact ? ", exact" : ""));
            CHECK(test::different_pixels(loop.hdr, lists.hdr) == 0);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("lights follow the camera from frame to frame", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    test::LightCase c{.name = "field", .scene = make_light_field({.lights = 200}), .camera = {}, .size = {64, 48}};
    RenderSettings settings = settings_of(c, LightAssignment::loop, Transparency::sorted);
    settings.exact = true;
    for (const LightAssignment method : with_lists) {
        settings.lighting = method;
        auto moving = test::must(Renderer<TestType>::create(*device, c.scene, settings));
        for (const glm::dvec3 eye : {glm::dvec3(3, 7, 20), glm::dvec3(-9, 3, 4), glm::dvec3(0, 1, 0.5)}) {
            Camera camera = c.scene.cameras.front();
            camera.world_from_view = look_at(eye, {0, 0, 0});
            (void)test::must(moving->render(camera));
            const ImageF seen = test::must(moving->read_hdr());
            CHECK(test::different_pixels(seen, test::shoot<TestType>(*device, c.scene, camera, settings).hdr) == 0);
        }
    }
}

// What is listed against what reaches: nothing is missing (the pictures above say so too, where light is seen), and
// little is listed in vain.
TEMPLATE_LIST_TEST_CASE("lists are short", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    test::LightCase c{.name = "field", .scene = make_light_field({.lights = 2000, .panes = false}), .camera = {}};
    c.camera = c.scene.cameras.front();
    c.size = {160, 96};
    for (const LightAssignment method : with_lists) {
        const RenderSettings settings = settings_of(c, method, Transparency::none);
        const SceneNeeds needs = scene_needs(c.scene, settings);
        const LightGrid& grid = needs.grid;
        REQUIRE_FALSE(grid.empty());
        const auto shot = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        const std::vector<std::uint32_t> words = test::must(shot.renderer->read_light_lists());
        REQUIRE(words.size() * 4 == grid.bytes());
        std::size_t listed = 0, reaching = 0, missing = 0;
        const glm::dmat4 view_from_world = rigid_inverse(c.camera.world_from_view);
        for (std::uint32_t tile = 0; tile < grid.tiles.width * grid.tiles.height; ++tile) {
            const std::uint32_t* const list = &words[std::size_t{tile} * grid.lists * grid.words];
            for (std::uint32_t w = 0; w < grid.words - grid.summaries; ++w) {
                CHECK(((list[w / 32] >> w % 32 & 1u) != 0) == (list[grid.summaries + w] != 0));
                listed += static_cast<std::size_t>(std::popcount(list[grid.summaries + w]));
            }
            const reference::ViewColumn column = reference::view_column(
                c.camera, c.size,
                {tile % grid.tiles.width * PELLUCID_LIGHTS_TILE, tile / grid.tiles.width * PELLUCID_LIGHTS_TILE},
                PELLUCID_LIGHTS_TILE);
            if (method == LightAssignment::clustered)
                for (std::size_t i = 0; i < c.scene.lights.size(); ++i) {
                    const bool in =
                        reference::reaches(column, reference::light_sphere(c.scene.lights[i], view_from_world));
                    const bool is = (list[grid.summaries + i / 32] >> i % 32 & 1u) != 0;
                    reaching += in;
                    missing += in && !is;
                }
        }
        std::printf("%s %s: %.1f lights a tile listed", TestType::name, name(method),
                    static_cast<double>(listed) / (grid.tiles.width * grid.tiles.height));
        if (method == LightAssignment::clustered)
            std::printf(", %.1f reach its column",
                        static_cast<double>(reaching) / (grid.tiles.width * grid.tiles.height));
        std::printf("\n");
        CHECK(missing == 0);
        if (method == LightAssignment::clustered) {
            CHECK(reaching > 0);
            CHECK(static_cast<double>(listed) <= 1.3 * static_cast<double>(reaching));
        } else {
            CHECK(static_cast<double>(listed) / (grid.tiles.width * grid.tiles.height) < 40);
        }
    }
}

TEST_CASE("a method is chosen by the number of lights, and says so", "[cpu]") {
    Scene scene = test::lit_table();
    const auto chosen = [&](std::size_t lights, LightAssignment asked = LightAssignment::automatic) {
        scene.lights.assign(lights, test::lamp({0, 1, 0}, 1));
        return scene_needs(scene, {.size = {64, 64}, .lighting = asked});
    };
    CHECK(chosen(0).assignment == LightAssignment::loop);
    CHECK(chosen(max_looped_lights).assignment == LightAssignment::loop);
    CHECK(chosen(max_looped_lights).grid.empty());
    CHECK(chosen(max_looped_lights + 1).assignment != LightAssignment::loop);
    CHECK_FALSE(chosen(max_looped_lights + 1).grid.empty());
    CHECK(chosen(max_looped_lights + 1).assignment_why.find(std::to_string(max_looped_lights + 1)) == 0);
    CHECK(chosen(3, LightAssignment::tiled).assignment == LightAssignment::tiled);
    CHECK(chosen(3, LightAssignment::tiled).assignment_why.empty());
    // What cannot matter is not built, and the stats say why.
    CHECK(chosen(0, LightAssignment::clustered).assignment == LightAssignment::loop);
    CHECK(chosen(0, LightAssignment::clustered).assignment_why == "there are no point or spot lights");
    scene.lights = {test::lamp({0, 1, 0}, 0)};
    CHECK(scene_needs(scene, {.lighting = LightAssignment::volumes}).assignment == LightAssignment::loop);
    CHECK(scene_needs(scene, {.lighting = LightAssignment::volumes}).assignment_why == "no light has a range");
    for (Material& m : scene.materials) m.unlit = true;
    CHECK(scene_needs(scene, {.lighting = LightAssignment::tiled}).assignment_why == "no light falls on any surface");
}

TEST_CASE("lists have room for every light, and no more than they need", "[cpu]") {
    constexpr std::uint32_t both = PELLUCID_LIGHTS_OPAQUE | PELLUCID_LIGHTS_TRANSLUCENT;
    const auto grid = [](LightAssignment method, std::uint32_t lights, std::uint32_t kinds) {
        return LightGrid::of(method, {33, 16}, lights, kinds);
    };
    CHECK(grid(LightAssignment::loop, 100, both).empty());
    CHECK(grid(LightAssignment::tiled, 0, both).empty());
    CHECK(grid(LightAssignment::tiled, 100, 0).empty());
    const LightGrid tiled = grid(LightAssignment::tiled, 33, both);
    CHECK((tiled.tiles == Extent2D{3, 1}));
    CHECK(tiled.lists == 2);
    CHECK(tiled.words == 3);  // one that summarises, two of 32 lights
    CHECK(tiled.bytes() == 3 * 2 * 3 * 4);
    CHECK(grid(LightAssignment::tiled, 33, PELLUCID_LIGHTS_OPAQUE).lists == 1);
    CHECK(grid(LightAssignment::clustered, 33, both).bytes() == (3 + PELLUCID_LIGHTS_SLICES) * 3 * 4);
    CHECK(grid(LightAssignment::tiled, 1025, both).words == 33 + 2);
}
