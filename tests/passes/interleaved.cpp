// SPDX-License-Identifier: MIT
// Interleaved translucency against exact transparency: its light is shared, and nothing else.
#include <numeric>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/measure/psnr.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include "support/assets.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

template <rhi::Backend B>
Shot<B> draw(typename B::Device& device, const Scene& scene, RenderSettings settings, Transparency method) {
    settings.transparency = method;
    return shoot<B>(device, scene, scene.cameras.front(), settings);
}

double psnr(const ImageF& a, const ImageF& b) {
    return must(measure::tone_mapped_psnr(a, b)).psnr;
}

std::uint64_t sum(const Image<std::uint32_t>& numbers) {
    return std::accumulate(numbers.data.begin(), numbers.data.end(), std::uint64_t{0});
}

struct Lit {
    const char* name;
    Scene scene;
    bool default_light = false;
};
std::vector<Lit> lit_scenes() {
    std::vector<Lit> out;
    out.push_back({"demo", make_demo_scene()});
    out.push_back({"lit glass", make_lit_glass()});
    out.push_back({"peeling", make_peeling_scene()});
    if (const auto folder = scenes()) out.push_back({"L1", must(load_gltf((*folder / "L1_lit.gltf").string()))});
    return out;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("interleaved: as good as exact to the eye, for a part of the light", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Lit& lit : lit_scenes()) {
        RenderSettings settings = settings_for(256);
        settings.audit = true;
        const auto exact = draw<TestType>(*device, lit.scene, settings, Transparency::abuffer);
        const auto shared = draw<TestType>(*device, lit.scene, settings, Transparency::interleaved);
        const auto skyx = draw<TestType>(*device, lit.scene, settings, Transparency::interleaved_skyx);
        const auto layers = must(exact.renderer->read_composited());
        const std::uint64_t fragments = sum(layers), lights = sum(must(shared.renderer->read_composited()));
        const auto pixels = static_cast<std::uint64_t>(
            std::count_if(layers.data.begin(), layers.data.end(), [](std::uint32_t count) { return count != 0; }));
        const double quality = psnr(shared.hdr, exact.hdr), peer = psnr(skyx.hdr, exact.hdr);
        const double share = static_cast<double>(lights) / static_cast<double>(fragments);
        std::printf("%s, %s: %.1f dB, lights %.3f of %llu fragments (least possible %.3f); as SkyXEngine %.1f dB\n",
                    lit.name, TestType::name, quality, share, static_cast<unsigned long long>(fragments),
                    static_cast<double>(pixels) / static_cast<double>(fragments), peer);
        INFO(lit.name);
        CHECK(quality >= 45);
        CHECK(peer < 35);
        CHECK(lights >= pixels);
        CHECK(lights < fragments);
    }
}

TEMPLATE_LIST_TEST_CASE("interleaved: without light to share it is exact", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Scene& scene : {make_random_quads(64), make_linked_chain(), make_cyclic_triangles()}) {
        const RenderSettings settings = settings_for(128);
        const auto exact = draw<TestType>(*device, scene, settings, Transparency::peel);
        const auto shared = draw<TestType>(*device, scene, settings, Transparency::interleaved);
        const auto error = must(measure::image_error(shared.hdr, exact.hdr));
        // Colours of 16 bits, alpha too, over up to 48 layers; then binary16 once more.
        CHECK(error.max <= 0x1p-10);
    }
}

TEMPLATE_LIST_TEST_CASE("interleaved: what is opaque keeps every bit where nothing is in front of it", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_lit_glass();
    const RenderSettings settings = settings_for(128);
    const auto without = draw<TestType>(*device, scene, settings, Transparency::none);
    const auto shared = draw<TestType>(*device, scene, settings, Transparency::interleaved);
    const auto layers = must(shared.renderer->count_layers());
    std::size_t free = 0, changed = 0;
    for (std::size_t i = 0; i < layers.data.size(); ++i) {
        if (layers.data[i] != 0) continue;
        ++free;
        changed += !std::equal(&without.hdr.data[4 * i], &without.hdr.data[4 * i] + 4, &shared.hdr.data[4 * i]);
    }
    CHECK(free > 1000);
    CHECK(changed == 0);
}

TEMPLATE_LIST_TEST_CASE("interleaved: one picture, whatever layout, stage and memory", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_lit_glass();
    RenderSettings settings = settings_for(128);
    const auto whole = draw<TestType>(*device, scene, settings, Transparency::interleaved);
    const auto layers = must(whole.renderer->count_layers());
    // A stored surface has 32 bytes.
    settings.memory_budget = sum(layers) * 32 / 4;
    const auto bands = draw<TestType>(*device, scene, settings, Transparency::interleaved);
    CHECK(bands.hdr.data == whole.hdr.data);
    settings.memory_budget = 0;
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            settings.gbuffer = layout;
            settings.shading = stage;
            const auto other = draw<TestType>(*device, scene, settings, Transparency::interleaved);
            INFO(name(layout) << " " << name(stage));
            CHECK(psnr(other.hdr, whole.hdr) > 60);  // positions are stored in one layout and computed in the other
        }
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("interleaved: both kinds are the same bits on both backends", "[gpu]") {
    const auto vulkan = make_device<Vulkan>();
    const auto opengl = make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    for (const Lit& lit : lit_scenes())
        for (const Transparency method : {Transparency::interleaved, Transparency::interleaved_skyx}) {
            RenderSettings settings = settings_for(128);
            settings.exact = true;
            const auto a = draw<Vulkan>(*vulkan, lit.scene, settings, method);
            const auto b = draw<OpenGL>(*opengl, lit.scene, settings, method);
            const auto error = must(measure::image_error(a.hdr, b.hdr));
            std::printf("%s, %s: %zu pixels differ\n", lit.name, name(method),
                        static_cast<std::size_t>(error.different_pixels));
            INFO(lit.name << ", " << name(method));
            CHECK(error.bit_equal());
        }
}
#endif
