// SPDX-License-Identifier: MIT
// Time against error: the bookkeeping, and what is measured.
#include "support/catch.hpp"
#include "support/methods.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

TEST_CASE("points keep one entry a combination, its least time and its newest error", "[cpu]") {
    viewer::Points points;
    points.begin("a", "occasion a");
    points.add("sorted", 2, 0.1);
    points.add("peel", 5, 0);
    points.add("sorted", 3, 0.2);
    REQUIRE(points.all().size() == 2);
    CHECK(points.all()[0].ms == 2);
    CHECK(points.all()[0].error == 0.2);
    CHECK(points.all()[0].runs == 2);
    CHECK(points.has("peel"));
    CHECK(!points.has("abuffer"));
    points.begin("a", "occasion a");
    CHECK(points.all().size() == 2);
    points.begin("b", "occasion b");
    CHECK(points.all().empty());
    CHECK(points.occasion() == "occasion b");
}

TEST_CASE("the best points are those that none beats, and a new one only ever takes that from others", "[cpu]") {
    viewer::Points points;
    points.begin("a", "a");
    unsigned seed = 1;
    const auto random = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0; };
    std::vector<std::string> best_before;
    for (int i = 0; i < 200; ++i) {
        const std::string label = std::to_string(i);
        points.add(label, 0.1 + random(), random() < 0.2 ? 0 : random());
        std::vector<std::string> best;
        for (const viewer::Point& p : points.all())
            if (points.best(p)) best.push_back(p.label);
        REQUIRE(!best.empty());
        for (const std::string& b : best)  // what is best now was best before, or is new
            CHECK((b == label || std::find(best_before.begin(), best_before.end(), b) != best_before.end()));
        // Along the front, slower is closer.
        std::vector<viewer::Point> front;
        for (const viewer::Point& p : points.all())
            if (points.best(p)) front.push_back(p);
        std::sort(front.begin(), front.end(), [](const auto& p, const auto& q) { return p.ms < q.ms; });
        for (std::size_t k = 1; k < front.size(); ++k) CHECK(front[k].error < front[k - 1].error);
        best_before = best;
    }
}

TEST_CASE("settings are told apart by everything that they hold", "[cpu]") {
    const RenderSettings usual;
    CHECK(viewer::same(usual, usual));
    CHECK(viewer::describe(usual) == "abuffer");
    RenderSettings s = usual;
    s.environment.sky.zenith.x += 0.1f;
    CHECK(!viewer::same(s, usual));
    s = usual;
    s.memory_budget = std::uint64_t{64} << 20u;
    s.min_transmittance = 0.01f;
    s.shading = ShadingStage::fragment;
    CHECK(!viewer::same(s, usual));
    CHECK(viewer::describe(s) == "abuffer, 64 MiB, T 0.01, fragment");
    CHECK(viewer::describe(viewer::with_method(s, Transparency::sorted)) == "sorted, fragment");
    CHECK(viewer::describe(viewer::with_method(s, Transparency::peel)) == "peel, T 0.01, fragment");
}

TEMPLATE_LIST_TEST_CASE("every method is measured, one a frame, and exact ones have no error to speak of", "[gpu]",
                        Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    v.frame();
    v.state.requests.measure_all = true;
    std::size_t frames = 0;
    do {
        v.frame();
        ++frames;
        CHECK(v.state.facts.points.all().size() == frames);
    } while (v.session->measuring());
    CHECK(frames == none_and_all_methods().size());
    for (const Transparency method : none_and_all_methods()) {
        const auto& all = v.state.facts.points.all();
        const auto at = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.label == name(method); });
        INFO(name(method));
        REQUIRE(at != all.end());
        CHECK(at->ms > 0);
        if (facts(method).exact >= Exactness::single_depths)
            CHECK(at->error < 1e-3);
        else if (method == Transparency::none || method == Transparency::sorted)
            CHECK(at->error > 1e-3);
    }
    CHECK(v.state.facts.points.occasion().find("abuffer, which is exact") != std::string::npos);
    // Another view is another occasion.
    v.frame({.seconds = 0.1, .x = 80, .y = 60, .wheel = 3});
    v.state.requests.measure = true;
    v.frame();
    CHECK(v.state.facts.points.all().size() == 1);
}

TEMPLATE_LIST_TEST_CASE("the two pictures are compared when that is asked for, and by itself at rest", "[gpu]",
                        Backends) {
    viewer::Choices choices = TestViewer<TestType>::quick();
    choices.against = viewer::Against::method;
    choices.other = Transparency::abuffer;
    const bool by_itself = GENERATE(false, true);
    choices.measure_at_rest = by_itself;
    TestViewer<TestType> v(make_cyclic_triangles(), choices);
    if (!v) return;
    v.frame({.seconds = 0.01});
    v.settle();
    v.frame();
    v.settle();
    CHECK(v.state.facts.quality.has_value() == by_itself);
    if (!by_itself) {
        v.state.requests.measure = true;
        v.frame();
        v.settle();
    }
    REQUIRE(v.state.facts.quality);
    const viewer::Quality quality = *v.state.facts.quality;
    CHECK(quality.test == "sorted");
    CHECK(quality.truth == "abuffer");
    const measure::ImageError error = must(measure::image_error(viewer::rgb(must(v.session->left()->read_hdr())),
                                                                viewer::rgb(must(v.session->right()->read_hdr()))));
    CHECK(quality.rmse == error.rmse);
    CHECK(quality.different == error.different_pixels);
    CHECK(quality.flip > 0);
    CHECK(!v.state.facts.quality_is_old);
    CHECK(v.state.facts.points.has("sorted"));
    v.state.choices.measure_at_rest = false;
    v.state.choices.render.transparency = Transparency::none;
    v.frame();
    CHECK(v.state.facts.quality_is_old);
}

}  // namespace
}  // namespace pellucid::test
