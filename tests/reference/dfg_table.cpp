// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/dfg_table.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;

namespace {

struct Place {
    double mu = 0, roughness = 0;
    Dfg<double> exact;
};

/// Between texel centres too, and towards the corner μ = r = 0, where E has no limit.
const std::vector<Place>& places() {
    static const std::vector<Place> all = [] {
        const GaussRule rule = gauss_rule(24);
        std::vector<double> roughnesses, roots = {0.0};
        for (int i = 0; i <= 60; ++i) {
            roots.push_back(i / 60.0);
            roots.push_back(std::pow(10.0, -i / 12.0));
        }
        for (int i = 0; i <= 40; ++i) {
            roughnesses.push_back(std::max(i / 40.0, 1e-3));
            roughnesses.push_back(std::pow(10.0, -4.0 * i / 40.0));
        }
        std::vector<Place> out;
        for (const double r : roughnesses)
            for (const double s : roots) out.push_back({s * s, r, integrate_dfg(s * s, r * r, rule)});
        return out;
    }();
    return all;
}

struct Errors {
    double everywhere = 0;
    double furnace = 0;  ///< μ >= 0.05
};

template <class T, class Lookup>
Errors errors(Lookup&& lookup) {
    Errors out;
    for (const Place& p : places()) {
        const Dfg<T> found = lookup(static_cast<T>(p.mu), static_cast<T>(p.roughness));
        for (const double f0 : {0.0, 0.04, 0.5, 1.0}) {
            const double e = std::abs(static_cast<double>(found.albedo(static_cast<T>(f0))) - p.exact.albedo(f0));
            out.everywhere = std::max(out.everywhere, e);
            if (p.mu >= 0.05) out.furnace = std::max(out.furnace, e);
        }
    }
    return out;
}

/// What a shader makes, and stores as binary16.
DfgTable shader_table(int size) {
    const GaussRule rule = gauss_rule(8);
    return DfgTable::make(size, DfgStorage::float16, [&](double mu, double alpha) {
        const Dfg<float> value = integrate_dfg(static_cast<float>(mu), static_cast<float>(alpha), rule);
        return Dfg<double>{value.loss, value.bias};
    });
}

}  // namespace

TEST_CASE("the coordinate spans [0,1] and has its inverse", "[cpu]") {
    for (const double r : {1e-3, 0.02, 0.3, 1.0}) {
        CHECK(dfg_coordinate(0.0, r) == 0);
        CHECK(dfg_coordinate(1.0, r) == Approx(1).epsilon(1e-15));
        for (const double mu : {1e-6, 1e-3, 0.2, 0.9})
            CHECK(dfg_cosine(dfg_coordinate(mu, r), r) == Approx(mu).epsilon(1e-10));
    }
    CHECK(dfg_coordinate(0.0, 0.0) == 0);
    CHECK(dfg_coordinate(0.5f, 0.0f) == 1);
}

TEST_CASE("bilinear lookups of binary16 values are right to 0.002, also in the corners", "[cpu]") {
    const auto of = [](const DfgTable& table) {
        return errors<double>([&](double mu, double r) { return table.lookup(mu, r); });
    };
    const Errors half128 = of(DfgTable::make(128, DfgStorage::float16));
    CHECK(half128.everywhere < 6e-4);
    CHECK(half128.furnace < 6e-4);
    CHECK(of(reference_dfg_table()).furnace < 1e-4);
    CHECK(of(DfgTable::make(64, DfgStorage::float16)).everywhere < 0.002);
    CHECK(of(DfgTable::make(32, DfgStorage::float16)).everywhere < 0.006);
    // As a shader makes it and reads it.
    CHECK(of(shader_table(128)).everywhere < 8e-4);
    const DfgTable made = shader_table(64);
    CHECK(errors<float>([&](float mu, float r) { return made.lookup(mu, r); }).everywhere < 0.002);
}

