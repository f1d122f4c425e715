// SPDX-License-Identifier: MIT
// The reference picture beside the renderer's: drawn on other threads, stopped when nobody wants it any more.
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include "support/catch.hpp"
#include "support/reference_picture.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

viewer::Choices against_reference() {
    viewer::Choices out = TestViewer<std::tuple_element_t<0, Backends>>::quick();
    out.against = viewer::Against::reference;
    out.split = 0.5f;
    return out;
}

TEST_CASE("a reference picture that is to be stopped is not complete, and nothing more of it is begun", "[cpu]") {
    const Scene scene = make_random_quads(32);
    const Camera camera = scene.cameras.front();
    std::atomic<bool> stop = true;
    reference::RenderOptions how{.size = {200, 200}, .stop = &stop};
    int steps = 0;
    how.user = &steps;
    how.progress = [](void* user, double) { ++*static_cast<int*>(user); };
    const reference::Picture none = must(reference::render(scene, camera, how));
    CHECK(!none.complete);
    CHECK(steps == 0);
    CHECK(std::all_of(none.radiance.data.begin(), none.radiance.data.end(), [](float f) { return f == 0; }));
    stop = false;
    const reference::Picture all = must(reference::render(scene, camera, how));
    CHECK(all.complete);
    CHECK(steps > 0);
    how.stop = nullptr;
    CHECK(must(reference::render(scene, camera, how)).radiance.data == all.radiance.data);
}

TEMPLATE_LIST_TEST_CASE("right of the split is what the reference renderer draws", "[gpu]", Backends) {
    viewer::Choices choices = against_reference();
    choices.reference_divisor = GENERATE(1u, 2u);
    choices.render.exposure_ev = 0.5f;
    TestViewer<TestType> v(make_lit_glass(), choices);
    if (!v) return;
    v.frame();
    v.settle();
    REQUIRE(v.state.facts.right.drawn);
    RenderSettings s = choices.render;
    const std::uint32_t d = choices.reference_divisor;
    s.size = {v.size.width / d, v.size.height / d};
    const auto options = samples::reference_options(*v.state.loaded.scene, s);
    const Image8 picture =
        samples::display_picture(s, must(reference::render(*v.state.loaded.scene, v.state.camera, options)).radiance);
    const Image8 canvas = v.canvas();
    unsigned wrong = 0;
    for (std::uint32_t y = 0; y < v.size.height; ++y)
        for (std::uint32_t x = 80; x < v.size.width; ++x) wrong += rgba(canvas, x, y) != rgba(picture, x / d, y / d);
    CHECK(wrong == 0);
    CHECK(equal(columns(canvas, 0, 80), columns(v.expected(choices.render), 0, 80)));
    // The tone map is that of the left picture, without drawing anew.
    v.state.choices.render.tonemap = ToneCurve::none;
    const std::uint64_t drawn = v.state.reference_number;
    v.frame();
    CHECK(v.state.reference_number == drawn);
    CHECK(!equal(columns(v.canvas(), 80, 160), columns(canvas, 80, 160)));
    // Errors of a picture of another size are measured at that size.
    v.state.choices.view = viewer::View::error;
    v.state.requests.measure = true;
    v.frame();
    v.settle();
    REQUIRE(v.state.facts.quality);
    CHECK(v.state.facts.quality->truth == "the reference");
    CHECK(v.state.facts.legend.high > 0);
    CHECK(v.state.facts.points.occasion().find(std::to_string(s.size.width) + "x" + std::to_string(s.size.height)) !=
          std::string::npos);
}

TEMPLATE_LIST_TEST_CASE("a scene that is dropped while the reference is drawn ends that, and gets one of its own",
                        "[gpu]", Backends) {
    TestViewer<TestType> v(make_teapot_grid({.columns = 4, .rows = 4}), against_reference());
    if (!v) return;
    const TemporaryFolder folder;
    must(write_gltf("panes.glb", make_intersecting_planes()));
    v.size = {320, 240};
    v.frame();
    REQUIRE(v.state.drawing.running());
    v.frame({.seconds = 1, .dropped = {"panes.glb"}});
    v.settle();
    CHECK(v.state.facts.scene == "panes.glb");
    REQUIRE(v.state.reference);
    CHECK(v.state.reference->scene == v.state.loaded.scene);
    CHECK(v.state.facts.right.drawn);
}

TEMPLATE_LIST_TEST_CASE("a reference that is cancelled is not drawn until it is asked for", "[gpu]", Backends) {
    TestViewer<TestType> v(make_teapot_grid({.columns = 4, .rows = 4}), against_reference());
    if (!v) return;
    v.frame();
    REQUIRE(v.state.drawing.running());
    v.state.requests.cancel_reference = true;
    v.frame();
    v.frame();
    CHECK(!v.state.drawing.running());
    CHECK(!v.state.reference);
    CHECK(!v.state.facts.right.drawn);
    v.state.requests.draw_reference = true;
    v.frame();
    CHECK(v.state.drawing.running());
    v.settle();
    CHECK(v.state.facts.right.drawn);
    // Another view is another picture: drawn when the camera rests.
    v.frame({.seconds = 0.01, .x = 80, .y = 60, .wheel = 1});
    CHECK(!v.state.drawing.running());
    CHECK(v.state.facts.reference_is_old);
    v.frame();
    CHECK(v.state.drawing.running());
}

}  // namespace
}  // namespace pellucid::test
