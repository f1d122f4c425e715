// SPDX-License-Identifier: MIT
// What a pointer does: on the picture it moves the camera, on the panel it does not.
#include "support/catch.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

template <rhi::Backend B>
viewer::Choices with_panel() {
    viewer::Choices out = TestViewer<B>::quick();
    out.hide_ui = false;
    return out;
}

TEMPLATE_LIST_TEST_CASE("the pointer turns the camera over the picture and presses buttons over the panel", "[gpu]",
                        Backends) {
    TestViewer<TestType> v(make_cyclic_triangles(), with_panel<TestType>());
    if (!v) return;
    v.size = {500, 300};
    const auto at = [](float x, float y, bool held) {
        return viewer::Input{.seconds = 0.1, .x = x, .y = y, .left = held};
    };
    v.frame(at(400, 100, false));
    const Camera before = v.state.camera;
    SECTION("drags over the picture") {
        v.frame(at(400, 100, true));
        v.frame(at(430, 120, true));
        CHECK(!viewer::same(v.state.camera, before));
        const Camera turned = v.state.camera;
        v.frame(at(100, 120, true));  // a drag goes on over the panel
        CHECK(!viewer::same(v.state.camera, turned));
        v.frame(at(100, 120, false));
        const Camera rest = v.state.camera;
        v.frame(at(450, 200, false));
        CHECK(viewer::same(v.state.camera, rest));
        v.state.requests.camera = 0;
        v.frame(at(450, 200, false));
        CHECK(viewer::same(v.state.camera, before));
    }
    SECTION("drags and wheels over the panel leave the camera alone") {
        v.frame(at(100, 250, false));
        v.frame(at(100, 250, true));
        v.frame(at(300, 100, true));
        v.frame(at(300, 100, false));
        v.frame({.seconds = 0.1, .x = 100, .y = 200, .wheel = 2});
        CHECK(viewer::same(v.state.camera, before));
    }
    SECTION("a click on a tab") {
        REQUIRE(v.state.choices.tab == viewer::Tab::settings);
        const float x = 125, y = 72;  // the second of three
        v.frame(at(x, y, false));
        v.frame(at(x, y, true));
        v.frame(at(x, y, true));
        v.frame(at(x, y, false));
        v.frame(at(x, y, false));
        CHECK(v.state.choices.tab == viewer::Tab::time);
        CHECK(viewer::same(v.state.camera, before));
    }
    SECTION("the wheel over the picture comes closer, keys walk") {
        v.frame({.seconds = 0.1, .x = 400, .y = 100, .wheel = 1});
        CHECK(!viewer::same(v.state.camera, before));
        const Camera closer = v.state.camera;
        v.frame({.seconds = 0.1, .move_forward = 1});
        CHECK(viewer::same(v.state.camera, closer));  // in orbit they do nothing
        v.state.choices.motion = viewer::Motion::walk;
        v.frame({.seconds = 0.1, .move_forward = 1});
        CHECK(!viewer::same(v.state.camera, closer));
    }
    CHECK(equal(columns(v.canvas(), v.layout().panel, 500), v.expected(v.state.choices.render)));
}

TEMPLATE_LIST_TEST_CASE("a key hides the panel and shows it again", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles(), with_panel<TestType>());
    if (!v) return;
    v.frame();
    v.frame({.seconds = 1, .toggle_ui = true});
    CHECK(v.state.choices.hide_ui);
    CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
    v.frame({.seconds = 1, .toggle_ui = true});
    CHECK(!v.state.choices.hide_ui);
}

}  // namespace
}  // namespace pellucid::test
