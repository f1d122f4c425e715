// SPDX-License-Identifier: MIT
// What a scene needs, and that a renderer builds that and nothing else (on the null backend).
#include <algorithm>
#include <functional>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/rhi/null.hpp>
#include <string>
#include "support/catch.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::add;

namespace {
/// One matte rectangle and one directional light: the least that is lit.
Scene plain() {
    Scene scene;
    add(scene, test::quad(), test::matte({1, 1, 1}));
    scene.lights = {{.kind = LightKind::directional}};
    return scene;
}
void texture(Scene& scene, TextureRef& ref) {
    if (scene.images.empty()) {
        scene.images.push_back({Image8(4, 4, 4), "grey"});
        std::fill(scene.images[0].pixels.data.begin(), scene.images[0].pixels.data.end(), std::uint8_t{128});
        scene.textures.push_back({.image = 0});
    }
    ref.texture = 0;
}
std::uint32_t mask(const Scene& scene, const RenderSettings& settings = {}) {
    // Where lights are read from follows from their number (tests/passes/lighting.cpp).
    return scene_needs(scene, settings).mask & ~PELLUCID_NEED_LIGHT_BLOCK;
}

const PassReport& pass(const RenderStats& stats, const std::string& name) {
    for (const PassReport& p : stats.passes)
        if (p.name == name) return p;
    FAIL("no report of " << name);
    return stats.passes.front();
}
bool has(const RenderStats& stats, const std::string& resource) {
    return std::any_of(stats.resources.begin(), stats.resources.end(),
                       [&](const TextureReport& r) { return r.name == resource; });
}
RenderStats stats_of(const Scene& scene, RenderSettings settings = {.transparency = Transparency::sorted}) {
    settings.size = {32, 16};
    null::Device device;
    const auto renderer = test::must(Renderer<Null>::create(device, scene, settings));
    (void)test::must(renderer->render({}));
    return renderer->stats();
}
constexpr std::uint64_t pixels = 32 * 16;
}  // namespace

TEST_CASE("each need is set by what needs it, and by nothing else", "[cpu]") {
    const std::uint32_t base = PELLUCID_NEED_DIRECTIONAL | PELLUCID_NEED_NORMALS;
    CHECK(mask(plain()) == base);
    struct Case {
        const char* what;
        std::function<void(Scene&)> change;
        std::uint32_t adds;
    };
    const Case cases[] = {
        {"base colour texture", [](Scene& s) { texture(s, s.materials[0].base_color_texture); },
         PELLUCID_NEED_TEXTURES},
        {"metallic-roughness texture", [](Scene& s) { texture(s, s.materials[0].metallic_roughness_texture); },
         PELLUCID_NEED_TEXTURES},
        {"normal map", [](Scene& s) { texture(s, s.materials[0].normal_texture); },
         PELLUCID_NEED_TEXTURES | PELLUCID_NEED_NORMAL_MAPS},
        {"occlusion", [](Scene& s) { texture(s, s.materials[0].occlusion_texture); },
         PELLUCID_NEED_TEXTURES | PELLUCID_NEED_OCCLUSION},
        {"emissive texture alone: times factor 0", [](Scene& s) { texture(s, s.materials[0].emissive_texture); },
         PELLUCID_NEED_TEXTURES},
        {"second texture coordinates",
         [](Scene& s) {
             texture(s, s.materials[0].base_color_texture);
             s.materials[0].base_color_texture.uv_set = 1;
         },
         PELLUCID_NEED_TEXTURES | PELLUCID_NEED_SECOND_UV},
        {"emissive",
         [](Scene& s) {
             s.materials[0].emissive = {0, 0.1f, 0};
         },
         PELLUCID_NEED_EMISSIVE},
        {"mask", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::mask; }, PELLUCID_NEED_ALPHA_MASK},
        {"vertex colours",
         [](Scene& s) {
             s.meshes[0].colors.assign(4, {1, 1, 1, 1});
         },
         PELLUCID_NEED_VERTEX_COLORS},
        {"point light", [](Scene& s) { s.lights.push_back({.kind = LightKind::point}); }, PELLUCID_NEED_POINTS},
        {"point light with a range", [](Scene& s) { s.lights.push_back({.kind = LightKind::point, .range = 4}); },
         PELLUCID_NEED_POINTS | PELLUCID_NEED_LIGHT_RANGES},
        {"spot light", [](Scene& s) { s.lights.push_back({.kind = LightKind::spot}); }, PELLUCID_NEED_SPOTS}};
    for (const Case& c : cases) {
        Scene scene = plain();
        c.change(scene);
        INFO(c.what);
        CHECK(mask(scene) == (base | c.adds));
        scene.instances.clear();  // a material that is not drawn needs nothing
        CHECK((mask(scene) & ~(PELLUCID_NEED_DIRECTIONAL | PELLUCID_NEED_POINTS | PELLUCID_NEED_SPOTS |
                               PELLUCID_NEED_LIGHT_RANGES)) == 0u);
    }
    // Normals are wanted where light falls on a lit surface, or where somebody reads the G-buffer.
    Scene unlit = plain();
    unlit.materials[0].unlit = true;
    const std::uint32_t emits = PELLUCID_NEED_DIRECTIONAL | PELLUCID_NEED_EMISSIVE | PELLUCID_NEED_UNLIT;
    CHECK(mask(unlit) == emits);
    CHECK(mask(unlit, {.keep_gbuffer = true}) == (emits | PELLUCID_NEED_NORMALS));
    unlit.materials[0].alpha_mode = AlphaMode::blend;
    CHECK(mask(unlit, {.keep_gbuffer = true}) == emits);
    Scene dark = plain();
    dark.lights.clear();
    CHECK(mask(dark) == (base | PELLUCID_NEED_AMBIENT));
    CHECK(mask(dark, {.default_light = false}) == 0u);
    CHECK(mask(dark, {.every_need = true}) == PELLUCID_NEED_ALL);
    // Translucent surfaces that are not drawn need nothing either.
    Scene ghost = plain();
    ghost.materials[0].alpha_mode = AlphaMode::blend;
    ghost.materials[0].emissive = {1, 1, 1};
    CHECK(scene_needs(ghost, {.transparency = Transparency::none}).translucent == false);
    CHECK(mask(ghost, {.transparency = Transparency::none}) == PELLUCID_NEED_DIRECTIONAL);
    CHECK(scene_needs(ghost, {}).translucent);
    CHECK_FALSE(scene_needs(ghost, {}).opaque);
    CHECK_FALSE(scene_needs(ghost, {}).emissive_target);  // only opaque surfaces store what they emit
}

