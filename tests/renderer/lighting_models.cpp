// SPDX-License-Identifier: MIT
// A lit scene by every reflectance model and environment, against the reference renderer.
#include <pellucid/scene/demo_scene.hpp>
#include "support/lit_scenes.hpp"

using namespace pellucid;
using test::error_of, test::Lit, test::lit_settings;

TEMPLATE_LIST_TEST_CASE("lighting: every model and environment gives the reference's picture", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Lit lit{"demo", make_demo_scene()};
    for (const EnvironmentKind kind : {EnvironmentKind::none, EnvironmentKind::sky})
        for (const Brdf brdf : {Brdf::gltf, Brdf::conserving, Brdf::seed, Brdf::blinn_phong}) {
            RenderSettings settings = lit_settings(lit);
            settings.brdf = brdf;
            settings.environment.kind = kind;
            const auto wanted = test::must(reference::render(lit.scene, lit.scene.cameras.front(),
                                                             {.size = settings.size,
                                                              .lights = lit.scene.lights,
                                                              .brdf = static_cast<reference::BrdfModel>(brdf),
                                                              .environment = settings.environment,
                                                              .stability = true}));
            const measure::ImageError e = error_of<TestType>(*device, lit, settings, wanted);
            std::printf("%s, %s, %s on %s: scaled RMSE %.3g, max %.3g\n", lit.name.c_str(), name(brdf), name(kind),
                        TestType::name, e.rmse, e.max);
            INFO(name(brdf) << ", " << name(kind));
            CHECK(e.rmse <= 0.003);
        }
}
