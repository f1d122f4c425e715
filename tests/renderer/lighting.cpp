// SPDX-License-Identifier: MIT
// Lit scenes by every way of finding lights, against the reference renderer and between the backends.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/image_file.hpp>
#include <pellucid/scene/light_field.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include "support/assets.hpp"
#include "support/lit_scenes.hpp"

using namespace pellucid;
using test::error_of, test::Lit, test::lit_settings;

namespace {

constexpr LightAssignment every_assignment[] = {LightAssignment::loop, LightAssignment::volumes, LightAssignment::tiled,
                                                LightAssignment::clustered, LightAssignment::automatic};

/// With the lit scene of known answer, where it is there.
std::vector<Lit> lit_scenes() {
    std::vector<Lit> out;
    if (const auto folder = test::scenes())
        out.push_back(
            {"L1", test::must(load_gltf((*folder / "L1_lit.gltf").string())), {0.03921569f, 0.03921569f, 0.05098039f}});
    out.push_back({"demo", make_demo_scene()});
    out.push_back({"lit glass", make_lit_glass(3)});
    out.push_back({"light field", make_light_field({.lights = 120, .overlap = 8})});
    // Every light of the demo ends somewhere.
    out.push_back({"demo, lights with ranges", make_demo_scene()});
    for (Light& light : out.back().scene.lights) light.range = 6;
    return out;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lighting: every way of finding lights gives the reference's picture", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const Lit& lit : lit_scenes()) {
        RenderSettings settings = lit_settings(lit);
        const auto wanted = test::must(reference::render(lit.scene, lit.scene.cameras.front(),
                                                         {.size = settings.size,
                                                          .background = glm::dvec3(lit.background),
                                                          .lights = lit.scene.lights,
                                                          .stability = true}));
        for (const LightAssignment method : every_assignment) {
            settings.lighting = method;
            const measure::ImageError e = error_of<TestType>(*device, lit, settings, wanted);
            std::printf("%s, %s on %s: scaled RMSE %.3g, max %.3g\n", lit.name.c_str(), name(method), TestType::name,
                        e.rmse, e.max);
            INFO(lit.name << ", " << name(method));
            CHECK(e.rmse <= 0.003);
        }
    }
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("lighting: the exact build gives the same bits on both backends, whatever finds the lights", "[gpu]") {
    const auto vulkan = test::make_device<Vulkan>();
    const auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl || vulkan->info().software != opengl->info().software) return;
    const Lit lit{"light field", make_light_field({.lights = 60})};
    for (const LightAssignment method : every_assignment)
        for (const EnvironmentKind kind : {EnvironmentKind::none, EnvironmentKind::sky}) {
            RenderSettings settings = lit_settings(lit);
            settings.exact = true;
            settings.lighting = method;
            settings.environment.kind = kind;
            settings.brdf = kind == EnvironmentKind::sky ? Brdf::conserving : Brdf::gltf;
            const Camera& camera = lit.scene.cameras.front();
            const ImageF a = test::shoot<Vulkan>(*vulkan, lit.scene, camera, settings).hdr;
            const ImageF b = test::shoot<OpenGL>(*opengl, lit.scene, camera, settings).hdr;
            std::size_t different = 0;
            for (std::size_t i = 0; i < a.data.size(); ++i) different += std::memcmp(&a.data[i], &b.data[i], 4) != 0;
            INFO(name(method) << ", " << name(kind));
            CHECK(different == 0);
        }
}
#endif
