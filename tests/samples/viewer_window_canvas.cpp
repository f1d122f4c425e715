// SPDX-License-Identifier: MIT
// The viewer in a real window: what the X server shows is the canvas, whatever is chosen and however large the window
// is, and the canvas is the one that is drawn without a window.
#include "support/viewer.hpp"
#include "support/windows.hpp"

namespace pellucid::test {
namespace {

/// A session whose canvas is presented by hand, frame by frame.
template <class B>
struct ViewerInWindow {
    viewer::State state;
    Log log;
    std::unique_ptr<Window> window;
    std::unique_ptr<viewer::Session<B>> session;
    std::unique_ptr<typename B::Surface> surface;

    ViewerInWindow(Scene scene, Extent2D size, viewer::Choices choices) {
        window = open_window(size);
        if (!window) return;
        state.choices = std::move(choices);
        state.show(loaded(std::move(scene)), viewer::layout_of(size, state.choices.hide_ui).picture_size());
        rhi::DeviceDesc desc = log.desc();
        desc.display = window->display();
        session = must(viewer::Session<B>::create(desc, state));
        surface = must(B::Surface::create(session->device(), {.window = window->native()}));
    }
    explicit operator bool() const { return surface != nullptr; }

    /// One frame of the window's size as it is.  Gives whether anything was drawn and shown.
    bool frame() { return frame(window->framebuffer()); }
    bool frame(Extent2D size) {
        window->poll();
        if (!must(session->frame({.seconds = 1}, size))) return false;
        return must(surface->present(session->canvas(), size));
    }
    bool shows_canvas() { return shows(*window, without_alpha(must(session->read_canvas()))); }
};

viewer::Choices with_panel() {
    viewer::Choices out;
    out.render.transparency = Transparency::sorted;
    return out;
}

TEMPLATE_LIST_TEST_CASE("the viewer's window shows its canvas, over thirty frames and twenty sizes", "[gpu][window]",
                        Backends) {
    ViewerInWindow<TestType> v(make_cyclic_triangles(), {400, 240}, with_panel());
    if (!v) return;
    for (int i = 0; i < 30; ++i) CHECK(v.frame());
    CHECK(v.shows_canvas());
    constexpr Extent2D sizes[] = {{500, 300}, {0, 0},  {320, 200}, {1, 1},     {640, 120},
                                  {300, 400}, {0, 80}, {400, 240}, {401, 241}, {90, 300}};
    for (std::uint32_t step = 0; step < 20; ++step) {
        const Extent2D size = sizes[step % std::size(sizes)];
        CAPTURE(step, size.width, size.height);
        if (size.width == 0 || size.height == 0) {  // minimised
            CHECK_FALSE(v.frame(size));
            continue;
        }
        resize(*v.window, size);
        if (v.frame()) CHECK(v.shows_canvas());
        CHECK(v.state.facts.left.problem.empty());
    }
}

TEMPLATE_LIST_TEST_CASE("every method in the window is the one without a window", "[gpu][window]", Backends) {
    constexpr Extent2D size{160, 120};
    ViewerInWindow<TestType> v(make_cyclic_triangles(), size, TestViewer<TestType>::quick());
    if (!v) return;
    TestViewer<TestType> headless(make_cyclic_triangles());
    for (const TransparencyTraits& t : all_transparencies) {
        CAPTURE(t.name);
        v.state.choices.render.transparency = t.method;
        REQUIRE(v.frame());
        CHECK(v.state.facts.left.problem.empty());
        CHECK(v.shows_canvas());
        headless.state.choices.render.transparency = t.method;
        REQUIRE(headless.frame());
        CHECK(equal(must(v.session->read_canvas()), headless.canvas()));
    }
}

}  // namespace
}  // namespace pellucid::test