TEST_CASE("a table over the square root of the cosine misses the corner at any size", "[cpu]") {
    // loss and bias over (√μ, r), as the coordinates of most tables.
    for (const int size : {32, 128}) {
        const GaussRule rule = gauss_rule(16);
        std::vector<Dfg<double>> texels;
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                const double s = static_cast<double>(column) / (size - 1);
                const double r = std::max(static_cast<double>(row) / (size - 1), 1e-4);
                texels.push_back(integrate_dfg(s * s, r * r, rule));
            }
        const Errors found = errors<double>([&](double mu, double r) {
            const double x = std::sqrt(mu) * (size - 1), y = r * (size - 1);
            const int i = std::min(static_cast<int>(x), size - 2), j = std::min(static_cast<int>(y), size - 2);
            Dfg<double> out;
            for (int k = 0; k < 4; ++k) {
                const double w = (k & 1 ? x - i : 1 - x + i) * (k & 2 ? y - j : 1 - y + j);
                const auto& t = texels[static_cast<std::size_t>((j + k / 2) * size + i + k % 2)];
                out.loss += w * t.loss;
                out.bias += w * t.bias;
            }
            return out;
        });
        CHECK(found.everywhere > 0.1);
    }
}

TEST_CASE("the ends of a table", "[cpu]") {
    const DfgTable table = DfgTable::make(128, DfgStorage::float16);
    CHECK(table.lookup(1.0, 1.0).albedo(1.0) == Approx(1 - std::log(2.0)).margin(1e-3));
    CHECK(table.average(0.5).loss == Approx(1 - 0.882).margin(1e-3));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double mu : {-1.0, 0.0, 1.0, 2.0, nan})
        for (const double r : {-1.0, 0.0, 1.0, 2.0, nan}) {
            const Dfg<double> at = table.lookup(mu, r), average = table.average(r);
            const Dfg<float> in_float = table.lookup(static_cast<float>(mu), static_cast<float>(r));
            for (const double value : {at.loss, at.bias, at.scale(), average.loss, average.bias, average.scale(),
                                       static_cast<double>(in_float.loss), static_cast<double>(in_float.scale())}) {
                CHECK(value >= 0);
                CHECK(value <= 1);
            }
        }
    for (const DfgTexel& texel : table.texels()) REQUIRE((std::isfinite(texel.loss) && std::isfinite(texel.shift)));
    const DfgTable none;
    CHECK(none.lookup(0.3, 0.5).loss == 0);
    CHECK(none.lookup(0.3, 0.5).bias == Approx(std::pow(0.7, 5)).epsilon(1e-12));
    CHECK(none.average(0.5).bias == Approx(1 / 21.0).epsilon(1e-12));
}

TEST_CASE("a table's averages are those of its lookups, and near the exact ones", "[cpu]") {
    // What is stored is rounded toward zero twice, texels and average: by up to 2^-11 each where it is above a half.
    for (const DfgTable& table : {DfgTable::make(64), shader_table(64)})
        for (const double roughness : {1.0 / 63, 5.0 / 63, 21.0 / 63, 42.0 / 63, 1.0, 0.31, 0.77}) {
            Dfg<double> sum;
            const int steps = 20000;
            for (int i = 0; i < steps; ++i) {
                const double t = (i + 0.5) / steps, mu = t * t;
                const Dfg<double> at = table.lookup(mu, roughness);
                sum.loss += 4 * mu * t / steps * at.loss;
                sum.bias += 4 * mu * t / steps * at.bias;
            }
            const Dfg<double> average = table.average(roughness), exact = exact_dfg_average(roughness * roughness);
            CHECK(average.loss == Approx(sum.loss).epsilon(0.003).margin(1e-6));
            CHECK(average.bias == Approx(sum.bias).epsilon(0.003));
            CHECK(average.loss == Approx(exact.loss).margin(1e-3));
            CHECK(average.bias == Approx(exact.bias).margin(1e-3));
        }
}
