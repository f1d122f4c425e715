// SPDX-License-Identifier: MIT
// The one-call renderer on real devices: the same picture whatever is built, and frames that allocate nothing.
#include <cstring>
#include "support/allocations.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::add;
using test::at;

namespace {
constexpr std::uint32_t n = 96;

/// The varied scene with some of everything that a need stands for, translucents included.
Scene rich_scene() {
    Scene scene = test::varied_scene();
    Material glass = test::matte({0.3f, 0.8f, 0.4f}, 0.3f);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    glass.double_sided = true;
    add(scene, make_uv_sphere(0.4f, 12, 24), glass, at(0.2, 0.1, 1));
    add(scene, test::quad(0.4f, 0.4f), test::flat({0.9f, 0.2f, 0.7f, 0.5f}, AlphaMode::blend), at(-0.6, 0.2, 1.2));
    return scene;
}
/// The same with holes and colours from a texture.
Scene masked_rich_scene() {
    Scene scene = rich_scene();
    Image8 checks(8, 8, 4);
    for (std::size_t i = 0; i < checks.data.size(); ++i)
        checks.data[i] = static_cast<std::uint8_t>(i % 4 == 3 ? (i / 4 + i / 32) % 2 * 255 : i * 37 % 256);
    scene.images.push_back({checks, "checks"});
    scene.textures.push_back({.image = 0});
    scene.materials[1].base_color_texture.texture = 0;
    scene.materials[1].alpha_mode = AlphaMode::mask;
    return scene;
}
std::size_t different(const ImageF& a, const ImageF& b) {
    REQUIRE(a.data.size() == b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) count += std::memcmp(&a.data[i], &b.data[i], 4) != 0;
    return count;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("building what a scene does not need changes no bit of its picture", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    struct Case {
        const char* what;
        Scene scene;
    };
    std::vector<Case> cases = {
        {"empty", {}}, {"varied", test::varied_scene()}, {"rich", rich_scene()}, {"directional", {}},
        {"unlit", {}}, {"translucent only", {}},         {"default light", {}},  {"rich, nothing opaque is lit", {}}};
    cases[3].scene = test::varied_scene();
    cases[3].scene.lights.resize(1);
    add(cases[4].scene, test::quad(0.5f, 0.5f), test::flat({0.3f, 0.6f, 0.9f, 1}));
    cases[5].scene = rich_scene();
    cases[5].scene.instances.erase(cases[5].scene.instances.begin(), cases[5].scene.instances.begin() + 4);
    cases[6].scene = test::varied_scene();
    cases[6].scene.lights.clear();
    cases[7].scene = masked_rich_scene();
    for (Material& m : cases[7].scene.materials) m.unlit = m.alpha_mode != AlphaMode::blend;
    for (const Case& c : cases)
        for (const bool exact : {true, false})
            for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
                RenderSettings settings = test::settings_for(n);
                settings.exact = exact;
                settings.shading = stage;
                settings.background = {0.05f, 0.0501f, 0.33f};  // no halves
                settings.default_light = c.scene.lights.empty();
                settings.keep_gbuffer = false;
                const auto lean = test::shoot<TestType>(*device, c.scene, test::varied_camera(), settings);
                settings.every_need = true;
                const auto all = test::shoot<TestType>(*device, c.scene, test::varied_camera(), settings);
                INFO(c.what << ", " << name(stage) << (exact ? ", exact" : ""));
                CHECK(different(lean.hdr, all.hdr) == 0);
                CHECK(lean.renderer->stats().bytes <= all.renderer->stats().bytes);
            }
}

TEMPLATE_LIST_TEST_CASE("the background is the same whether anything is drawn or not", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    RenderSettings settings = test::settings_for(n);
    settings.background = {0.05f, 0.123456f, 0.9f};
    const Camera away{.world_from_view = look_at({0, 0, -50}, {0, 0, -100})};  // looks at nothing
    const auto empty = test::shoot<TestType>(*device, {}, away, settings);
    const auto opaque = test::shoot<TestType>(*device, test::varied_scene(), away, settings);
    CHECK(different(empty.hdr, opaque.hdr) == 0);
    Scene glowing;
    add(glowing, test::quad(), test::flat({0.3f, 0.6f, 0.9f, 1}));
    settings.keep_gbuffer = false;
    CHECK(different(empty.hdr, test::shoot<TestType>(*device, glowing, away, settings).hdr) == 0);
    for (int c = 0; c < 3; ++c)
        CHECK(empty.hdr.texel(3, 5)[c] == half_to_float(half_toward_zero(settings.background[c])));
    CHECK(empty.hdr.texel(3, 5)[3] == 1.0f);
}

TEMPLATE_LIST_TEST_CASE("sizes from one pixel up are filled to their edges", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    add(scene, test::quad(100, 100), test::flat({1, 0.5f, 0.25f, 1}));
    for (const Extent2D size : {Extent2D{1, 1}, Extent2D{1, 7}, Extent2D{9, 1}, Extent2D{8, 8}, Extent2D{17, 31}})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            RenderSettings settings = test::settings_for(1);
            settings.size = size;
            settings.shading = stage;
            auto shot = test::shoot<TestType>(*device, scene, test::flat_camera(), settings);
            const Image8 display = test::must(shot.renderer->read_display());
            std::size_t other = 0;
            for (std::size_t i = 0; i < shot.hdr.data.size(); i += 4)
                other += shot.hdr.data[i] != 1 || shot.hdr.data[i + 1] != 0.5f || shot.hdr.data[i + 2] != 0.25f ||
                         display.data[i + 3] != 255;
            INFO(size.width << "x" << size.height << " " << name(stage));
            CHECK(other == 0);
        }
    const std::uint32_t limit = device->info().max_texture_size;
    const auto refused = Renderer<TestType>::create(*device, scene, {.size = {limit + 1, 4}});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::invalid_argument);
}

