// SPDX-License-Identifier: MIT
// Exact methods on whole scenes, and interleaved transparency where no light falls: against independent references
// where pixels are stable, every fragment accounted for, and not one bit that depends on the order of instances.
#include <algorithm>
#include <numeric>
#include <pellucid/measure/coverage.hpp>
#include <pellucid/measure/order_variance.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/image_file.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <random>
#include "support/assets.hpp"
#include "support/scene.hpp"
#include "support/transparency.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

const std::vector<Transparency> exact_methods = methods_exact(Exactness::yes),
                                exact_without_light = methods_exact(Exactness::without_light);

struct Known {
    const char* name;
    glm::vec3 background;
    double rmse;  ///< largest allowed, of errors over max(1, reference)
};
const Known known[] = {{"S1_random_quads", {0.10196078f, 0.12156863f, 0.16078431f}, 5e-4},
                       {"S2_intersecting_planes", {0.2f, 0.2f, 0.21960784f}, 5e-4},
                       {"S3_linked_chain", {0.25098039f, 0.25882353f, 0.29803922f}, 5e-4},
                       {"L1_lit", {0.03921569f, 0.03921569f, 0.05098039f}, 2e-3}};

struct Sample {
    std::string name;
    Scene scene;
    double rmse;
};
std::vector<Sample> samples() {
    std::vector<Sample> out;
    out.push_back({"24 quads, seed 7", make_random_quads(24, 7), 5e-4});
    out.push_back({"120 quads, seed 23", make_random_quads(120, 23), 5e-4});
    out.push_back({"chain", make_linked_chain(), 5e-4});
    out.push_back({"planes", make_intersecting_planes(0.3f), 5e-4});
    out.push_back({"cycle", make_cyclic_triangles(), 5e-4});
    out.push_back({"lit glass", make_lit_glass(4), 2e-3});
    out.push_back({"peeling scene", make_peeling_scene(), 2e-3});
    return out;
}

/// One of many surfaces, one that no order of objects gets right, one that is lit: for what takes many renderers.
std::vector<Sample> few_samples() {
    std::vector<Sample> out = samples();
    std::erase_if(out, [](const Sample& s) {
        return s.name != "24 quads, seed 7" && s.name != "cycle" && s.name != "lit glass";
    });
    REQUIRE(out.size() == 3);
    return out;
}

ImageF without_alpha(const ImageF& image) {
    ImageF out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        std::copy_n(image.data.data() + 4 * i, 3, out.data.data() + 3 * i);
    return out;
}

/// Prints and returns how a method stands to the reference.
measure::CoverageError report(const std::string& what, const char* backend, Transparency method, const ImageF& hdr,
                              const ImageF& reference, const Image8& stable) {
    const auto error =
        must(measure::coverage_error(without_alpha(hdr), reference, stable, measure::ErrorScale::scaled));
    std::printf("%s, %s on %s: RMSE %.3g, p99.9 %.3g, max %.3g on %zu stable pixels; %zu unstable, max %.3g there\n",
                what.c_str(), name(method), backend, error.stable.rmse, error.stable.p999, error.stable.max,
                static_cast<std::size_t>(error.stable_pixels), static_cast<std::size_t>(error.unstable_pixels),
                error.unstable.max);
    return error;
}

