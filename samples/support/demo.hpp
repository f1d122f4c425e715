// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the demonstrations share: options, the device's messages, the choice of the backend, the end of a program.
/// Exit statuses are those of pellucid-render (DESIGN.md).
#include "../pellucid_render/option_values.hpp"
#include "command_line.hpp"
#include "messages.hpp"
#include <pellucid/pellucid.hpp>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

namespace pellucid::samples {

struct DemoOptions {
    std::string backend = "auto";
    Extent2D size{1280, 720};
    bool headless = false;
    std::string out = "out";  ///< folder
    bool validate = false;
};

/// An option whose value `parse(text, value)` reads; it gives what is wrong with the text, or nothing.
template <class T, class Parse>
void add_parsed(CLI::App& app, const std::string& flag, T& value, Parse parse, const std::string& help) {
    app.add_option_function<std::string>(
        flag,
        [&value, parse, flag](const std::string& text) {
            if (const std::string wrong = parse(text, value); !wrong.empty()) throw CLI::ValidationError(flag, wrong);
        },
        help);
}

inline void add_demo_options(CLI::App& app, DemoOptions& o) {
    app.add_option("--backend", o.backend, "auto, vulkan or opengl")
        ->check(CLI::IsMember({"auto", "vulkan", "opengl"}));
    add_parsed(app, "--size", o.size, parse_size,
               "WIDTHxHEIGHT of pictures, or of the window at first (" + std::to_string(o.size.width) + "x" +
                   std::to_string(o.size.height) + ")");
    CLI::Option* headless = app.add_flag("--headless", o.headless, "write pictures, open no window");
    app.add_option("--out", o.out, "folder for the pictures; it is made where it is missing (out)")->needs(headless);
    app.add_flag("--validate", o.validate, "validation layer and GL debug output; any message fails the run");
}

/// Calls `run(std::type_identity<B>, DeviceDesc)`, which returns `Result<void>`, for the backend that was asked for.
/// \returns the exit status.
template <class Run>
int run_demo(const std::string& program, const DemoOptions& options, Run&& run) {
    Messages messages{.program = program.c_str()};
    const rhi::DeviceDesc desc{.validation = options.validate, .log = messages.sink()};
    const auto done = rhi::with_backend(Backends{}, options.backend,
                                        [&]<rhi::Backend B>(std::type_identity<B> tag) { return run(tag, desc); });
    const Error* error = !done ? &done.error() : !*done ? &done->error() : nullptr;
    if (error != nullptr) return fail(program, error->message, exit_status(error->code));
    if (options.validate && messages.errors != 0)
        return fail(program, std::to_string(messages.errors) + " validation messages", Exit::failed);
    return static_cast<int>(Exit::done);
}

/// Makes a folder for pictures.  Error: `io`.
[[nodiscard]] inline Result<void> make_folder(const std::string& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) return Error{Errc::io, "the folder '" + folder + "' cannot be made: " + failure.message()};
    return {};
}

}  // namespace pellucid::samples
