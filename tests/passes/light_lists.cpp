// SPDX-License-Identifier: MIT
// Lists of lights: the same picture as a loop over all lights, bit for bit, for every case and method of transparency;
// and lists that are short.
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

TEMPLATE_LIST_TEST_CASE("every light that reaches a pixel is listed, and few others are", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    test::LightCase c{.name = "field", .scene = make_light_field({.lights = 2000, .panes = false}), .camera = {}};
    c.camera = c.scene.cameras.front();
    c.size = {160, 96};
    const glm::dmat4 view_from_world = rigid_inverse(c.camera.world_from_view);
    std::vector<reference::LightSphere> spheres;
    for (const Light& light : c.scene.lights) spheres.push_back(reference::light_sphere(light, view_from_world));
    for (const LightAssignment method : with_lists) {
        RenderSettings settings = settings_of(c, method, Transparency::none);
        settings.keep_gbuffer = true;  // to know where pixels are
        const LightGrid grid = scene_needs(c.scene, settings).grid;
        const auto shot = test::shoot<TestType>(*device, c.scene, c.camera, settings);
        const std::vector<std::uint32_t> words = test::must(shot.renderer->read_light_lists());
        const std::vector<reference::CompactTexel> texels = shot.compact();
        REQUIRE(words.size() * 4 == grid.bytes());
        const auto tile_of = [&](std::uint32_t x, std::uint32_t y) {
            return y / PELLUCID_LIGHTS_TILE * grid.tiles.width + x / PELLUCID_LIGHTS_TILE;
        };
        const std::uint32_t tiles = grid.tiles.width * grid.tiles.height;
        const auto has = [&](std::uint32_t tile, std::size_t light) {
            return (words[std::size_t{tile} * grid.words + grid.summaries + light / 32] >> light % 32 & 1u) != 0;
        };
        // Lights that reach the point of a pixel of each tile.
        std::vector<std::vector<bool>> reached(tiles, std::vector<bool>(spheres.size()));
        const reference::ClipCoefficients<double> clip(clip_from_view(c.camera, c.size));
        std::size_t missing = 0;
        for (std::uint32_t y = 0; y < c.size.height; ++y)
            for (std::uint32_t x = 0; x < c.size.width; ++x) {
                const double depth = texels[std::size_t{y} * c.size.width + x].depth;
                if (depth == 0) continue;
                const glm::dvec3 p =
                    reference::view_from_depth(clip, reference::ndc_from_pixel<double>(x, y, c.size), depth);
                for (std::size_t i = 0; i < spheres.size(); ++i)
                    if (glm::distance(p, spheres[i].center) < spheres[i].radius) {
                        reached[tile_of(x, y)][i] = true;
                        missing += !has(tile_of(x, y), i);
                    }
            }
        CHECK(missing == 0);
        std::size_t listed = 0, reaching = 0, beside = 0;
        for (std::uint32_t tile = 0; tile < tiles; ++tile) {
            const std::uint32_t* const list = &words[std::size_t{tile} * grid.words];
            for (std::uint32_t w = 0; w < grid.words - grid.summaries; ++w)
                CHECK(((list[w / 32] >> w % 32 & 1u) != 0) == (list[grid.summaries + w] != 0));
            const reference::ViewColumn column = reference::view_column(
                c.camera, c.size,
                glm::uvec2(tile % grid.tiles.width, tile / grid.tiles.width) * std::uint32_t{PELLUCID_LIGHTS_TILE},
                PELLUCID_LIGHTS_TILE);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                listed += has(tile, i);
                reaching += reached[tile][i];
                reference::LightSphere grown = spheres[i];
                grown.radius *= 1.001;
                beside += has(tile, i) && !reference::reaches(column, grown);
            }
        }
        std::printf("%s %s: %.1f lights a tile listed, %.1f reach a pixel of it\n", TestType::name, name(method),
                    static_cast<double>(listed) / tiles, static_cast<double>(reaching) / tiles);
        CHECK(beside == 0);
        CHECK(reaching > 10 * tiles);
        // A column takes in all that is before and behind what is seen; a slab little more than what reaches it.
        CHECK(static_cast<double>(listed) <
              (method == LightAssignment::tiled ? 1.5 : 4.0) * static_cast<double>(reaching));
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