void check(const measure::CoverageError& error, double rmse) {
    const measure::WorstPixel& w = error.stable.worst;
    INFO("worst at (" << w.x << ", " << w.y << "), channel " << w.channel << ": " << w.value << " instead of "
                      << w.reference);
    CHECK(error.stable_pixels > 1000);
    CHECK(error.stable.nonfinite + error.unstable.nonfinite == 0);
    CHECK(error.stable.rmse <= rmse);
    CHECK(error.stable.max <= 0.01);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("transparency: scenes with known answers", "[gpu]", Backends) {
    const auto folder = scenes();
    if (!folder) return;
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Known& k : known) {
        const std::string base = (*folder / k.name).string();
        const Scene scene = must(load_gltf(base + ".gltf"));
        Image8 stable = must(read_pgm(base + ".stable.pgm"));
        const ImageF reference = must(read_pfm(base + ".reference.pfm"));
        // These masks know nothing of corners that are moved to a grid: on GPUs the reference renderer's counts too.
        if (!device->info().software) {
            const auto own = must(reference::render(scene, scene.cameras.front(),
                                                    {.size = {256, 256},
                                                     .background = glm::dvec3(k.background),
                                                     .lights = scene.lights,
                                                     .stability = true}));
            for (std::size_t i = 0; i < stable.data.size(); ++i) stable.data[i] &= own.stable.data[i];
        }
        RenderSettings settings{.size = {256, 256},
                                .transparency = Transparency::sorted,
                                .background = k.background,
                                .default_light = false};
        const ImageF sorted = shoot<TestType>(*device, scene, scene.cameras.front(), settings).hdr;
        (void)report(k.name, TestType::name, Transparency::sorted, sorted, reference, stable);
        for (const Transparency method : exact_methods) {
            settings.transparency = method;
            settings.audit = true;
            const Composited got = composite<TestType>(*device, scene, scene.cameras.front(), settings);
            INFO(k.name << ", " << name(method));
            check(report(k.name, TestType::name, method, got.hdr, reference, stable), k.rmse);
            CHECK(different(got.composited, got.counted) == 0);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("transparency: sample scenes against the reference renderer", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Sample& sample : samples()) {
        const Camera& camera = sample.scene.cameras.front();
        RenderSettings settings = settings_for(128);
        settings.background = {0.25f, 0.5f, 0.125f};
        const auto reference = must(reference::render(sample.scene, camera,
                                                      {.size = settings.size,
                                                       .background = glm::dvec3(settings.background),
                                                       .lights = sample.scene.lights,
                                                       .stability = true}));
        for (const Transparency method : sample.scene.lights.empty() ? exact_without_light : exact_methods) {
            settings.transparency = method;
            settings.audit = true;
            const Composited got = composite<TestType>(*device, sample.scene, camera, settings);
            INFO(sample.name << ", " << name(method));
            check(report(sample.name, TestType::name, method, got.hdr, reference.radiance, reference.stable),
                  sample.rmse);
            if (facts(method).audit == Audit::fragments) CHECK(different(got.composited, got.counted) == 0);
            std::size_t other = 0, unstable = 0;
            for (std::size_t i = 0; i < got.counted.data.size(); ++i)
                (reference.stable.data[i] == 255 ? other : unstable) += got.counted.data[i] != reference.layers.data[i];
            CHECK(other == 0);
            if (method == exact_methods[0])
                std::printf("%s on %s: %zu unstable pixels have another number of layers\n", sample.name.c_str(),
                            TestType::name, unstable);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("transparency: no bit depends on the order of instances", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (Sample& sample : few_samples()) {
        std::vector<std::vector<ImageF>> pictures(exact_without_light.size());
        std::vector<Instance>& instances = sample.scene.instances;
        std::mt19937 random(3);
        for (int order = 0; order < 2; ++order) {
            for (std::size_t m = 0; m < pictures.size(); ++m) {
                RenderSettings settings = settings_for(96);
                settings.transparency = exact_without_light[m];
                pictures[m].push_back(
                    shoot<TestType>(*device, sample.scene, sample.scene.cameras.front(), settings).hdr);
            }
            for (std::size_t i = instances.size(); i > 1; --i) std::swap(instances[i - 1], instances[random() % i]);
        }
        for (std::size_t m = 0; m < pictures.size(); ++m) {
            const auto variance = must(measure::order_variance(pictures[m]));
            INFO(sample.name << ", " << name(exact_without_light[m]) << ": " << variance.different_pixels
                             << " pixels differ, by up to " << variance.max_difference << " at (" << variance.worst.x
                             << ", " << variance.worst.y << ")");
            CHECK(variance.bit_equal());
            CHECK(variance.nonfinite == 0);
        }
    }
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("transparency: Vulkan and OpenGL draw sample scenes alike", "[gpu]") {
    const auto vulkan = make_device<Vulkan>();
    const auto opengl = make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    for (const Sample& sample : few_samples())
        for (const Transparency method : exact_methods)
            for (const bool exact : {true, false}) {
                if (!exact && sample.scene.lights.empty()) continue;  // it is lighting that has two builds
                RenderSettings settings = settings_for(96);
                settings.transparency = method;
                settings.exact = exact;
                const Camera& camera = sample.scene.cameras.front();
                const Composited a = composite<Vulkan>(*vulkan, sample.scene, camera, settings);
                const Composited b = composite<OpenGL>(*opengl, sample.scene, camera, settings);
                const auto hdr = must(measure::image_error(a.hdr, b.hdr));
                std::printf("%s, %s%s: %zu of %zu pixels differ between Vulkan and OpenGL, by up to %.3g\n",
                            sample.name.c_str(), name(method), exact ? ", exact" : "",
                            static_cast<std::size_t>(hdr.different_pixels), static_cast<std::size_t>(hdr.pixels),
                            hdr.max);
                INFO(sample.name << ", " << name(method) << (exact ? ", exact" : ""));
                CHECK(must(measure::image_error(a.display, b.display)).max <= 1);
                CHECK(different(a.counted, b.counted) == 0);
                if (exact) CHECK(hdr.bit_equal());
            }
}
#endif
