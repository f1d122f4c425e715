// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How wrong each form is, on the processor: rows of the table, without times.
#include <string>
#include "brdf/forms.hpp"
#include "support/error_sample.hpp"
#include "support/speed_error.hpp"

namespace pellucid::bench {

/// A row and the loop's term that tells its cost.
struct FormRow {
    SpeedErrorRow row;
    std::uint32_t term = 0;
    std::uint32_t inputs = 0;  ///< the term that only adds up the inputs of its group
    std::uint32_t exact = 0;   ///< the term that is ratio 1 in its group
    int table = -1;            ///< index into the tables; -1: reads none
};

/// A table of the directional albedo as a GPU may hold it.
struct TableForm {
    int size = 0;
    reference::DfgStorage storage = reference::DfgStorage::float16;
    DfgTable table;
    [[nodiscard]] std::string name() const {
        return std::to_string(size) + " x " + std::to_string(size) +
               (storage == reference::DfgStorage::float16 ? ", binary16" : ", float");
    }
    /// loss, shift and the two averages of the row: what one fetch gives.
    [[nodiscard]] std::uint64_t bytes() const {
        return std::uint64_t{storage == reference::DfgStorage::float16 ? 8u : 16u} * static_cast<unsigned>(size * size);
    }
};

[[nodiscard]] inline std::vector<TableForm> make_tables(bool quick) {
    std::vector<TableForm> out;
    for (const int size : {16, 32, 64, 128})
        for (const auto storage : {reference::DfgStorage::float16, reference::DfgStorage::float32})
            if (!quick || (size <= 32 && storage == reference::DfgStorage::float16))
                out.push_back({size, storage, DfgTable::make(size, storage)});
    return out;
}

namespace detail {

[[nodiscard]] inline SpeedErrorRow error_row(std::string scene, std::string method, std::string setting,
                                             const ErrorSample& e) {
    return {.scene = std::move(scene),
            .method = std::move(method),
            .setting = std::move(setting),
            .milliseconds = {},
            .rmse = e.rms(),
            .p999 = e.p999(),
            .max_error = e.max()};
}

/// A linear congruential generator (Numerical Recipes), upper 24 bits: [0,1).
struct Sequence {
    std::uint32_t state = 1;
    double next() {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8u) * 0x1p-24;
    }
    /// Uniform on the hemisphere around z.
    glm::dvec3 above() {
        const double z = next(), phi = 2 * std::numbers::pi * next(), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
};

}  // namespace detail

/// D in float for V + L as float adds them, V and L mirrored at half vectors within tan θ <= 2α of a random normal;
/// against double for the same stored V and L.
inline void add_distribution_rows(std::vector<FormRow>& out, bool quick) {
    struct Form {
        const char* name;
        float (*evaluate)(glm::vec3, glm::vec3, float);
        std::uint32_t term;
    };
    const Form forms[] = {{"Lagrange (ours)", d_lagrange<float>, BENCH_BRDF_D_LAGRANGE},
                          {"1 - NoH²", d_complement<float>, BENCH_BRDF_D_COMPLEMENT},
                          {"NoH²(a² - 1) + 1 (seed)", d_seed<float>, BENCH_BRDF_D_SEED}};
    for (const Form& form : forms)
        for (const double roughness : {1 / 255.0, 3 / 255.0, 0.02, 0.045, 0.1, 0.3}) {
            ErrorSample e;
            detail::Sequence random;
            const auto alpha = static_cast<float>(roughness * roughness);
            const int samples = quick ? 2000 : 50000;
            for (int i = 0; i < samples; ++i) {
                const glm::dvec3 n = random.above();
                const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
                const glm::dvec3 u = glm::normalize(glm::cross(n, other));
                const glm::dvec3 w = glm::cross(n, u);
                const auto tilted = [&](double tangent, double turn) {
                    return glm::normalize(n + (u * std::cos(turn) + w * std::sin(turn)) * tangent);
                };
                const glm::dvec3 h = tilted(2.0 * alpha * random.next(), 6.28 * random.next());
                const glm::dvec3 v = tilted(2.5 * random.next(), 6.28 * random.next());
                const glm::vec3 nf(n), vf(v), lf(2.0 * glm::dot(v, h) * h - v);
                const double exact = reference::ggx_distribution(glm::normalize(glm::dvec3(nf)),
                                                                 glm::dvec3(vf) + glm::dvec3(lf), double{alpha});
                e.add(form.evaluate(nf, vf + lf, alpha) / exact - 1);
            }
            SpeedErrorRow row = detail::error_row("D", form.name, "roughness " + significant(roughness, 2), e);
            row.more = {{"not finite [%]", 100.0 * static_cast<double>(e.nonfinite()) / samples}};
            out.push_back({std::move(row), form.term, BENCH_BRDF_D_INPUTS, BENCH_BRDF_D_LAGRANGE});
        }
}

/// V against the height-correlated form, cosines from 0.0125 to 0.9875.
inline void add_visibility_rows(std::vector<FormRow>& out) {
    struct Form {
        const char* name;
        double (*evaluate)(double, double, double);
        std::uint32_t term;
    };
    const Form forms[] = {
        {"height-correlated (ours)",
         [](double v, double l, double r) {
             return double{reference::smith_visibility(static_cast<float>(v), static_cast<float>(l),
                                                       static_cast<float>(r) * static_cast<float>(r))};
         },
         BENCH_BRDF_V_EXACT},
        {"Hammon's lerp", [](double v, double l, double r) { return v_hammon(v, l, r * r); }, BENCH_BRDF_V_HAMMON},
        {"uncorrelated Smith", [](double v, double l, double r) { return v_uncorrelated(v, l, r * r); },
         BENCH_BRDF_V_UNCORRELATED},
        {"Schlick, k = a/2", [](double v, double l, double r) { return v_schlick(v, l, 0.5 * r * r); },
         BENCH_BRDF_V_SCHLICK},
        {"Schlick, k = (r + 1)²/8 (seed)", [](double v, double l, double r) { return v_schlick(v, l, seed_k(r)); },
         BENCH_BRDF_V_SEED}};
    for (const Form& form : forms)
        for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0}) {
            ErrorSample e;
            for (int i = 0; i < 40; ++i)
                for (int j = 0; j < 40; ++j) {
                    const double v = (i + 0.5) / 40, l = (j + 0.5) / 40;
                    e.add(form.evaluate(v, l, roughness) / reference::smith_visibility(v, l, roughness * roughness) -
                          1);
                }
            out.push_back({detail::error_row("V", form.name, "roughness " + significant(roughness, 2), e), form.term,
                           BENCH_BRDF_V_INPUTS, BENCH_BRDF_V_EXACT});
        }
}

