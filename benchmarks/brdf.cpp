// SPDX-License-Identifier: MIT
// What each form of the reflection models' terms saves, and what it costs in error: D, V, the directional albedo E of
// the specular lobe, and whole models.  Errors are found on the processor, with or without a device; a loop in a
// compute shader tells the time of an evaluation, after its sums were compared with those in double.
//
//     brdf [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N] [--clock auto|timestamps|wall]
//          [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device: errors alone were written.
#include <map>
#include "brdf/term_loop.hpp"
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

constexpr const char* error_kinds =
    "D: relative, half vectors within tan 2a; V: relative; E: absolute, F0 0.04 and 1, over (cosine, roughness); "
    "model: a white furnace less 1";

/// How many times fewer evaluations of a term are made, so that all take about as long.
std::uint32_t weight(std::uint32_t term) {
    return term == BENCH_BRDF_E_QUADRATURE ? 16 : 1;
}

SpeedErrorTable table_of(const std::vector<FormRow>& rows) {
    SpeedErrorTable out{.stem = "brdf", .baseline = "exact", .error = error_kinds};
    for (const FormRow& form : rows) out.rows.push_back(form.row);
    return out;
}

struct Measure {
    const std::vector<TableForm>& tables;
    const std::vector<FormRow>& rows;

    template <rhi::Backend B>
    Result<SpeedErrorTable> operator()(std::type_identity<B>, rhi::DeviceFor<B>& device,
                                       const PassSettings& settings) const {
        PELLUCID_TRY(const auto targets, TermTargets<B>::create(device, settings.size, tables));
        const std::uint32_t count = settings.quick ? 16 : settings.software ? 64 : 256;

        // A loop for each term and table; rows that differ in their error alone share one.
        std::vector<TermLoop<B>> loops;
        std::map<std::pair<std::uint32_t, int>, std::size_t> index;
        const auto add = [&](std::uint32_t term, int table) -> Result<void> {
            if (index.contains({term, table})) return {};
            const auto at = static_cast<std::size_t>(std::max(table, 0));
            PELLUCID_TRY(auto loop, TermLoop<B>::create(device, targets, tables, at, term, count / weight(term)));
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                return loop.record(cmd), Result<void>{};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const rhi::Texels sums, rhi::download<B>(device, targets.sums, targets.sums_desc));
            const ErrorSample e = loop.errors(sums, tables[at].table, settings.quick ? 30 : 200);
            // Samplers blend with weights of 8 bits.
            const double limit = table >= 0 ? 2e-3 : 2e-4;
            if (!e.within(limit))
                return Error{Errc::internal, "term " + std::to_string(term) +
                                                 " of shaders/bench_brdf: a sum is off by " + significant(e.max()) +
                                                 " of itself, and " + std::to_string(e.nonfinite()) +
                                                 " are not finite; the limit is " + significant(limit) + ": not timed"};
            index[{term, table}] = loops.size();
            loops.push_back(std::move(loop));
            return {};
        };
        for (const FormRow& form : rows) {
            PELLUCID_CHECK(add(form.inputs, -1));
            PELLUCID_CHECK(add(form.exact, -1));
            PELLUCID_CHECK(add(form.term, form.table));
        }
        std::vector<Work<B>> works;
        for (const TermLoop<B>& loop : loops)
            works.push_back({.name = "term " + std::to_string(loop.term),
                             .record = [&loop](rhi::CommandsFor<B>& cmd) { loop.record(cmd); },
                             .repeats = settings.repeats});
        const auto begin = [](rhi::CommandsFor<B>&) { return Result<void>{}; };
        PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));

        // [ns] an evaluation without its inputs, from the fastest rounds: what else a machine does only adds time.
        const auto own = [&](std::uint32_t term, int table, std::uint32_t inputs) {
            const auto per_evaluation = [&](std::size_t loop) {
                return summarise(times[loop]).lowest * 1e6 / loops[loop].evaluations();
            };
            return per_evaluation(index.at({term, table})) - per_evaluation(index.at({inputs, -1}));
        };
        SpeedErrorTable out = table_of(rows);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const FormRow& form = rows[i];
            const double ns = own(form.term, form.table, form.inputs);
            const double exact = own(form.exact, -1, form.inputs);
            out.rows[i].milliseconds = summarise(times[index.at({form.term, form.table})]);
            out.rows[i].ratio = exact > 0 && ns > 0 ? ns / exact : 0;
            out.rows[i].more.insert(out.rows[i].more.begin(), {"ns/evaluation", ns});
        }
        char text[256];
        std::snprintf(
            text, sizeof text,
            "ns/evaluation: the whole device's, of %u evaluations at each of the pixels (quadrature: %u), less "
            "that of the same loop adding up its inputs; from the fastest rounds; x exact: their ratio",
            count, count / weight(BENCH_BRDF_E_QUADRATURE));
        out.notes = {text, "exact is Lagrange's D, height-correlated V, the quadrature of E, and the glTF model"};
        if (settings.software) out.notes.push_back("a software device: only ratios mean anything");
        return out;
    }
};

