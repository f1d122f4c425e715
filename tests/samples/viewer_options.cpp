// SPDX-License-Identifier: MIT
// The viewer's command line.
#include "pellucid_viewer/options.hpp"
#include "support/catch.hpp"
#include <vector>

namespace pellucid::test {
namespace {

namespace viewer = samples::viewer;

std::pair<viewer::Options, std::optional<int>> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "pellucid-viewer");
    return viewer::parse_options(static_cast<int>(arguments.size()), const_cast<char**>(arguments.data()));
}

TEST_CASE("options become choices", "[cpu]") {
    const auto [o, done] =
        parse({"scene.glb", "--backend",     "opengl",  "--size",     "800x600",    "--transparency", "peel",
               "--against", "sorted",        "--split", "0.25",       "--view",     "overdraw",       "--tab",
               "time",      "--environment", "sky",     "--headless", "--no-vsync", "--hide-ui"});
    REQUIRE(!done);
    CHECK(o.scene == "scene.glb");
    CHECK(o.backend == "opengl");
    CHECK(o.size == Extent2D{800, 600});
    CHECK(o.choices.render.transparency == Transparency::peel);
    CHECK(o.choices.against == viewer::Against::method);
    CHECK(o.choices.other == Transparency::sorted);
    CHECK(o.choices.split == 0.25f);
    CHECK(o.choices.view == viewer::View::overdraw);
    CHECK(o.choices.tab == viewer::Tab::time);
    CHECK(o.choices.render.environment.kind == EnvironmentKind::sky);
    CHECK(o.headless);
    CHECK(o.frames == 4);
    CHECK(!o.vsync);
    CHECK(o.choices.hide_ui);
    CHECK(parse({"--against", "reference"}).first.choices.against == viewer::Against::reference);
    CHECK(parse({"--environment", "sea.hdr"}).first.environment == "sea.hdr");
    for (const TransparencyTraits& t : all_transparencies)
        CHECK(parse({"--transparency", t.name}).first.choices.render.transparency == t.method);
}

TEST_CASE("what cannot be is refused with status 2", "[cpu]") {
    const std::vector<std::vector<const char*>> wrong{{"--size", "800"},
                                                      {"--size", "0x0", "--headless"},
                                                      {"--view", "depth"},
                                                      {"--tab", "none"},
                                                      {"--split", "1.5"},
                                                      {"--transparency", "magic"},
                                                      {"--frames", "0"},
                                                      {"--against", "nothing"},
                                                      {"--screenshot", "a.png"},
                                                      {"--environment", "sea.png"},
                                                      {"--backend", "direct"},
                                                      {"a.glb", "b.glb"},
                                                      {"--headless", "--screenshot", "a.bmp"}};
    for (const auto& arguments : wrong) {
        INFO(arguments[0] << " " << (arguments.size() > 1 ? arguments[1] : ""));
        CHECK(parse(arguments).second == 2);
    }
    CHECK(parse({"--help"}).second == 0);
    CHECK(parse({"--version"}).second == 0);
}

}  // namespace
}  // namespace pellucid::test
