// SPDX-License-Identifier: MIT
#include "encodings/normals.hpp"
#include <limits>
#include "encodings/errors.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::bench;

namespace {

constexpr double degree = 180 / std::numbers::pi;
constexpr double float_slack = 2e-5;  // [degree] three units in the last place of float

/// The largest possible error [degree].
/// xyz: a component is off by at most `half`, the vector by √3 times that.
/// Octahedral, where it is worst, in the middle of a face: steps (a, b) of the square move the point on the face by
/// (a, b, −a−b), at 1/√3 from the centre: an angle of √(6 (a² + ab + b²)).  Rounding has |a|, |b| <= half: √18 half.
/// With that metric codes are a triangular lattice of side √6 · 2 half, and its covering radius is side/√3: √8 half.
double bound(const NormalEncoding& e) {
    const double steps = std::exp2(e.bits);
    switch (e.form) {
        case NormalForm::unorm_xyz:
            return std::sqrt(3.0) * (1 / (steps - 1)) * degree;
        case NormalForm::snorm_xyz:
            return std::sqrt(3.0) * (0.5 / (steps / 2 - 1)) * degree;
        case NormalForm::half_nearest:
            return std::sqrt(3.0) * 0x1p-12 * degree;
        case NormalForm::half_truncated:
            return std::sqrt(3.0) * 0x1p-11 * degree;
        case NormalForm::octahedral_snorm:
            return std::sqrt(e.precise ? 8.0 : 18.0) * (0.5 / (steps / 2 - 1)) * degree;
        case NormalForm::octahedral_unorm:
            break;
    }
    return std::sqrt(18.0) * (1 / (steps - 1)) * degree;
}

const NormalEncoding& named(std::string_view name) {
    for (const NormalEncoding& e : normal_encodings)
        if (e.name == name) return e;
    FAIL("no encoding " << name);
    return normal_encodings.front();
}

}  // namespace

TEST_CASE("every encoding of normals keeps its bound, and octahedral ones come close to it", "[cpu]") {
    for (const NormalEncoding& e : normal_encodings) {
        CAPTURE(e.name);
        EncodingRandom random(3);
        double worst = 0;
        for (int i = 0; i < 100000; ++i) worst = std::max(worst, normal_error(e, random.direction()));
        CHECK(worst <= bound(e) + float_slack);
        if (e.form == NormalForm::octahedral_snorm || e.form == NormalForm::octahedral_unorm)
            CHECK(worst >= 0.95 * bound(e));
        for (const glm::dvec3& d : fold_directions(100)) REQUIRE(normal_error(e, d) <= bound(e) + float_slack);
    }
}

TEST_CASE("mean and largest errors of normals are those of an independent emulation", "[cpu]") {
    // Another program's numbers (3·10^5 directions, emulated in float): mean, largest [degree].
    const struct {
        const char* name;
        double mean, max;
    } known[] = {
        {"RGB8 unorm", 0.170, 0.380},       {"RGB10A2 unorm", 0.0422, 0.0951}, {"RGBA16F, nearest", 0.00607, 0.0225},
        {"RGBA16 snorm", 0.00066, 0.00147}, {"oct16", 0.337, 0.940},           {"oct16 precise", 0.315, 0.633},
        {"oct20", 0.0837, 0.235},           {"oct20 precise", 0.0782, 0.157},  {"oct22", 0.0418, 0.117},
        {"oct22 precise", 0.0391, 0.0785},  {"oct24", 0.0209, 0.0586},         {"oct24 precise", 0.0195, 0.0393},
        {"oct24 unorm", 0.0209, 0.0589},    {"oct32", 0.00131, 0.00365},       {"oct32 precise", 0.00122, 0.00246}};
    for (const auto& k : known) {
        CAPTURE(k.name);
        EncodingRandom random(4);
        constexpr int count = 100000;
        double sum = 0, worst = 0;
        for (int i = 0; i < count; ++i) {
            const double error = normal_error(named(k.name), random.direction());
            sum += error;
            worst = std::max(worst, error);
        }
        CHECK(sum / count == Approx(k.mean).epsilon(0.01));
        CHECK(worst == Approx(k.max).epsilon(0.04));  // the largest of a sample is itself a matter of chance
    }
}

