// SPDX-License-Identifier: MIT
/// \file
/// The sequence, the lobe and the levels that a prefiltering shader follows: their distributions, and how the error of
/// the sum falls with the number of samples.
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/cube_map.hpp>
#include <pellucid/reference/importance_sampling.hpp>
#include <pellucid/reference/sky.hpp>
#include <pellucid/scene/image_file.hpp>
#include <cstdio>
#include <set>
#include <vector>
#include "sampling.hpp"
#include "support/assets.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::Random;

namespace {
constexpr double pi = std::numbers::pi;

/// The share of GGX half vectors within `angle` of N, from the distribution itself.
double share_within(double angle, double alpha) {
    const auto density = [&](double theta) {
        const double d = ggx_distribution(glm::dvec3(0, 0, 1), {std::sin(theta), 0, std::cos(theta)}, alpha);
        return 2 * pi * d * std::cos(theta) * std::sin(theta);
    };
    return integrate(density, 0, std::min(alpha, angle)) + integrate(density, std::min(alpha, angle), angle);
}
}  // namespace

TEST_CASE("Hammersley: one point in each elementary box, the same bits in float", "[cpu]") {
    CHECK(hammersley<double>(0, 4) == glm::dvec2(0.125, 0));
    CHECK(hammersley<double>(1, 4) == glm::dvec2(0.375, 0.5));
    CHECK(hammersley<double>(2, 4) == glm::dvec2(0.625, 0.25));
    CHECK(hammersley<double>(3, 4) == glm::dvec2(0.875, 0.75));
    for (const std::uint32_t bits : {6u, 10u}) {
        const std::uint32_t n = 1u << bits;
        for (std::uint32_t across = 0; across <= bits; ++across) {
            std::set<std::pair<int, int>> boxes;
            for (std::uint32_t i = 0; i < n; ++i) {
                const glm::dvec2 u = hammersley<double>(i, n);
                boxes.emplace(static_cast<int>(u.x * (1u << across)), static_cast<int>(u.y * (1u << (bits - across))));
            }
            CHECK(boxes.size() == n);
        }
    }
    for (std::uint32_t i = 0; i < (1u << 24); i += 9973) {
        const glm::vec2 u = hammersley<float>(i, 1u << 24);
        CHECK(static_cast<double>(u.y) == hammersley<double>(i, 1u << 24).y);
        CHECK(u.y < 1.0f);
        CHECK(u.x <= 1.0f);
    }
}

TEST_CASE("GGX half vectors are distributed as D(H) N.H", "[cpu]") {
    for (const double alpha : {0.02, 0.3, 1.0}) {
        INFO("alpha " << alpha);
        // Bins of equal share in θ, from the distribution by bisection, and of equal angle around.
        constexpr int rings = 16, sectors = 8, samples = 1 << 16;
        std::vector<double> edges;
        for (int k = 1; k < rings; ++k) {
            double low = 0, high = pi / 2;
            for (int step = 0; step < 40; ++step) {
                const double middle = 0.5 * (low + high);
                (share_within(middle, alpha) < double(k) / rings ? low : high) = middle;
            }
            edges.push_back(low);
        }
        Random random(11);
        std::vector<int> counts(rings * sectors);
        glm::dvec3 mean(0.0);
        for (int i = 0; i < samples; ++i) {
            const glm::dvec3 h = sample_ggx(glm::dvec2(random.uniform(), random.uniform()), alpha);
            CHECK(glm::length(h) == Approx(1).epsilon(1e-12));
            const double theta = std::atan2(std::hypot(h.x, h.y), h.z), phi = std::atan2(h.y, h.x) + pi;
            const auto ring = std::upper_bound(edges.begin(), edges.end(), theta) - edges.begin();
            const int sector = std::min(static_cast<int>(phi / (2 * pi) * sectors), sectors - 1);
            ++counts[static_cast<std::size_t>(ring * sectors + sector)];
            mean += h / double(samples);
        }
        double chi2 = 0;
        const double expected = double(samples) / (rings * sectors);
        for (const int count : counts) chi2 += (count - expected) * (count - expected) / expected;
        CHECK(chi2 < 182);  // 127 degrees of freedom: 0.1 % of all seeds exceed it
        CHECK(chi2 > 81);   // and 0.1 % are below
        CHECK(std::abs(mean.x) < 0.01);
        CHECK(std::abs(mean.y) < 0.01);
    }
    // The ends: the axis itself, and never below the surface.
    CHECK(sample_ggx(glm::dvec2(0, 0.3), 0.5) == glm::dvec3(0, 0, 1));
    CHECK(sample_ggx(glm::vec2(1 - 0x1p-24f, 0.3f), 1.0f).z > 0);
}

