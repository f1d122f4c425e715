// SPDX-License-Identifier: MIT
// Heat maps: the numbers behind them are known in closed form, or are those of the renderer.
#include "support/catch.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

/// Three translucent sheets in front of an opaque one, two behind it.
Scene sheets() {
    return make_sheets({{.slot = 30},
                        {.slot = 40},
                        {.slot = 100, .color = {0.2f, 0.3f, 0.4f, 1}, .opaque = true},
                        {.slot = 120},
                        {.slot = 130},
                        {.slot = 140}});
}

TEMPLATE_LIST_TEST_CASE("layers are translucent fragments in front of what is opaque, overdraw is all there are",
                        "[gpu]", Backends) {
    TestViewer<TestType> v(sheets());
    if (!v) return;
    for (const auto& [view, count] : {std::pair(viewer::View::layers, 3.0), {viewer::View::overdraw, 6.0}}) {
        INFO(viewer::name(view));
        v.state.choices.view = view;
        v.frame();
        const viewer::Legend& legend = v.state.facts.legend;
        CHECK(legend.high == count);
        CHECK(legend.low == 0);
        CHECK(legend.mean == count);
        const Image8 canvas = v.canvas();
        const measure::Rgb8 brightest = measure::heat_color(1);
        for (std::size_t c = 0; c < 3; ++c) CHECK(canvas.texel(80, 60)[c] == brightest[c]);
    }
    v.state.choices.view = viewer::View::picture;
    v.frame();
    CHECK(v.state.facts.legend.empty());
    CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
}

TEMPLATE_LIST_TEST_CASE("the layers' colours are those of the renderer's counts", "[gpu]", Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.view = viewer::View::layers;
    TestViewer<TestType> v(make_random_quads(32), choices);
    if (!v) return;
    v.frame();
    const Image<std::uint32_t> counts = must(v.session->left()->count_layers());
    CHECK(equal(v.canvas(), viewer::heat_picture(counts, "").display));
    CHECK(v.state.facts.legend.high == *std::max_element(counts.data.begin(), counts.data.end()));
}

TEMPLATE_LIST_TEST_CASE("errors are black where there are none, and those of the two pictures where there are", "[gpu]",
                        Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.view = viewer::View::error;
    TestViewer<TestType> v(make_cyclic_triangles(), choices);
    if (!v) return;
    const auto radiance = [&](Transparency method) {
        auto renderer = must(Renderer<TestType>::create(v.session->device(), *v.state.loaded.scene,
                                                        {.size = v.size, .transparency = method}));
        (void)must(renderer->render(v.state.rig.camera()));
        return viewer::rgb(must(renderer->read_hdr()));
    };
    const ImageF sorted = radiance(Transparency::sorted), exact = radiance(Transparency::abuffer);
    SECTION("against the exact method, where nothing else is chosen") {
        v.frame();
        const ImageF errors = must(measure::error_picture(sorted, exact));
        CHECK(equal(v.canvas(), viewer::heat_picture(errors, "", measure::HeatScale::logarithmic).display));
        CHECK(v.state.facts.legend.high > 0.01);
        v.state.choices.render.transparency = Transparency::abuffer;
        v.frame();
        CHECK(v.state.facts.legend.high == 0);
        CHECK(rgba(v.canvas(), 80, 60) == 0x000000FF);
    }
    SECTION("against the right picture") {
        v.state.choices.against = viewer::Against::method;
        v.state.choices.other = Transparency::sorted;
        v.state.choices.split = 1;
        v.frame();
        CHECK(v.state.facts.legend.high == 0);
        v.state.choices.other = Transparency::none;
        v.state.choices.split = 0.5f;
        v.frame();
        CHECK(v.state.facts.legend.high > 0.01);
        const Image8 right = v.expected(viewer::with_method(v.state.choices.render, Transparency::none));
        CHECK(equal(columns(v.canvas(), 80, 160), columns(right, 80, 160)));
    }
}

TEMPLATE_LIST_TEST_CASE("a frame's GPU times arrive with the next one, also of methods that wait on their way", "[gpu]",
                        Backends) {
    for (const Transparency method : {Transparency::sorted, Transparency::abuffer})
        for (const viewer::View view : {viewer::View::picture, viewer::View::layers}) {
            CAPTURE(name(method), name(view));
            viewer::Choices choices = TestViewer<TestType>::quick();
            choices.render.transparency = method;
            choices.view = view;
            TestViewer<TestType> v(make_cyclic_triangles(), choices);
            if (!v) return;
            if (v.state.facts.device.timestamp_ns == 0) return;
            for (int i = 0; i < 5; ++i) {
                v.frame();
                (void)v.canvas();  // waits
            }
            const viewer::FrameHistory& history = v.state.facts.history;
            CHECK(history.gpu.count() >= 3);
            const auto ran = [&](const char* pass) {
                return std::any_of(history.passes.begin(), history.passes.end(),
                                   [&](const auto& p) { return p.name == pass && p.ms.count() >= 3; });
            };
            CHECK(ran("tonemap"));
            CHECK(ran(method == Transparency::sorted ? "sorted_forward" : "abuffer"));
        }
}

}  // namespace
}  // namespace pellucid::test
