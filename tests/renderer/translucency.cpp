// SPDX-License-Identifier: MIT
// What the renderer says about its method of transparency: facts of the last frame, bytes, and what a device must have.
#include <algorithm>
#include <cmath>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/scene/sort_conflicts.hpp>
#include <set>
#include <string>
#include "support/scene.hpp"

using namespace pellucid;
using test::add;
using test::at;

namespace {
/// An opaque white wall and `layers` black panes of alpha 0.5 before it, all over the view of `flat_camera`.
Scene panes(int layers) {
    Scene scene;
    add(scene, test::quad(), test::flat({1, 1, 1, 1}), at(0, 0, -1));
    for (int i = 0; i < layers; ++i)
        add(scene, test::quad(), test::flat({0, 0, 0, 0.5f}, AlphaMode::blend), at(0, 0, 0.1 * i));
    return scene;
}
RenderSettings method(Transparency t) {
    RenderSettings settings = test::settings_for(16);
    settings.transparency = t;
    settings.keep_gbuffer = false;  // nothing is lit, so a fragment is a colour
    return settings;
}
template <class B>
TranslucencyStats facts(const test::Shot<B>& shot) {
    return shot.renderer->stats().translucency;
}
float middle(const ImageF& picture) {
    return picture.texel(8, 8)[0];
}
}  // namespace

TEST_CASE("every method has a name of its own, and the default is one that loses nothing", "[cpu]") {
    std::set<std::string> names;
    for (const TransparencyTraits& t : all_transparencies) {
        CHECK(names.insert(t.name).second);
        CHECK(std::string(name(t.method)) == t.name);
    }
    CHECK(names.count("none") == 1);
    CHECK(RenderSettings{}.transparency == Transparency::abuffer);
    CHECK(std::string(traits(Transparency::abuffer).loses).empty());
    CHECK(std::string(traits(Transparency::peel).loses).empty());
    CHECK_FALSE(std::string(traits(Transparency::sorted).loses).empty());
}

TEST_CASE("every byte of every buffer and texture is in the account", "[cpu]") {
    Scene scene = test::varied_scene();
    Material glass = test::flat({0.3f, 0.8f, 0.4f, 0.5f}, AlphaMode::blend);
    glass.unlit = false;
    add(scene, test::quad(0.4f, 0.4f), glass, at(-0.6, 0.2, 1.2));
    for (const TransparencyTraits& t : all_transparencies)
        for (const bool audit : {false, true}) {
            if (audit && !t.audit) continue;
            INFO(t.name << (audit ? ", audited" : ""));
            RenderSettings settings = method(t.method);
            settings.size = {37, 21};
            settings.audit = audit;
            null::Device device;
            const auto renderer = test::must(Renderer<Null>::create(device, scene, settings));
            CHECK(renderer->stats().bytes == device.live_bytes());
            (void)test::must(renderer->render(test::varied_camera()));
            const RenderStats stats = renderer->stats();
            CHECK(stats.bytes == device.live_bytes());
            std::uint64_t sum = 0;
            for (const TextureReport& r : stats.resources) sum += r.bytes;
            CHECK(sum == stats.bytes);
            // The method's own share is what it takes beside a picture without translucent surfaces.
            RenderSettings without = settings;
            without.transparency = Transparency::none;
            without.audit = false;
            null::Device other;
            const auto plain = test::must(Renderer<Null>::create(other, scene, without));
            const std::uint64_t indices = t.method == Transparency::peel ? 4 * 3 * stats.triangles : 0;  // in reverse
            CHECK(stats.translucency.bytes == stats.bytes - plain->stats().bytes - indices);
            // Counting the layers makes room for the counts, and says so.
            (void)test::must(renderer->count_layers());
            CHECK(renderer->stats().bytes == device.live_bytes());
        }
}

TEST_CASE("a device that cannot run a method is refused with what is needed and what there is", "[cpu]") {
    rhi::DeviceInfo info = null::Device().info();
    for (const TransparencyTraits& t : all_transparencies) CHECK(check_device(t.method, info));
    info.max_texture_size = 8192;
    CHECK(check_device(Transparency::peel, info));
    CHECK_FALSE(check_device(Transparency::interleaved, info));
    null::Device device;
    device.pretend(info);
    const auto small = Renderer<Null>::create(device, panes(1), {.size = {16, 16}});
    REQUIRE_FALSE(small);
    CHECK(small.error().code == Errc::unsupported);
    CHECK(
        small.error().message ==
        "the method 'abuffer' needs textures of 16384 texels a side, and null (null) has at most 8192: choose another "
        "method or another device");
    CHECK(device.live_objects() == 0);
    info.float32_blending = false;
    const auto dull = check_device(Transparency::dual_peel, info);
    REQUIRE_FALSE(dull);
    CHECK(dull.error().message ==
          "the method 'dual-peel' needs blending into 32-bit float targets, and null (null) has none: choose another "
          "method or another device");
    CHECK_FALSE(check_device(Transparency::interleaved, info));
    for (const Transparency t :
         {Transparency::none, Transparency::sorted, Transparency::peel_seed, Transparency::interleaved_skyx})
        CHECK(check_device(t, info));
}

