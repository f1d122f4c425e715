// SPDX-License-Identifier: MIT
// Devices that are lost, and those that have no room: with the backend that can be told to fail.
#include <pellucid/rhi/null.hpp>
#include "pellucid_viewer/guarded.hpp"
#include "support/catch.hpp"
#include "support/exit_status.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

constexpr Extent2D size{64, 48};

struct NullViewer {
    viewer::State state;
    viewer::Guarded<Null> guarded{{}, state};
    NullViewer() {
        state.show(loaded(make_cyclic_triangles()), size);
        must(guarded.start());
    }
    null::Device& device() { return guarded.session().device(); }
};

TEST_CASE("a lost device is replaced once, and everything is made again", "[cpu]") {
    NullViewer v;
    bool told = false;
    v.guarded.before_device_goes = [&] { told = true; };
    CHECK(must(v.guarded.frame({}, size)));
    v.state.choices.render.transparency = Transparency::peel;
    v.device().lose();
    CHECK(must(v.guarded.frame({}, size)));
    CHECK(told);
    CHECK(v.state.facts.message.find("the device was lost") != std::string::npos);
    CHECK(v.state.facts.message_is_error);
    CHECK(v.guarded.session().left()->settings().transparency == Transparency::peel);
    CHECK(v.state.facts.scene == "test scene");
    CHECK(must(v.guarded.frame({}, size)));
    SECTION("a second loss within a second ends the program with status 5") {
        v.device().lose();
        const Result<bool> ended = v.guarded.frame({}, size);
        REQUIRE(!ended);
        CHECK(ended.error().code == Errc::device_lost);
        CHECK(ended.error().message.find("twice within a second") != std::string::npos);
        CHECK(samples::exit_status(ended.error().code) == samples::Exit::device);
    }
    SECTION("a second loss later is another first one") {
        std::this_thread::sleep_for(std::chrono::milliseconds(1050));
        v.device().lose();
        CHECK(must(v.guarded.frame({}, size)));
    }
}

TEST_CASE("a device without room for a new setting keeps the old picture", "[cpu]") {
    NullViewer v;
    CHECK(must(v.guarded.frame({}, size)));
    const auto* before = v.guarded.session().left();
    v.state.choices.render.transparency = Transparency::dual_peel;
    v.device().fail_after(5);
    CHECK(must(v.guarded.frame({}, size)));
    CHECK(v.guarded.session().left() == before);
    CHECK(v.state.facts.left.problem.find("told to fail") != std::string::npos);
    v.device().fail_after(0);
    CHECK(must(v.guarded.frame({}, size)));
    CHECK(!v.state.facts.left.problem.empty());  // the sentence stays until another setting is chosen
    v.state.choices.render.transparency = Transparency::peel;
    CHECK(must(v.guarded.frame({}, size)));
    CHECK(v.state.facts.left.problem.empty());
}

TEST_CASE("a device that lacks what a method needs says so in the list of methods", "[cpu]") {
    viewer::State state;
    state.show(loaded(make_cyclic_triangles()), size);
    viewer::Guarded<Null> guarded({}, state);
    must(guarded.start());
    for (const TransparencyTraits& t : all_transparencies)
        CHECK(state.facts.unavailable[static_cast<std::size_t>(t.method)].empty());
    rhi::DeviceInfo info = guarded.session().device().info();
    info.float32_blending = false;
    guarded.session().device().pretend(info);
    CHECK(viewer::exact_method(info) == nullptr);
    state.choices.render.transparency = Transparency::sorted;
    state.choices.view = viewer::View::overdraw;
    CHECK(must(guarded.frame({}, size)));
    CHECK(state.facts.message.find("overdraw is counted by blending") != std::string::npos);
    state.choices.view = viewer::View::error;
    CHECK(must(guarded.frame({}, size)));
    CHECK(state.facts.message.find("no exact method runs") != std::string::npos);
}

}  // namespace
}  // namespace pellucid::test
