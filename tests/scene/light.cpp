// SPDX-License-Identifier: MIT
/// \file
/// What a light may be, and the sentence for what it may not.
#include <pellucid/scene/light.hpp>
#include <limits>
#include <vector>
#include "support/catch.hpp"

using namespace pellucid;

TEST_CASE("a light out of its documented ranges is named in one sentence", "[cpu]") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    CHECK(check_light({}, 0));
    CHECK(check_light({.range = infinity}, 0));
    CHECK(check_light({.kind = LightKind::spot, .inner_cone = 0.2, .outer_cone = 0.3}, 0));
    CHECK(check_light({.kind = LightKind::spot, .inner_cone = 0, .outer_cone = 0.5 * std::numbers::pi}, 0));
    CHECK(check_light({.kind = LightKind::point, .direction = {0, 0, 0}}, 0));  // has no meaning there
    const auto bad = [](const Light& light, const char* words) {
        const Result<void> result = check_light(light, 7);
        return !result && result.error().code == Errc::invalid_argument &&
               result.error().message.find("light 7 (\"" + light.name + "\"): ") == 0 &&
               result.error().message.find(words) != std::string::npos;
    };
    const auto spot = [](double inner, double outer) {
        return Light{.kind = LightKind::spot, .inner_cone = inner, .outer_cone = outer};
    };
    CHECK(bad(spot(0.4, 0.3), "its inner cone is 0.4, but must be at least 0 and below its outer cone, 0.3 rad"));
    CHECK(bad(spot(0.3, 0.3), "inner cone"));
    CHECK(bad(spot(-1e-9, 0.3), "inner cone is -1e-09"));
    CHECK(bad(spot(nan, 0.3), "inner cone"));
    CHECK(bad(spot(0, 1.9), "its outer cone is 1.9, but must be in (0, pi/2] rad"));
    CHECK(bad(spot(0, 0), "outer cone"));
    CHECK(bad(spot(0, nan), "outer cone"));
    CHECK(bad({.kind = LightKind::directional, .direction = {0, 0, -2}}, "the length of its direction is 2"));
    CHECK(bad({.kind = LightKind::directional, .direction = {0, 0, 0}}, "direction"));
    CHECK(bad({.kind = LightKind::spot, .direction = {0, nan, 0}}, "direction"));
    CHECK(bad({.intensity = -1, .name = "lamp"}, "its intensity is -1, but must be finite and at least 0"));
    CHECK(bad({.intensity = nan}, "intensity"));
    CHECK(bad({.intensity = infinity}, "intensity"));
    CHECK(bad({.color = {10, 1, 1}, .intensity = 1e38f},
              "its intensity times a component of its color is 9.99999968e+38"));
    CHECK(bad({.range = -1}, "its range is -1, but must be at least 0 m (0: unlimited)"));
    CHECK(bad({.range = nan}, "range"));
    CHECK(bad({.color = {1, -1, 1}}, "a component of its color is -1"));
    CHECK(bad({.color = {1, 1, nan}}, "color"));
    CHECK(bad({.position = {infinity, 0, 0}}, "a component of its position is inf"));
}

TEST_CASE("the first bad light of a list is the one that is named", "[cpu]") {
    std::vector<Light> lights(5);
    CHECK(check_lights({}));
    CHECK(check_lights(lights));
    lights[4].range = lights[2].range = -1;
    const Result<void> result = check_lights(lights);
    REQUIRE_FALSE(result);
    CHECK(result.error().message.find("light 2 ") == 0);
}