TEST_CASE("an opaque scene has three passes, three pipelines and the targets of its layout", "[cpu]") {
    const RenderStats s = stats_of(plain());
    CHECK(pass(s, "gbuffer").ran);
    CHECK(pass(s, "lighting").ran);
    CHECK(pass(s, "tonemap").ran);
    CHECK_FALSE(pass(s, "transparency").ran);
    CHECK(pass(s, "transparency").reason == "the scene has no translucent surface");
    CHECK(s.pipelines == 3);
    CHECK(s.draws == 1);
    CHECK(s.triangles == 2);
    CHECK(s.lights == 1);
    CHECK_FALSE(has(s, "gbuffer.emissive"));
    std::uint64_t targets = 0;
    for (const TextureReport& r : s.resources)
        if (std::string(r.name).rfind("scene.", 0) != 0) targets += r.bytes;
    CHECK(targets == pixels * (16 + 8 + 4));  // compact G-buffer with depth, HDR, display
    const RenderStats classic =
        stats_of(plain(), {.transparency = Transparency::sorted, .gbuffer = GBufferLayout::classic});
    CHECK(classic.bytes - s.bytes == pixels * 20);
}

TEST_CASE("where no light falls on anything opaque there is neither a G-buffer nor a lighting pass", "[cpu]") {
    Scene unlit = plain();
    unlit.materials[0].unlit = true;
    Scene dark = plain();  // it only glows
    dark.lights.clear();
    dark.materials[0].emissive = {1, 1, 1};
    const RenderSettings off{.transparency = Transparency::sorted, .default_light = false};
    for (const Scene& scene : {unlit, dark}) {
        const RenderStats s = stats_of(scene, off);
        for (const char* name : {"gbuffer", "lighting"}) {
            CHECK_FALSE(pass(s, name).ran);
            CHECK(pass(s, name).reason == "no light falls on an opaque surface");
        }
        CHECK(pass(s, "emitted").ran);
        CHECK_FALSE(has(s, "gbuffer.emissive"));
        CHECK(s.pipelines == 2);
        // Light on one other surface, or a G-buffer to be read, bring them back.
        Scene more = scene;
        if (more.lights.empty()) more.lights.push_back(default_sun());
        add(more, test::quad(), test::matte({1, 0, 0}));
        CHECK(pass(stats_of(more, off), "lighting").ran);
        RenderSettings kept = off;
        kept.keep_gbuffer = true;
        CHECK(pass(stats_of(scene, kept), "lighting").ran);
        // So do translucent surfaces that are lit with what is opaque; others do not.
        Material glass = test::matte({1, 0, 0});
        glass.alpha_mode = AlphaMode::blend;
        more = scene;
        add(more, test::quad(), glass);
        CHECK(pass(stats_of(more, off), "emitted").ran);
        RenderSettings together = off;
        together.transparency = Transparency::interleaved;
        CHECK(pass(stats_of(more, together), "lighting").ran);
    }
    // A default sun shines on what is not unlit.
    CHECK(pass(stats_of(dark, {.transparency = Transparency::sorted}), "lighting").ran);
}

