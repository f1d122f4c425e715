// SPDX-License-Identifier: MIT
// What including Pellucid costs: each public header alone, and the umbrella with no backend, with one, with both and
// with all passes, against an empty file, at -O0.
//
//     compile_time [--compiler PROGRAM] [--rounds N] [--headers] [--check] [--json FILE] [--markdown FILE]
//
// A time is the compiler's user time.  In every round each case is compiled once, right after the empty file and the
// yardstick (a fixed file of standard headers), headers alone eight at a time, and what is told is the median of the
// rounds' own differences and ratios: what else runs on the machine slows all of them.  --check asks whether the
// umbrella with one backend keeps its budget.  Exit status: 0 measured; 1 it does not compile, or --check and the
// budget is exceeded; 2 usage.
#include <span>
#include "compile_time/cases.hpp"
#include "compile_time/compiler.hpp"
#include "support/machine.hpp"
#include "support/markdown.hpp"
#include "support/options.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

/// DESIGN.md's budget for everything with one backend, beyond an empty file.
constexpr double budget_s = 1.5;
/// What the yardstick takes beyond an empty file with g++ 12.2 on the machine for which the budget holds, two cores of
/// an AMD EPYC, where nothing else runs and it is at its fastest.  Elsewhere, or while others compile, the
/// budget grows and shrinks with it.
constexpr double yardstick_s = 1.3;

/// One case in all rounds.
struct Row {
    CompileCase what;
    std::vector<double> beyond;  ///< [s] than the empty file
    std::vector<double> ratio;   ///< of that to the yardstick's
};

/// \param together so many rows share an empty file and a yardstick.
Result<void> measure(Compiler& compiler, std::span<Row> rows, std::uint32_t rounds, std::size_t together) {
    for (std::uint32_t round = 0; round < rounds; ++round) {
        double empty = 0, yard = 0, own = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            Row& row = rows[round % 2 ? rows.size() - 1 - i : i];
            if (i % together == 0) {
                PELLUCID_TRY(empty, compiler.seconds(""));
                PELLUCID_TRY(yard, compiler.seconds(yardstick));
            }
            PELLUCID_TRY(own, compiler.seconds(row.what.source, row.what.definitions));
            row.beyond.push_back(own - empty);
            row.ratio.push_back((own - empty) / (yard - empty));
        }
    }
    return {};
}

std::string report(const std::vector<Row>& rows, const std::string& compiler, const std::string& flags) {
    std::string out = "## What including Pellucid costs\n\n" + markdown(describe_machine());
    out += "- measured: " + compiler + ", `" + flags +
           "`\n- user time beyond an empty file, and its ratio to that of a " + "fixed file of standard headers; " +
           std::to_string(rows.front().ratio.size()) +
           " rounds, median [quartiles] of the rounds' own differences and ratios\n\n";
    MarkdownTable table({"included", "[s] beyond an empty file", "x yardstick"});
    for (const Row& row : rows)
        table.row({row.what.name, with_spread(summarise(row.beyond)), with_spread(summarise(row.ratio))});
    return out + table.text();
}

std::string json(const std::vector<Row>& rows, const std::string& compiler, const std::string& flags) {
    JsonWriter out;
    out.begin_object().member("benchmark", "compile_time").member("compiler", compiler).member("flags", flags);
    write(out.key("machine"), describe_machine());
    out.key("rows").begin_array();
    for (const Row& row : rows) {
        out.begin_object().member("included", row.what.name);
        out.member("seconds_beyond_empty", summarise(row.beyond)).member("ratio_to_yardstick", summarise(row.ratio));
        out.end_object();
    }
    out.end_array().member("yardstick", yardstick).end_object();
    return out.text();
}

/// Whether the umbrella with one backend keeps the budget, told in a line each.
bool keeps_budget(const std::vector<Row>& rows) {
    bool kept = true;
    for (const Row& row : rows) {
        if (!row.what.budgeted) continue;
        const double ratio = summarise(row.ratio).median, limit = budget_s / yardstick_s;
        std::printf("- %s: %s: %s times the yardstick, at most %s: %s s where the budget is %s s\n",
                    ratio <= limit ? "met" : "EXCEEDED", row.what.name.c_str(), significant(ratio).c_str(),
                    significant(limit).c_str(), significant(ratio * yardstick_s).c_str(),
                    significant(budget_s).c_str());
        kept = kept && ratio <= limit;
    }
    return kept;
}

Result<bool> run(const Options& options) {
    std::uint32_t rounds = 0;
    PELLUCID_TRY(rounds, options.number("rounds", 1, 1000));
    const std::string& program = options.text("compiler");
    const std::string flags = "-std=c++20 -O0 " PELLUCID_COMPILE_FLAGS;
    auto compiler = Compiler::create(program, flags);
    if (!compiler) return compiler.error();
    std::vector<Row> rows;
    const auto add = [&](const std::vector<CompileCase>& cases, std::size_t together) -> Result<void> {
        const std::size_t first = rows.size();
        for (const CompileCase& what : cases)
            if (!options.flag("check") || what.budgeted) rows.push_back({what, {}, {}});
        return measure(*compiler, std::span(rows).subspan(first), rounds, together);
    };
    PELLUCID_CHECK(add(umbrella_cases(), 1));
    if (options.flag("headers")) PELLUCID_CHECK(add(header_cases(words(PELLUCID_COMPILE_ROOTS)), 8));
    // A budget that seems exceeded gets two more chances, all rounds counted: what runs beside it makes a median of few
    // noisy.
    for (int again = 0; again < 2 && options.flag("check") && !keeps_budget(rows); ++again)
        PELLUCID_CHECK(measure(*compiler, rows, rounds, 1));
    // Without the folders of one machine, so that results of several may be compared.
    const std::string version = compiler_version(program), shown = "-std=c++20 -O0";
    const std::string text = report(rows, version, shown);
    std::printf("%s\n", text.c_str());
    if (!options.text("json").empty()) PELLUCID_CHECK(write_file(options.text("json"), json(rows, version, shown)));
    if (!options.text("markdown").empty()) PELLUCID_CHECK(write_file(options.text("markdown"), text));
    return keeps_budget(rows);
}

}  // namespace

int main(int argc, char** argv) {
    Options options({{"compiler", PELLUCID_COMPILE_COMPILER}, {"rounds", "5"}, {"json", ""}, {"markdown", ""}},
                    {"headers", "check"});
    if (const auto parsed = options.parse(argc, argv); !parsed)
        return std::fprintf(stderr, "%s\n", parsed.error().message.c_str()), 2;
    const auto done = run(options);
    if (!done) {
        std::fprintf(stderr, "%s\n", done.error().message.c_str());
        return done.error().code == Errc::invalid_argument ? 2 : 1;
    }
    return *done || !options.flag("check") ? 0 : 1;
}
