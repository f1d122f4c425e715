// SPDX-License-Identifier: MIT
// Settings that are changed while the viewer runs: each is the renderer's own picture of it; one that cannot be had is
// a sentence, and the picture stays.
#include "support/catch.hpp"
#include "support/methods.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

TEMPLATE_LIST_TEST_CASE("every method is switched to, and nothing of the others is kept", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    v.frame();
    const std::uint32_t objects = v.session->device().live_objects();
    for (const Transparency method : none_and_all_methods()) {
        INFO(name(method));
        v.state.choices.render = viewer::with_method(v.state.choices.render, method);
        CHECK(v.frame());
        CHECK(v.state.facts.left.problem.empty());
        CHECK(v.session->left()->settings().transparency == method);
        CHECK(v.state.facts.left.label == name(method));
        CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
    }
    v.state.choices.render = viewer::with_method(v.state.choices.render, Transparency::sorted);
    v.frame();
    CHECK(v.session->device().live_objects() == objects);
}

TEMPLATE_LIST_TEST_CASE("settings of light and display are obeyed in the next frame", "[gpu]", Backends) {
    TestViewer<TestType> v(make_lit_glass());
    if (!v) return;
    v.frame();
    Image8 last = v.canvas();
    const auto change = [&](const char* what, auto&& edit) {
        edit(v.state.choices.render);
        CHECK(v.frame());
        const Image8 now = v.canvas();
        INFO(what);
        CHECK(!equal(now, last));
        CHECK(equal(now, v.expected(v.state.choices.render)));
        last = now;
    };
    const Renderer<TestType>* renderer = v.session->left();
    change("exposure", [](RenderSettings& s) { s.exposure_ev = 1; });
    CHECK(v.session->left() == renderer);
    change("tone map", [](RenderSettings& s) { s.tonemap = ToneCurve::reinhard; });
    change("BRDF", [](RenderSettings& s) { s.brdf = Brdf::blinn_phong; });
    change("background", [](RenderSettings& s) { s.background = {0.5f, 0, 0}; });
    change("environment", [](RenderSettings& s) { s.environment.kind = EnvironmentKind::sky; });
}

TEMPLATE_LIST_TEST_CASE("a setting that cannot be had is a sentence, and the picture stays", "[gpu]", Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.render.transparency = Transparency::abuffer;
    TestViewer<TestType> v(make_random_quads(64), choices);
    if (!v) return;
    v.frame();
    const Image8 before = v.canvas();
    RenderSettings& s = v.state.choices.render;
    SECTION("a memory budget that holds no row") {
        s.memory_budget = 1;
        v.frame();
        CHECK(v.state.facts.left.problem.find("budget") != std::string::npos);
        CHECK(equal(v.canvas(), before));
        v.frame();  // it is not tried again and again, and the sentence stays
        CHECK(!v.state.facts.left.problem.empty());
        // A new size takes the last settings that worked.
        v.size = {90, 70};
        v.frame();
        CHECK(!v.state.facts.left.problem.empty());
        CHECK(v.session->left()->settings().size == v.size);
        s.memory_budget = 0;
        CHECK(equal(v.canvas(), v.expected(s)));
        v.frame();
        CHECK(v.state.facts.left.problem.empty());
    }
    SECTION("a shadow map that is too large") {
        s.shadows = Shadows::map;
        s.shadow_size = 1u << 30u;
        v.frame();
        CHECK(v.state.facts.left.problem.find("shadow") != std::string::npos);
        CHECK(equal(v.canvas(), before));
    }
}

}  // namespace
}  // namespace pellucid::test