/// A table for each group, because their errors are of different kinds; what is said about all of them once.
std::string markdown_by_group(const SpeedErrorTable& table) {
    std::string out;
    for (const char* scene : {"D", "V", "E", "model"}) {
        SpeedErrorTable group = table;
        std::erase_if(group.rows, [&](const SpeedErrorRow& row) { return row.scene != scene; });
        const std::string text = to_markdown(group);
        out += out.empty() ? text : text.substr(text.find("\n\n|") + 1);
    }
    return out;
}

/// One panel a group: own time against the largest error, methods' settings joined.
PlotSheet sheet_of(const SpeedErrorTable& table) {
    PlotSheet sheet{.title = "Reflection models: what an evaluation takes, and how wrong it is",
                    .subtitle = table.device.name + ", " + table.device.backend + "; lower left is better",
                    .panels = {},
                    .columns = 2};
    const std::map<std::string, const char*> units = {{"D", "largest relative error, roughness 0.045"},
                                                      {"V", "largest relative error, roughness 0.5"},
                                                      {"E", "largest error"},
                                                      {"model", "white furnace, largest deviation"}};
    for (const auto& [scene, unit] : units) {
        Plot panel{.title = scene, .x_label = "own time [ns]", .y_label = unit, .series = {}};
        for (const SpeedErrorRow& row : table.rows) {
            if (row.scene != scene || row.more.empty() || row.more.front().name != "ns/evaluation") continue;
            if (scene == "D" && row.setting != "roughness " + significant(0.045, 2)) continue;
            if (scene == "V" && row.setting != "roughness " + significant(0.5, 2)) continue;
            const bool sized = scene == "E" && !row.setting.empty();
            panel.series.push_back({.name = sized ? row.setting : row.method,
                                    .points = {{std::max(row.more.front().value, 1e-4), row.max_error, ""}}});
        }
        sheet.panels.push_back(std::move(panel));
    }
    return sheet;
}

Result<void> write_tables(const std::string& file, const std::vector<SpeedErrorTable>& tables) {
    if (file.empty()) return {};
    JsonWriter json;
    json.begin_array();
    for (const SpeedErrorTable& table : tables) write(json, table);
    json.end_array();
    return write_file(file, json.text());
}

Result<void> run(int argc, char** argv) {
    Options options = pass_options();
    PELLUCID_CHECK(options.parse(argc, argv));
    const bool quick = options.flag("quick");
    const std::vector<TableForm> albedo_tables = make_tables(quick);
    const std::vector<FormRow> rows = error_rows(albedo_tables, quick);
    Measure measure{albedo_tables, rows};
    std::vector<SpeedErrorTable> measured;
    const Result<void> status = on_each_backend(options, [&]<class B>(std::type_identity<B>) -> Result<void> {
        PELLUCID_TRY(SpeedErrorTable table, measure_on<B>(options, measure));
        std::printf("%s\n", markdown_by_group(table).c_str());
        std::fflush(stdout);
        measured.push_back(std::move(table));
        return {};
    });
    if (measured.empty()) {
        SpeedErrorTable errors = table_of(rows);
        errors.machine = describe_machine();
        errors.notes = {"no device was measured: errors alone"};
        std::printf("%s\n", markdown_by_group(errors).c_str());
        measured.push_back(std::move(errors));
    }
    PELLUCID_CHECK(write_tables(options.text("json"), measured));
    if (const std::string& file = options.text("svg"); !file.empty())
        for (const SpeedErrorTable& table : measured)
            if (!table.device.backend.empty())
                PELLUCID_CHECK(write_file(with_suffix(file, table.device.backend), to_svg(sheet_of(table))));
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    return exit_status("brdf", run(argc, argv));
}