TEMPLATE_LIST_TEST_CASE("moving the camera moves lights and order with it", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = rich_scene();
    const RenderSettings settings = test::settings_for(n);
    const Camera first = test::varied_camera(), second{.world_from_view = look_at({-2, 1.5, -2.5}, {0, 0, 0})};
    auto renderer = test::must(Renderer<TestType>::create(*device, scene, settings));
    (void)test::must(renderer->render(first));
    const ImageF a = test::must(renderer->read_hdr());
    for (int i = 0; i < 5; ++i) (void)test::must(renderer->render(second));  // several frames in flight
    const ImageF b = test::must(renderer->read_hdr());
    (void)test::must(renderer->render(first));
    CHECK(different(test::must(renderer->read_hdr()), a) == 0);
    CHECK(different(b, test::shoot<TestType>(*device, scene, second, settings).hdr) == 0);
    CHECK(different(a, b) > a.data.size() / 4);
}

TEMPLATE_LIST_TEST_CASE("a frame allocates nothing once the first ones are drawn", "[gpu]", test::Backends) {
    // Validation layers allocate for themselves.
    const auto device = test::make_device<TestType>([](rhi::DeviceDesc& desc) { desc.validation = false; });
    if (!device) return;
    const Scene scene = rich_scene();
    for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
        RenderSettings settings = test::settings_for(n);
        settings.shading = stage;
        settings.shadows = stage == ShadingStage::compute ? Shadows::map : Shadows::none;
        settings.shadow_size = 64;
        auto renderer = test::must(Renderer<TestType>::create(*device, scene, settings));
        Camera camera = test::varied_camera();
        auto frame = [&] {
            camera.world_from_view[3].x += 0.01;  // lights and order are made anew
            return static_cast<bool>(renderer->render(camera));
        };
        for (int i = 0; i < 8; ++i) REQUIRE(frame());
        bool good = true;
        const std::uint64_t before = test::allocations();
        for (int i = 0; i < 16; ++i) good = frame() && good;
        const std::uint64_t after = test::allocations();
        CHECK(good);
        INFO(name(stage));
        CHECK(after - before == 0);
    }
}
