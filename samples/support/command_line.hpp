// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How every program ends that cannot do what its command line says.
#include "exit_status.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <string>

namespace pellucid::samples {

/// Says what is wrong, after the program's name.  \returns the exit status.
inline int fail(const std::string& program, const std::string& what, Exit status) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), what.c_str());
    return static_cast<int>(status);
}

/// Parses the command line.  An exit status where the program is done already (--help, bad usage).
[[nodiscard]] inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        return fail(app.get_name(), std::string(e.what()) + " (--help lists the options)", Exit::usage);
    }
    return std::nullopt;
}

}  // namespace pellucid::samples