TEST_CASE("what a scene adds is what it costs", "[cpu]") {
    const RenderStats base = stats_of(plain());
    Scene scene = plain();
    scene.materials[0].emissive = {1, 1, 1};
    RenderStats s = stats_of(scene);
    CHECK(has(s, "gbuffer.emissive"));
    CHECK(s.bytes == base.bytes + pixels * 8);
    CHECK(s.pipelines == base.pipelines);

    scene = plain();
    Material two_sided = test::matte({1, 0, 0});
    two_sided.double_sided = true;
    add(scene, test::quad(), two_sided);
    add(scene, test::quad(), test::matte({0, 1, 0}), test::scaled(-1, 1, 1));
    CHECK(stats_of(scene).pipelines == base.pipelines + 2);  // no culling, culling of front faces
    CHECK(stats_of(scene).draws == 3);

    scene = plain();
    Material glass = test::matte({1, 0, 0});
    glass.alpha_mode = AlphaMode::blend;
    glass.emissive = {1, 1, 1};
    add(scene, test::quad(), glass);
    s = stats_of(scene);
    CHECK(pass(s, "sorted_forward").ran);
    CHECK(s.pipelines == base.pipelines + 1);
    CHECK_FALSE(has(s, "gbuffer.emissive"));
    CHECK(s.draws == 2);
    scene.materials[1].double_sided = true;
    CHECK(stats_of(scene).pipelines == base.pipelines + 2);
    CHECK(stats_of(scene).draws == 3);  // back faces, front faces
    s = stats_of(scene, {.transparency = Transparency::none});
    CHECK_FALSE(pass(s, "transparency").ran);
    CHECK(pass(s, "transparency").reason == "transparency is switched off");
    CHECK(s.pipelines == base.pipelines);
    CHECK(s.draws == 1);

    scene = plain();
    texture(scene, scene.materials[0].base_color_texture);
    s = stats_of(scene);
    CHECK(has(s, "scene.color_textures"));
    CHECK_FALSE(has(s, "scene.data_textures"));
    CHECK(s.bytes == base.bytes + 4 * (16 + 4 + 1));
    texture(scene, scene.materials[0].occlusion_texture);
    CHECK(has(stats_of(scene), "scene.data_textures"));
}

TEST_CASE("a scene without opaque surfaces has no G-buffer, and an empty one no depth either", "[cpu]") {
    Scene scene;
    add(scene, test::quad(), test::flat({1, 1, 1, 0.5f}, AlphaMode::blend));
    RenderStats s = stats_of(scene);
    for (const char* name : {"gbuffer", "lighting"}) {
        CHECK_FALSE(pass(s, name).ran);
        CHECK(pass(s, name).reason == "the scene has no opaque surface");
    }
    CHECK(pass(s, "background").ran);
    CHECK(pass(s, "sorted_forward").ran);
    CHECK(has(s, "depth"));
    CHECK_FALSE(has(s, "gbuffer.normal"));
    CHECK(s.pipelines == 2);
    s = stats_of(Scene{});
    CHECK(pass(s, "background").ran);
    CHECK_FALSE(pass(s, "transparency").ran);
    CHECK_FALSE(has(s, "depth"));
    CHECK(s.pipelines == 1);
    CHECK(s.draws == 0);
    // Asked to build everything, it does.
    s = stats_of(Scene{}, {.transparency = Transparency::sorted, .every_need = true});
    for (const char* name : {"gbuffer", "lighting", "sorted_forward", "tonemap"}) CHECK(pass(s, name).ran);
    CHECK(has(s, "gbuffer.emissive"));
}

