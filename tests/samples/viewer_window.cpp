// SPDX-License-Identifier: MIT
// The viewer in a real window: what the X server shows is the canvas; backends change and the window stays.
#include "pellucid_viewer/window_loop.hpp"
#include "support/catch.hpp"
#include "support/viewer.hpp"
#include "support/windows.hpp"

namespace pellucid::test {
namespace {

struct Looked {
    std::unique_ptr<samples::Window> window;
    viewer::State state;
    viewer::Options options;
    Log log;
    viewer::StartTimes times;

    Looked() : window(open_window({300, 200})) {
        options.frames = 3;
        options.vsync = false;
        state.choices.render.transparency = Transparency::sorted;
        state.show(loaded(make_cyclic_triangles()), {300, 200});
    }
    /// Runs on this backend and looks at the window before it is left.
    template <rhi::Backend B>
    std::optional<std::string> run() {
        rhi::DeviceDesc desc = log.desc();
        desc.display = window->display();
        viewer::WindowLoop<B> loop(options, state, *window, desc);
        const std::optional<std::string> next = must(loop.run(times));
        CHECK(shows(*window, without_alpha(must(loop.session().read_canvas()))));
        return next;
    }
};

TEMPLATE_LIST_TEST_CASE("the window shows the canvas, panel and all, and follows its size", "[gpu][window]", Backends) {
    Looked l;
    if (!l.window) return;
    CHECK(!l.run<TestType>());
    resize(*l.window, {240, 260});
    CHECK(!l.run<TestType>());
    l.window->close();
    l.options.frames = 0;
    CHECK(!l.run<TestType>());
}

TEST_CASE("another backend is chosen in the panel and goes on with the same view", "[gpu][window]") {
    using First = std::tuple_element_t<0, Backends>;
    using Last = std::tuple_element_t<std::tuple_size_v<Backends> - 1, Backends>;
    Looked l;
    if (!l.window) return;
    l.state.choices.render.transparency = Transparency::peel;
    l.state.requests.backend = Last::name;
    CHECK(l.run<First>() == Last::name);
    CHECK(l.state.facts.device.backend == First::name);
    CHECK(!l.run<Last>());
    CHECK(l.state.facts.device.backend == Last::name);
    CHECK(l.state.facts.left.label == "peel");
    l.state.requests.backend = First::name;
    CHECK(l.run<Last>() == First::name);
    CHECK(!l.run<First>());
}

}  // namespace
}  // namespace pellucid::test