TEST_CASE("float half vectors are those of double", "[cpu]") {
    for (const float alpha : {0.002f, 0.1f, 1.0f})
        for (std::uint32_t i = 0; i < 1024; ++i) {
            const glm::vec3 narrow = sample_ggx(hammersley<float>(i, 1024), alpha);
            const glm::dvec3 wide = sample_ggx(hammersley<double>(i, 1024), static_cast<double>(alpha));
            REQUIRE(glm::length(glm::dvec3(narrow) - wide) < 1e-6);
        }
}

TEST_CASE("the share above the horizon and the density of reflected rays", "[cpu]") {
    for (const double alpha : {0.05, 0.3, 0.7, 1.0}) {
        CHECK(ggx_share_above(alpha) == Approx(share_within(pi / 4, alpha)).epsilon(1e-9));
        // The last half vector that is used reflects N onto the horizon.
        const glm::dvec3 last = sample_ggx(glm::dvec2(ggx_share_above(alpha), 0.0), alpha);
        CHECK(last.z == Approx(std::sqrt(0.5)).epsilon(1e-12));
        const auto density = [&](double theta) {  // of L at `theta` from N
            const double sine = std::sin(0.5 * theta);
            return 2 * pi * std::sin(theta) * reflected_density(sine * sine, alpha);
        };
        CHECK(integrate(density, 0, alpha) + integrate(density, alpha, pi / 2) == Approx(1).epsilon(1e-9));
        const double sine = std::sin(0.3);
        const double d = ggx_distribution(glm::dvec3(0, 0, 1), {sine, 0, std::cos(0.3)}, alpha);
        CHECK(reflected_density(sine * sine, alpha) == Approx(d / 4 / ggx_share_above(alpha)).epsilon(1e-12));
    }
}

TEST_CASE("levels follow the solid angle of a sample", "[cpu]") {
    const double even = 1 / (4 * pi);  // the density of samples all over the sphere
    CHECK(filtered_lod(even, 100.0, 100.0, 0.0) == Approx(0).margin(1e-12));
    CHECK(filtered_lod(even, 100.0, 400.0, 0.0) == Approx(1));
    CHECK(filtered_lod(even, 100.0, 6400.0, 0.0) == Approx(3));
    CHECK(filtered_lod(even, 100.0, 6400.0, 0.5) == Approx(3.5));
    CHECK(filtered_lod(even * 16, 100.0, 6400.0, 0.0) == Approx(1));
    CHECK(filtered_lod(even, 100.0, 1.0, 1.0) == 0);  // never below level 0
    CHECK(filtered_lod(1e9f, 1024.0f, 6.0f * 256 * 256, 0.5f) == 0.0f);
}