TEST_CASE("axes are exact where a code is 0; an unorm, which has none, tilts them", "[cpu]") {
    for (const NormalEncoding& e : normal_encodings)
        for (const glm::dvec3& axis : axis_directions()) {
            CAPTURE(e.name, axis.x, axis.y, axis.z);
            const double error = normal_error(e, axis);
            const double step = 1 / (std::exp2(e.bits) - 1);
            if (e.form == NormalForm::unorm_xyz)
                CHECK(error == Approx(std::atan(std::sqrt(2.0) * step) * degree).epsilon(1e-4));
            else if (e.form == NormalForm::octahedral_unorm)  // +z is the square's middle, −z its corners
                CHECK(error == Approx((axis.z > 0   ? std::sqrt(2.0)
                                       : axis.z < 0 ? 0.0
                                                    : 1.0) *
                                      step * degree)
                                   .epsilon(1e-2));
            else
                CHECK(error == 0);
        }
}

TEST_CASE("the sign of a zero changes no normal by more than the bound", "[cpu]") {
    for (const NormalEncoding& e : normal_encodings)
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(e.name, axis);
            glm::dvec3 d(0.6, -0.48, 0.64);
            d[axis] = 0;
            d = glm::normalize(d);
            glm::dvec3 other = d;
            other[axis] = -0.0;
            CHECK(normal_error(e, d) <= bound(e) + float_slack);
            CHECK(normal_error(e, other) <= bound(e) + float_slack);
        }
}

TEST_CASE("what has no direction becomes +z", "[cpu]") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const NormalEncoding& e : normal_encodings)
        for (const glm::vec3 v : {glm::vec3(0), glm::vec3(-0.0f), glm::vec3(nan, 0, 1), glm::vec3(0, 1, nan),
                                  glm::vec3(inf, 0, 0), glm::vec3(0, -inf, nan)}) {
            CAPTURE(e.name, v.x, v.y, v.z);
            CHECK(encode_normal(e, v) == encode_normal(e, {0, 0, 1}));
            CHECK(angle_between(glm::dvec3(decode_normal(e, encode_normal(e, v))), {0, 0, 1}) <= bound(e));
        }
}

TEST_CASE("precise rounding for any number of bits is the library's where that has it", "[cpu]") {
    EncodingRandom random(5);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 d(random.direction());
        const NormalCode code = detail::nearest_octahedral(d, 16);
        REQUIRE((std::uint32_t{code[0]} | std::uint32_t{code[1]} << 16u) == reference::oct32_from_direction(d));
    }
}

TEST_CASE("binary16 to nearest: every half is its own, halfway goes to even", "[cpu]") {
    for (std::uint32_t h = 0; h < 0x10000u; ++h) {
        const auto half = static_cast<std::uint16_t>(h);
        if ((h & 0x7FFFu) > 0x7C00u) continue;  // NaN
        REQUIRE(half_nearest(half_to_float(half)) == half);
        if ((h & 0x7FFFu) >= 0x7BFFu) continue;
        const float here = half_to_float(half), next = half_to_float(static_cast<std::uint16_t>(half + 1u));
        const float middle = 0.5f * (here + next);
        REQUIRE(half_nearest(middle) == (half % 2 == 0 ? half : half + 1));
        REQUIRE(half_nearest(std::nextafter(middle, here)) == half);
        REQUIRE(half_nearest(std::nextafter(middle, next)) == half + 1);
    }
    CHECK(half_nearest(65519.996f) == 0x7BFF);
    CHECK(half_nearest(65520.0f) == 0x7C00);
    CHECK(half_nearest(-1e30f) == 0xFC00);
    CHECK(half_nearest(std::numeric_limits<float>::infinity()) == 0x7C00);
    CHECK((half_nearest(std::numeric_limits<float>::quiet_NaN()) & 0x7FFF) > 0x7C00);
}
