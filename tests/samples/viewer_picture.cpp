// SPDX-License-Identifier: MIT
// What the viewer shows is what the renderer draws, code for code, with the panel and without it, on both sides of the
// split, and in the files that it writes.
#include <set>
#include "support/catch.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

TEMPLATE_LIST_TEST_CASE("without the panel the canvas is the renderer's picture", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    CHECK(v.frame());
    CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
    CHECK(equal(must(v.session->read_picture()), v.canvas()));
}

TEMPLATE_LIST_TEST_CASE("beside the panel the canvas is the renderer's picture of what is left", "[gpu]", Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.hide_ui = false;
    TestViewer<TestType> v(make_cyclic_triangles(), choices);
    if (!v) return;
    v.size = {520, 300};
    for (const viewer::Tab tab : {viewer::Tab::settings, viewer::Tab::time, viewer::Tab::error}) {
        v.state.choices.tab = tab;
        CHECK(v.frame());
        const Image8 canvas = v.canvas();
        const std::uint32_t panel = v.layout().panel;
        CHECK(panel == 260);
        CHECK(equal(columns(canvas, panel, canvas.width), v.expected(v.state.choices.render)));
        // There is something on the panel: its background is one colour, its letters are not.
        const Image8 left = columns(canvas, 0, panel);
        std::set<std::uint32_t> colors;
        for (std::uint32_t y = 0; y < left.height; ++y)
            for (std::uint32_t x = 0; x < left.width; ++x) colors.insert(rgba(left, x, y));
        CHECK(colors.size() > 10);
    }
    CHECK(equal(must(v.session->read_picture()), v.expected(v.state.choices.render)));
}

TEMPLATE_LIST_TEST_CASE("the split shows one picture left of it and the other right of it", "[gpu]", Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.against = viewer::Against::method;
    choices.other = Transparency::none;
    TestViewer<TestType> v(make_cyclic_triangles(), choices);
    if (!v) return;
    const Image8 left = v.expected(choices.render),
                 right = v.expected(viewer::with_method(choices.render, Transparency::none));
    REQUIRE(!equal(left, right));
    for (const auto& [split, column] : {std::pair(0.0f, 0u), {0.5f, 80u}, {0.25f, 40u}, {1.0f, 160u}}) {
        v.state.choices.split = split;
        CHECK(v.frame());
        const Image8 canvas = v.canvas();
        INFO("split " << split);
        if (column > 0) CHECK(equal(columns(canvas, 0, column), columns(left, 0, column)));
        if (column < 160) CHECK(equal(columns(canvas, column, 160), columns(right, column, 160)));
    }
    v.state.choices.against = viewer::Against::nothing;
    CHECK(v.frame());
    CHECK(equal(v.canvas(), left));
    CHECK(v.session->right() == nullptr);
}

TEMPLATE_LIST_TEST_CASE("files that the viewer writes hold what it shows", "[gpu]", Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.hide_ui = false;
    TestViewer<TestType> v(make_cyclic_triangles(), choices);
    if (!v) return;
    const TemporaryFolder folder;
    v.size = {400, 200};
    v.frame();
    v.state.requests.screenshot_png = true;
    v.frame();
    CHECK(equal(must(read_image("pellucid-viewer-1.png")), v.canvas()));
    CHECK(v.state.facts.message == "pellucid-viewer-1.png is written");
    CHECK(!v.state.facts.message_is_error);
    v.state.requests.picture_png = true;
    v.state.requests.picture_exr = true;
    v.frame();
    CHECK(equal(must(read_image("pellucid-viewer-2.png")), v.expected(choices.render)));
    CHECK(std::filesystem::file_size("pellucid-viewer-1.exr") > 100);
    // The canvas still has its panel.
    const Image8 canvas = v.canvas();
    CHECK(!equal(columns(canvas, 0, 1), columns(canvas, 399, 400)));
}

TEMPLATE_LIST_TEST_CASE("the canvas follows twenty sizes, among them none", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    constexpr Extent2D sizes[] = {{64, 48}, {0, 0}, {1, 1},  {200, 30},  {0, 50},
                                  {33, 77}, {8, 8}, {40, 0}, {128, 128}, {64, 48}};
    v.frame();
    const std::uint32_t objects = v.session->device().live_objects();
    for (int step = 0; step < 20; ++step) {
        v.size = sizes[step % std::size(sizes)];
        const bool empty = v.size.width == 0 || v.size.height == 0;
        CAPTURE(step, v.size.width, v.size.height);
        CHECK(v.frame() == !empty);
        if (empty) continue;
        CHECK(v.session->canvas_size() == v.size);
        if (step > 9) continue;  // the same sizes again
        CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
    }
    v.size = {160, 120};
    v.frame();
    CHECK(v.session->device().live_objects() == objects);
    // With the panel, the narrowest canvases have room for half a picture, or none.
    v.state.choices.hide_ui = false;
    for (const Extent2D size : {Extent2D{1, 1}, {2, 2}, {3, 200}, {160, 120}}) {
        v.size = size;
        CAPTURE(size.width, size.height);
        CHECK(v.frame());
    }
}

}  // namespace
}  // namespace pellucid::test