/// E for F0 0.04 and 1: rmse, p99.9 and max over a grid of the unit square; beside them the corner of smooth surfaces
/// at grazing views, 1e-3 <= roughness <= 0.1, 1e-6 <= μ <= 0.01.
inline void add_albedo_rows(std::vector<FormRow>& out, const std::vector<TableForm>& tables, bool quick) {
    struct Place {
        double mu, roughness;
        Dfg<double> exact;
    };
    const reference::GaussRule rule = reference::gauss_rule(24), eight = reference::gauss_rule(8);
    std::vector<Place> grid, corner;
    const int steps = quick ? 12 : 48;
    const auto place = [&](double mu, double r) { return Place{mu, r, integrate_dfg(mu, r * r, rule)}; };
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            grid.push_back(place((i + 0.5) / steps, (j + 0.5) / steps));
            corner.push_back(place(std::pow(10, -2 - 4.0 * i / (steps - 1)), std::pow(10, -1 - 2.0 * j / (steps - 1))));
        }
    const auto add = [&](const char* method, const std::string& setting, std::uint32_t term, int table, auto&& form) {
        ErrorSample all;
        double mean[2] = {}, worst[2] = {}, corner_worst = 0;
        for (const Place& p : grid)
            for (const int white : {0, 1}) {
                const double f0 = white ? 1 : 0.04;
                const double error = std::abs(form(p.mu, p.roughness).albedo(f0) - p.exact.albedo(f0));
                all.add(error);
                mean[white] += error / static_cast<double>(grid.size());
                worst[white] = std::max(worst[white], error);
            }
        for (const Place& p : corner)
            for (const double f0 : {0.04, 1.0})
                corner_worst =
                    std::max(corner_worst, std::abs(form(p.mu, p.roughness).albedo(f0) - p.exact.albedo(f0)));
        SpeedErrorRow row = detail::error_row("E", method, setting, all);
        row.more = {{"mean, F0 = 0.04", mean[0]},
                    {"max, F0 = 0.04", worst[0]},
                    {"mean, F0 = 1", mean[1]},
                    {"max, F0 = 1", worst[1]},
                    {"max in the corner", corner_worst}};
        if (table >= 0) row.bytes = tables[static_cast<std::size_t>(table)].bytes();
        out.push_back({std::move(row), term, BENCH_BRDF_E_INPUTS, BENCH_BRDF_E_QUADRATURE, table});
    };
    add("quadrature, 128 evaluations, float", "", BENCH_BRDF_E_QUADRATURE, -1, [&](double mu, double r) {
        const auto e = integrate_dfg(static_cast<float>(mu), static_cast<float>(r * r), eight);
        return Dfg<double>{e.loss, e.bias};
    });
    for (std::size_t t = 0; t < tables.size(); ++t)
        add("table (ours)", tables[t].name(), BENCH_BRDF_E_TABLE, static_cast<int>(t),
            [&](double mu, double r) { return tables[t].table.lookup(mu, r); });
    add("Karis 2014", "", BENCH_BRDF_E_KARIS, -1, e_karis);
    add("Lazarov 2013", "", BENCH_BRDF_E_LAZAROV, -1, e_lazarov);
    add("Narkowicz 2014", "", BENCH_BRDF_E_POLYNOMIAL, -1, e_polynomial);
    add("Zioma 2015", "", BENCH_BRDF_E_CUBE, -1, e_cube);
}