TEST_CASE("lists, volumes and environments are built where they are needed, and nowhere else", "[cpu]") {
    Scene scene = plain();
    const RenderSettings base{.transparency = Transparency::sorted};
    const RenderStats none = stats_of(scene, base);
    const auto has_pass = [](const RenderStats& stats, const std::string& name) {
        return std::any_of(stats.passes.begin(), stats.passes.end(),
                           [&](const PassReport& p) { return p.name == name && p.ran; });
    };
    for (const char* resource :
         {"scene.light_lists", "scene.light_bounds", "scene.dfg", "scene.environment", "scene.sky"})
        CHECK_FALSE(has(none, resource));
    // A sun needs no list, whatever is asked for.
    for (const LightAssignment method :
         {LightAssignment::tiled, LightAssignment::clustered, LightAssignment::volumes}) {
        RenderSettings asked = base;
        asked.lighting = method;
        const RenderStats s = stats_of(scene, asked);
        CHECK(s.lighting == LightAssignment::loop);
        CHECK_FALSE(s.lighting_why.empty());
        CHECK(s.bytes == none.bytes);
        CHECK(s.pipelines == none.pipelines);
    }
    // 20 lamps do.
    scene.lights.assign(20, {.kind = LightKind::point, .range = 1});
    RenderSettings settings = base;
    settings.lighting = LightAssignment::loop;
    const RenderStats loop = stats_of(scene, settings);
    CHECK_FALSE(has_pass(loop, "light_lists"));
    settings.lighting = LightAssignment::tiled;
    const RenderStats tiled = stats_of(scene, settings);
    CHECK(has_pass(tiled, "light_lists"));
    CHECK(tiled.pipelines == loop.pipelines + 1);
    // 32 x 16 pixels: two tiles of a list of two words for opaque surfaces alone; 20 bounds of 16 bytes.
    CHECK(tiled.bytes == loop.bytes - 16 + 2 * 2 * 4 + 20 * 16);  // 16: what stands in for lists
    settings.lighting = LightAssignment::clustered;
    const RenderStats clustered = stats_of(scene, settings);
    CHECK(clustered.pipelines == loop.pipelines + 2);
    CHECK(clustered.bytes == loop.bytes - 16 + (2 + PELLUCID_LIGHTS_SLICES) * 2 * 4 + 20 * 16);
    settings.lighting = LightAssignment::automatic;
    CHECK(stats_of(scene, settings).lighting == LightAssignment::clustered);
    settings.lighting = LightAssignment::volumes;
    const RenderStats volumes = stats_of(scene, settings);
    CHECK(has_pass(volumes, "light_volumes"));
    CHECK_FALSE(has_pass(volumes, "light_lists"));
    CHECK(has(volumes, "light_volumes.stencil"));
    CHECK(volumes.pipelines == loop.pipelines + 4);

    // The sky takes its table and that of albedo; a picture its cube map too; a model that conserves energy one table.
    scene = plain();
    settings = base;
    settings.brdf = Brdf::conserving;
    CHECK(has(stats_of(scene, settings), "scene.dfg"));
    scene.materials[0].unlit = true;
    CHECK_FALSE(has(stats_of(scene, settings), "scene.dfg"));
    scene.materials[0].unlit = false;
    settings = base;
    settings.environment.kind = EnvironmentKind::sky;
    const RenderStats sky = stats_of(scene, settings);
    CHECK(has(sky, "scene.sky"));
    CHECK(has(sky, "scene.dfg"));
    CHECK_FALSE(has(sky, "scene.environment"));
    CHECK(sky.bytes == none.bytes - 2 * 4 + 64 * 16 * 16 + 128 * 128 * 8);  // 4: a texel that stands in for a table
    settings.environment.kind = EnvironmentKind::picture;
    settings.environment.picture = std::make_shared<const ImageF>(ImageF(64, 32, 3));
    const RenderStats picture = stats_of(scene, settings);
    CHECK(has(picture, "scene.environment"));
    CHECK_FALSE(has(picture, "scene.sky"));
    CHECK(picture.bytes == none.bytes - 4 - 24 + 128 * 128 * 8 + 6 * (16 * 16 + 8 * 8) * 8);
    // What cannot be is refused.
    null::Device device;
    settings.environment.picture = nullptr;
    CHECK(Renderer<Null>::create(device, scene, settings).error().message.find("has no picture") != std::string::npos);
    settings.environment.picture = std::make_shared<const ImageF>(ImageF(33, 16, 3));
    CHECK(Renderer<Null>::create(device, scene, settings).error().message.find("twice as wide as high") !=
          std::string::npos);
}