TEMPLATE_LIST_TEST_CASE("facts of peeling, and a bound of the error that holds", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = panes(5);
    RenderSettings settings = method(Transparency::peel);
    auto shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK(facts(shot).ran);
    CHECK(facts(shot).exact);
    CHECK(facts(shot).loses.empty());
    CHECK(facts(shot).layers == 5);
    CHECK_FALSE(facts(shot).truncated);
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0);
    const float all = middle(shot.hdr);
    CHECK(all == 1.0f / 32);
    for (const std::uint32_t layers : {2u, 4u, 5u, 6u}) {
        settings.max_layers = layers;
        shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
        INFO(layers << " layers at most");
        const bool cut = layers < 5;
        CHECK(facts(shot).truncated == cut);
        CHECK(facts(shot).exact == !cut);
        CHECK(facts(shot).layers == std::min(layers, 5u));
        CHECK(facts(shot).loses == (cut ? "layers behind the first " + std::to_string(layers) : std::string()));
        const double left = test::must(shot.renderer->read_transmittance_left());
        CHECK(left == (cut ? std::ldexp(1.0, -static_cast<int>(layers)) : 0));
        CHECK(std::abs(middle(shot.hdr) - all) <= left);  // the wall's radiance is 1
    }
    // Half of the pixels are done: only the others count.
    Scene half = panes(1);
    add(half, test::quad(0.5f, 1), test::flat({0, 0, 0, 0.75f}, AlphaMode::blend), at(0.5, 0, 1));
    settings.max_layers = 1;
    shot = test::shoot<TestType>(*device, half, test::flat_camera(), settings);
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0.25);
    settings.max_layers = 0;
    settings.min_transmittance = 0.2f;
    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK_FALSE(facts(shot).exact);
    CHECK(facts(shot).loses == "what is behind layers that let at most 0.2 of the light through");
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0.125);
    CHECK(std::abs(middle(shot.hdr) - all) <= 0.125);
}

TEMPLATE_LIST_TEST_CASE("facts of the other methods", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = panes(5);
    RenderSettings settings = method(Transparency::abuffer);
    auto shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK(facts(shot).exact);
    CHECK(facts(shot).bands == 1);
    // 16 × 16 pixels of 5 fragments in a row of 2^14 places of 16 bytes.
    CHECK(facts(shot).pool_bytes == 16384 * 16);
    CHECK(facts(shot).bytes > facts(shot).pool_bytes);
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0);
    settings.memory_budget = 8 * 16 * 5 * 16;  // one strip of 8 rows
    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK(facts(shot).bands == 2);
    settings = method(Transparency::abuffer);
    settings.min_transmittance = 0.1f;
    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK_FALSE(facts(shot).exact);
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0.1f);

    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), method(Transparency::dual_peel));
    CHECK_FALSE(facts(shot).exact);
    CHECK(facts(shot).passes == 3);
    CHECK_FALSE(shot.renderer->read_transmittance_left());
    settings = method(Transparency::dual_peel);
    settings.max_layers = 1;
    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
    CHECK(facts(shot).truncated);
    CHECK(facts(shot).loses.find("layers between the first 1 and the last 1") != std::string::npos);

    shot = test::shoot<TestType>(*device, scene, test::flat_camera(), method(Transparency::peel_seed));
    CHECK(facts(shot).layers == 6);
    CHECK_FALSE(facts(shot).exact);
    shot = test::shoot<TestType>(*device, panes(0), test::flat_camera(), method(Transparency::peel));
    CHECK_FALSE(facts(shot).ran);
    CHECK(facts(shot).exact);
    CHECK(facts(shot).bytes == 0);
    CHECK(test::must(shot.renderer->read_transmittance_left()) == 0);
}

TEMPLATE_LIST_TEST_CASE("a memory budget that holds no strip is refused with the least that would do", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    RenderSettings settings = method(Transparency::abuffer);
    settings.memory_budget = 8 * 16 * 5 * 16 - 1;
    auto renderer = test::must(Renderer<TestType>::create(*device, panes(5), settings));
    const auto refused = renderer->render(test::flat_camera());
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::invalid_argument);
    CHECK(refused.error().message.find("take 10240 bytes") != std::string::npos);
}

TEMPLATE_LIST_TEST_CASE("a scene that the detector lets pass is drawn by sorting as by storing every fragment", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    add(scene, test::quad(), test::flat({0.2f, 0.3f, 0.9f, 1}), at(0, 0, -2));
    Material glass = test::flat({0.9f, 0.3f, 0.1f, 0.5f}, AlphaMode::blend);
    glass.double_sided = true;
    add(scene, make_uv_sphere(0.5f, 12, 24), glass, at(0.1, 0, 1));
    glass.base_color = {0.1f, 0.8f, 0.3f, 0.7f};
    add(scene, make_cube(0.9f), glass, at(-0.2, 0.1, -0.8));
    glass.base_color = {0.4f, 0.1f, 0.9f, 0.3f};
    add(scene, test::quad(0.7f, 0.7f), glass, at(0.2, 0.2, 2.5) * test::scaled(-1, 1, 1));
    Camera camera = test::flat_camera();
    const RenderSettings settings = method(Transparency::sorted);
    CHECK(find_sort_conflicts(scene, camera, settings.size).exact());
    const auto worst = [&](const Scene& drawn) {
        const ImageF a = test::shoot<TestType>(*device, drawn, camera, method(Transparency::sorted)).hdr;
        const ImageF b = test::shoot<TestType>(*device, drawn, camera, method(Transparency::abuffer)).hdr;
        float most = 0;
        for (std::size_t i = 0; i < a.data.size(); ++i) most = std::max(most, std::abs(a.data[i] - b.data[i]));
        return most;
    };
    // At most five layers, each rounded to binary16 below 1: 2^-11 each.
    CHECK(worst(scene) <= 6 * 0x1p-11f);
    scene.instances[2].world_from_object = at(0.1, 0, 0.8);  // the box in the sphere
    CHECK_FALSE(find_sort_conflicts(scene, camera, settings.size).exact());
    CHECK(worst(scene) > 0.05f);
}