/// Deviation of a white furnace from 1, metal and dielectric together, over roughness 1/16 … 1 and cosines 0.05 … 1;
/// and the largest f(v,l)/f(l,v).  `conserving` reads the table with the most texels, in binary16.
inline void add_model_rows(std::vector<FormRow>& out, const std::vector<TableForm>& tables, bool quick) {
    struct Model {
        const char* name;
        reference::BrdfModel model;
        std::uint32_t term;
    };
    const Model models[] = {{"conserving", reference::BrdfModel::conserving, BENCH_BRDF_MODEL_CONSERVING},
                            {"gltf", reference::BrdfModel::gltf, BENCH_BRDF_MODEL_GLTF},
                            {"seed", reference::BrdfModel::seed, BENCH_BRDF_MODEL_SEED},
                            {"Blinn-Phong", reference::BrdfModel::blinn_phong, BENCH_BRDF_MODEL_BLINN_PHONG}};
    std::size_t best = 0;
    for (std::size_t t = 0; t < tables.size(); ++t)
        if (tables[t].storage == reference::DfgStorage::float16) best = t;
    const DfgTable& table = tables[best].table;
    for (const Model& m : models) {
        ErrorSample all;
        double low[2] = {1e9, 1e9}, high[2] = {};
        for (int r = 1; r <= 16; r += quick ? 5 : 1)
            for (const double mu : {0.05, 0.1, 0.3, 0.6, 1.0})
                for (const int metal : {0, 1}) {
                    const reference::Surface<double> surface{.metallic = double(metal), .roughness = r / 16.0};
                    const double albedo = white_furnace(m.model, surface, mu, table, quick ? 64 : 160).x;
                    all.add(albedo - 1);
                    low[metal] = std::min(low[metal], albedo);
                    high[metal] = std::max(high[metal], albedo);
                }
        detail::Sequence random;
        double worst = 1;
        for (int i = 0; i < (quick ? 2000 : 100000); ++i) {
            const glm::dvec3 v = random.above(), l = random.above();
            if (v.z < 1e-3 || l.z < 1e-3) continue;
            const reference::Surface<double> surface{
                .base_color = glm::dvec3(random.next()), .metallic = random.next(), .roughness = random.next()};
            const double there = evaluate_brdf(m.model, surface, v, l, table).total().x / l.z;
            const double back = evaluate_brdf(m.model, surface, l, v, table).total().x / v.z;
            worst = std::max({worst, there / back, back / there});
        }
        SpeedErrorRow row = detail::error_row("model", m.name, "", all);
        row.more = {{"metal, least", low[1]},
                    {"metal, most", high[1]},
                    {"dielectric, least", low[0]},
                    {"dielectric, most", high[0]},
                    {"f(v,l)/f(l,v) - 1, most", worst - 1}};
        const bool reads = m.model == reference::BrdfModel::conserving;
        if (reads) row.bytes = tables[best].bytes();
        out.push_back({std::move(row), m.term, BENCH_BRDF_MODEL_INPUTS, BENCH_BRDF_MODEL_GLTF,
                       reads ? static_cast<int>(best) : -1});
    }
}

[[nodiscard]] inline std::vector<FormRow> error_rows(const std::vector<TableForm>& tables, bool quick) {
    std::vector<FormRow> out;
    add_distribution_rows(out, quick);
    add_visibility_rows(out);
    add_albedo_rows(out, tables, quick);
    add_model_rows(out, tables, quick);
    return out;
}

}  // namespace pellucid::bench
