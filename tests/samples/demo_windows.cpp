// SPDX-License-Identifier: MIT
// The demonstrations in windows: sizes, frames and the end of the loop; what keys and the pointer do is what the stages
// draw from there.
#include <pellucid/scene/sample_scenes.hpp>
#include "samples/deferred_demo/window.hpp"
#include "samples/peeling_demo/window.hpp"
#include "support/window_events.hpp"
#include "support/windows.hpp"

using namespace pellucid;
using namespace pellucid::samples;
using test::WindowHands;

namespace {

constexpr Extent2D size{160, 120};

/// Shows a pattern of the size that it was told, does something in some frames, and writes down what it was asked.
template <rhi::Backend B>
struct Script {
    typename B::Device* device;
    Extent2D told;
    std::vector<Extent2D>* sizes;
    std::vector<Moment>* moments;
    std::function<void(Window&, std::size_t)> act;
    rhi::Unique<typename B::Device, rhi::Texture> texture = {};

    Result<void> resize(Extent2D to) {
        sizes->push_back(told = to);
        texture = test::make_texture(*device, test::pattern(to, 1));
        return {};
    }
    Result<void> frame(Window& window, const Moment& moment) {
        moments->push_back(moment);
        act(window, moments->size());
        return {};
    }
    rhi::Texture picture() { return texture; }
};

/// Frames that a scripted demonstration had, and sizes that it was told.
struct Seen {
    std::vector<Extent2D> sizes;
    std::vector<Moment> moments;
};
template <rhi::Backend B>
Result<Seen> run_script(std::uint32_t frames, std::function<void(Window&, std::size_t)> act) {
    Seen seen;
    test::Log log;
    const auto make = [&](typename B::Device& device, Extent2D at) -> Result<std::unique_ptr<Script<B>>> {
        std::unique_ptr<Script<B>> script(new Script<B>{&device, {}, &seen.sizes, &seen.moments, std::move(act)});
        PELLUCID_CHECK(script->resize(at));
        return script;
    };
    PELLUCID_CHECK(show<B>({.title = "script", .size = size}, log.desc(), frames, make));
    return seen;
}

/// A window, a device for it, and hands.
template <rhi::Backend B>
struct Desk {
    test::Shown<B> shown = test::open_shown<B>(size);
    explicit operator bool() const { return static_cast<bool>(shown); }
    Window& window() { return *shown.window; }
    WindowHands hands() { return {window().display().connection, window().native()}; }
};

Moment moment_at(double seconds, double step = 0, double dx = 0, double dy = 0) {
    return {.seconds = seconds, .step = step, .dx = dx, .dy = dy};
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("show: ends after its frames, when closed, and by Escape", "[gpu][window]", test::Backends) {
    const Desk<TestType> desk;  // stays open: an X server without windows may start anew
    if (!desk) return;
    CHECK(test::must(run_script<TestType>(5, [](Window&, std::size_t) {})).moments.size() == 5);
    const auto closed = [](Window& window, std::size_t frame) {
        if (frame == 3) window.close();
    };
    CHECK(test::must(run_script<TestType>(0, closed)).moments.size() == 3);
    const auto escape = [](Window& window, std::size_t frame) {
        if (frame == 4) WindowHands(window.display().connection, window.native()).key(0xff1b, true);
    };
    CHECK(test::must(run_script<TestType>(0, escape)).moments.size() == 4);
}

TEMPLATE_LIST_TEST_CASE("show: tells new sizes, the time, and the pointer's way", "[gpu][window]", test::Backends) {
    const Desk<TestType> desk;  // stays open: an X server without windows may start anew
    if (!desk) return;
    const Seen seen = test::must(run_script<TestType>(12, [](Window& window, std::size_t frame) {
        WindowHands hands(window.display().connection, window.native());
        if (frame == 2) test::resize(window, {200, 100});
        if (frame == 6) hands.move(50, 50);
        if (frame == 7) hands.move(70, 40);
        if (frame == 9) hands.button(4, true), hands.button(4, false);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }));
    REQUIRE(seen.sizes.size() == 2);
    CHECK((seen.sizes[0] == size && seen.sizes[1] == Extent2D{200, 100}));
    double time = 0;
    for (const Moment& m : seen.moments) {
        CHECK(m.seconds >= time);
        CHECK((m.step >= 0 && m.step <= 0.1));
        time = m.seconds;
    }
    CHECK(time > 0.05);
    CHECK(seen.moments[7].dx == Approx(0.2));  // of the window's height
    CHECK(seen.moments[7].dy == Approx(-0.1));
    CHECK(seen.moments[9].wheel == 1);
    CHECK(seen.moments[10].wheel == 0);
}

TEMPLATE_LIST_TEST_CASE("show: an error of the demonstration comes out", "[gpu][window]", test::Backends) {
    const Desk<TestType> desk;  // stays open: an X server without windows may start anew
    if (!desk) return;
    test::Log log;
    const auto make = [](typename TestType::Device&, Extent2D) -> Result<std::unique_ptr<Script<TestType>>> {
        return Error{Errc::unsupported, "no such thing"};
    };
    const auto failed = show<TestType>({.size = size}, log.desc(), 3, make);
    REQUIRE_FALSE(failed);
    CHECK(failed.error().message == "no such thing");
}

TEMPLATE_LIST_TEST_CASE("deferred_demo: walks by keys and looks by the pointer", "[gpu][window]", test::Backends) {
    Desk<TestType> desk;
    if (!desk) return;
    const RenderSettings settings{.size = size, .transparency = Transparency::sorted};
    const auto demo = test::must(DeferredWindow<TestType>::create(*desk.shown.device, settings));
    auto stage = test::must(DeferredStage<TestType>::create(*desk.shown.device, settings));
    const Camera lens = stage.scene().cameras.front();
    FirstPersonCamera camera = FirstPersonCamera::from(lens, 3);
    const auto same = [&](const Moment& moment) {
        desk.window().poll();
        test::must(demo->frame(desk.window(), moment));
        (void)test::must(stage.draw(camera.camera(lens), moment.seconds));
        const auto a = test::read<std::uint8_t>(*desk.shown.device, demo->picture(), size, 4);
        return a.data == test::must(stage.renderer().read_display()).data;
    };
    CHECK(same(moment_at(0)));
    CHECK(same(moment_at(2, 0.05, 0.3, 0.1)));  // nothing is held
    WindowHands hands = desk.hands();
    hands.key('w', true);
    hands.key('d', true);
    camera.move(1, 0, 1, 0.1);
    CHECK(same(moment_at(2, 0.1)));
    hands.key('d', false);
    hands.key('w', false);
    hands.key('q', true);
    hands.key(0xffe1, true);  // Shift
    camera.move(0, -1, 0, 0.4);
    CHECK(same(moment_at(3, 0.1)));
    hands.key('q', false);
    hands.button(1, true);
    camera.look(0.25 * lens.vertical_fov, -0.125 * lens.vertical_fov);
    CHECK(same(moment_at(3, 0.1, 0.25, -0.125)));
    hands.button(1, false);
    CHECK(same(moment_at(3, 0.1, 0.25, -0.125)));
}

TEMPLATE_LIST_TEST_CASE("peeling_demo: keys choose the layer, the pointer goes round", "[gpu][window]",
                        test::Backends) {
    Desk<TestType> desk;
    if (!desk) return;
    const Scene scene = make_peeling_scene();
    const Camera& lens = scene.cameras.front();
    const auto demo = test::must(PeelingWindow<TestType>::create(*desk.shown.device, scene, size));
    const auto stage = test::must(PeelingStage<TestType>::create(*desk.shown.device, scene, size));
    OrbitCamera camera = OrbitCamera::from(lens, scene_bounds(scene));
    const auto same = [&](const Moment& moment, LayerRange range) {
        desk.window().poll();
        test::must(demo->frame(desk.window(), moment));
        (void)test::must(stage->draw(camera.camera(lens), range));
        const auto a = test::read<std::uint8_t>(*desk.shown.device, demo->picture(), size, 4);
        return a.data == test::must(stage->read_display()).data;
    };
    WindowHands hands = desk.hands();
    CHECK(same({}, {}));
    hands.tap('3');
    CHECK(same({}, {2, 3}));
    hands.tap(0xff09);  // Tab
    CHECK(same({}, {0, 3}));
    CHECK_FALSE(same({}, {2, 3}));
    hands.tap(0xff53);  // right
    hands.tap(0xff53);
    hands.tap(0xff51);  // left
    CHECK(same({}, {0, 4}));
    hands.tap('0');
    CHECK(same({}, {}));
    hands.button(1, true);
    camera.orbit(4 * 0.2, 4 * 0.05);
    CHECK(same(moment_at(0, 0, 0.2, 0.05), {}));
    hands.button(1, false);
    camera.dolly(0.9 * 0.9);
    CHECK(same({.wheel = 2}, {}));
}

TEST_CASE("peeling_demo: what keys choose, in words", "[cpu]") {
    LayerChoice choice;
    CHECK(choice.text() == "all layers");
    CHECK(choice.range() == LayerRange{0, 0});
    choice.previous();
    CHECK(choice.number == 0);
    choice.next();
    CHECK(choice.text() == "layer 1 alone");
    CHECK(choice.range() == LayerRange{0, 1});
    choice.toggle();
    CHECK(choice.text() == "the first layer");
    choice.choose(7);
    CHECK(choice.text() == "the first 7 layers");
    CHECK(choice.range() == LayerRange{0, 7});
    choice.toggle();
    CHECK(choice.range() == LayerRange{6, 7});
    choice.choose(1000);
    CHECK(choice.number == LayerChoice::most);
}