TEST_CASE("the sum of samples converges on the sky", "[cpu]") {
    const Sky sky;
    const auto zonal = [&](double y) { return sky_radiance(sky, y); };
    const auto sphere = [&](auto d, auto) { return sky_radiance(sky, d.y); };
    Random random(21);
    std::vector<glm::dvec3> axes;
    for (int i = 0; i < 12; ++i) axes.push_back(random.direction());
    for (const double roughness : {0.25, 0.5, 1.0}) {
        const double alpha = roughness * roughness;
        std::printf("sky, roughness %.2f, unfiltered:", roughness);
        double previous = 1;
        for (const std::uint32_t samples : {16u, 64u, 256u, 1024u}) {
            double sum = 0, narrow_error = 0;
            for (const glm::dvec3 axis : axes) {
                const glm::dvec3 exact = zonal_prefiltered(zonal, axis.y, alpha);
                const glm::dvec3 error = prefilter_sampled(sphere, axis, alpha, samples, 1.0) / exact - 1.0;
                sum += glm::dot(error, error) / 3;
                const glm::vec3 narrow =
                    prefilter_sampled(sphere, glm::vec3(axis), static_cast<float>(alpha), samples, 1.0f);
                const glm::dvec3 lost =
                    glm::dvec3(narrow) / prefilter_sampled(sphere, glm::dvec3(glm::vec3(axis)), alpha, samples, 1.0) -
                    1.0;
                narrow_error = std::max({narrow_error, std::abs(lost.x), std::abs(lost.y), std::abs(lost.z)});
            }
            const double rms = std::sqrt(sum / static_cast<double>(axes.size()));
            std::printf("  %u: %.4f %%", samples, rms * 100);
            CHECK(rms < 0.6 * previous);
            CHECK(narrow_error < 1e-4);
            previous = rms;
        }
        std::printf("\n");
        CHECK(previous < 1e-3);
    }
    CHECK(glm::length(prefilter_sampled([](glm::dvec3, double) { return glm::dvec3(1, 2, 3); }, axes[0], 0.3, 7, 1.0) -
                      glm::dvec3(1, 2, 3)) < 1e-14);
    // Rays are unit and above the surface.
    for (const double alpha : {1e-4, 0.3, 1.0})
        (void)prefilter_sampled(
            [&](glm::dvec3 l, double lod) {
                CHECK(glm::length(l) == Approx(1).epsilon(1e-12));
                CHECK(glm::dot(l, axes[1]) > 0);
                CHECK(lod >= 0);
                return l;
            },
            axes[1], alpha, 64, 6.0 * 64 * 64);
}

TEST_CASE("a real picture with a sun: filtered samples against sums over texels", "[cpu]") {
    const auto folder = test::assets();
    if (!folder) return;
    const auto path = *folder / "env" / "spiaggia_di_mondello_1k.hdr";
    if (!std::filesystem::exists(path)) return test::skip(path.string() + " is not there", "PELLUCID_REQUIRE_ASSETS");
    const auto image = read_hdr(path.string());
    REQUIRE(image);
    const auto radiance = [&](glm::dvec3 d) { return environment_radiance(*image, d); };
    const CubeChain cube = make_cube_chain(radiance, 256);
    const auto chain = [&](glm::dvec3 l, double lod) { return sample_cube(cube, l, lod); };
    const auto alone = [&](glm::dvec3 l, double) { return sample_cube(cube, l); };
    Random random(31);
    std::vector<glm::dvec3> axes;
    for (int i = 0; i < 5; ++i) axes.push_back(random.direction());
    for (const double roughness : {0.5, 1.0}) {
        const double alpha = roughness * roughness;
        std::vector<glm::dvec3> exact;
        for (const glm::dvec3 axis : axes) exact.push_back(prefiltered_radiance(*image, axis, alpha));
        const auto rms = [&](auto&& f) {
            double sum = 0;
            for (std::size_t i = 0; i < axes.size(); ++i) {
                const glm::dvec3 error = f(axes[i]) / exact[i] - 1.0;
                sum += glm::dot(error, error) / 3;
            }
            return std::sqrt(sum / static_cast<double>(axes.size()));
        };
        double filtered = 0, first = 0;
        std::printf("sunlit picture, roughness %.2f, filtered (unfiltered):", roughness);
        for (const std::uint32_t samples : {64u, 256u, 1024u, 4096u}) {
            filtered = rms([&](glm::dvec3 a) { return prefilter_sampled(chain, a, alpha, samples, cube.texels()); });
            if (first == 0) first = filtered;
            std::printf("  %u: %.2f %%", samples, filtered * 100);
            std::printf(" (%.1f %%)", rms([&](glm::dvec3 a) {
                                          return prefilter_sampled(alone, a, alpha, samples, cube.texels());
                                      }) * 100);
        }
        CHECK(filtered < 0.3 * first);
        CHECK(filtered < 0.1);
        std::printf("\nsunlit picture, roughness %.2f, sums over texels:", roughness);
        for (const std::size_t level : {2u, 3u, 4u})
            std::printf("  %u a side: %.3f %%", 256u >> level,
                        rms([&](glm::dvec3 a) { return prefiltered_radiance(cube, level, a, alpha); }) * 100);
        std::printf("\n");
        CHECK(prefilter_level(cube, alpha) == 2);
        CHECK(rms([&](glm::dvec3 a) { return prefiltered_radiance(cube, 2, a, alpha); }) < 0.005);
    }
}
