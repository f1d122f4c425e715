// SPDX-License-Identifier: MIT
#include "encodings/positions.hpp"
#include "encodings/errors.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::bench;

namespace {

ErrorSample errors_of(std::string_view name, double far_over_near, double offset) {
    for (const PositionEncoding& e : position_encodings)
        if (e.name == name) return position_errors_at(e, far_over_near, offset, 20000);
    FAIL("no encoding " << name);
    return {};
}
/// All of them finite, or the test fails.
double worst(std::string_view name, double far_over_near, double offset = 0) {
    const ErrorSample sample = errors_of(name, far_over_near, offset);
    CHECK(sample.nonfinite() == 0);
    return sample.max();
}

}  // namespace

TEST_CASE("ranges of depth are 0 and 1 where they should be", "[cpu]") {
    const Camera camera{.near = 0.25};
    const ClipFromView view = clip_from_view(camera, {640, 480});
    const auto depth = [&](DepthRange range, double z) {
        const reference::ClipCoefficients<double> clip(with_range(view, range, camera.near, 40));
        return reference::depth_from_view(clip, glm::dvec3(0, 0, -z));
    };
    CHECK(depth(DepthRange::standard, 0.25) == Approx(0).margin(1e-15));
    CHECK(depth(DepthRange::standard, 40) == Approx(1));
    CHECK(depth(DepthRange::reversed, 0.25) == Approx(1));
    CHECK(depth(DepthRange::reversed, 40) == Approx(0).margin(1e-15));
    CHECK(depth(DepthRange::infinite, 0.25) == Approx(1));
    CHECK(depth(DepthRange::infinite, 40) == Approx(0.25 / 40));
}

TEST_CASE("24 bits of depth: codes are kept, and halfway is within half a step", "[cpu]") {
    for (const double code : {0.0, 1.0, 8388607.0, 8388608.0, 16777214.0, 16777215.0})
        CHECK(through_depth24(static_cast<float>(code / 16777215)) == static_cast<float>(code / 16777215));
    CHECK(through_depth24(0x1p-27f) == 0);
    CHECK(through_depth24(-1) == 0);
    CHECK(through_depth24(2) == 1);
    EncodingRandom random(7);
    for (int i = 0; i < 10000; ++i) {
        const auto d = static_cast<float>(random.uniform());
        REQUIRE(std::abs(double{through_depth24(d)} - d) <= 0.5 / 16777215 + 0x1p-25);
    }
}

TEST_CASE("reversed float depth keeps 2.5e-7 whatever far/near is; the others lose with it", "[cpu]") {
    for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
        CAPTURE(ratio);
        CHECK(worst("D32F reversed, infinite", ratio) <= 2.5e-7);
        CHECK(worst("D32F reversed, finite", ratio) <= 3e-7);
        // At z a step of depth is z/near relative: half a step of 2^-24 stored, and for standard depth, which is near
        // 1 there, as much again or more for the float quotient and the difference that brings it back.
        const double half_step = ratio * 0x1p-25;
        CHECK(worst("D24 reversed", ratio) == Approx(half_step).epsilon(0.15));
        for (const char* name : {"D24 standard", "D32F standard"}) {
            CHECK(worst(name, ratio) >= 1.5 * half_step);
            CHECK(worst(name, ratio) <= 5 * half_step);
        }
    }
}

TEST_CASE("stored positions have the format's error, of the distance from the world's origin", "[cpu]") {
    const auto between = [](double value, double low, double high) { return value >= low && value <= high; };
    CHECK(between(worst("RGBA32F world", 1e4), 0.9 * 0x1p-24, 1.001 * 0x1p-24));
    CHECK(between(worst("RGBA16F world, nearest", 1e4), 0.9 * 0x1p-11, 1.001 * 0x1p-11));
    CHECK(between(worst("RGBA16F world, toward zero", 1e4), 0.9 * 0x1p-10, 1.001 * 0x1p-10));
    // 1e5 m away a coordinate has steps of 2^-7 m at most; the nearest points are 0.1 m away.
    CHECK(between(worst("RGBA32F world", 1e4, 1e5), 0.03, std::sqrt(3.0) * 0x1p-8 / 0.1));
    // Coordinates of 65520 m and more are no binary16.
    CHECK(errors_of("RGBA16F world, nearest", 1e6, 0).nonfinite() > 0);
    CHECK(errors_of("RGBA16F world, nearest", 1e4, 1e5).nonfinite() > 0);
    CHECK(worst("RGBA16F world, toward zero", 1e4, 1e5) > 1e5);
}

TEST_CASE("1e5 m from the origin only what stays relative to the eye keeps its digits", "[cpu]") {
    CHECK(worst("D32F reversed, infinite", 1e4, 1e5) <= 2.5e-7);
    CHECK(worst("D32F reversed, infinite; inverse matrix", 1e4, 1e5) >= 0.1);
    CHECK(worst("D32F reversed, infinite; camera added", 1e4, 1e5) >= 0.03);
    // Nothing is wrong with the matrix: at the origin it is as good as the rest.
    CHECK(worst("D32F reversed, infinite; inverse matrix", 1e4) <= 4e-7);
    CHECK(worst("D32F reversed, infinite; camera added", 1e4) <= 4e-7);
}
