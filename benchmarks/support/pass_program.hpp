// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The main function of every benchmark of a pass.
#include <cstdio>
#include <memory>
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/vulkan/vulkan.hpp>
#include <type_traits>
#include <vector>
#include "support/copy_floor.hpp"
#include "support/speed_error.hpp"

namespace pellucid::bench {

/// "plot.svg" → "plot-vulkan.svg".
[[nodiscard]] inline std::string with_suffix(const std::string& file, const std::string& suffix) {
    const std::size_t dot = file.rfind('.');
    const bool has_extension = dot != std::string::npos && file.find('/', dot) == std::string::npos;
    return has_extension ? file.substr(0, dot) + "-" + suffix + file.substr(dot) : file + "-" + suffix;
}

/// `measure(std::type_identity<B>)` → Result<void> for each backend that `--backend` asks for.  One API's device must
/// be gone before the other's is made, so `measure` must not keep it: on some drivers destroying a Vulkan device breaks
/// OpenGL.  Where one API fails the other is still measured.  Errors: those of `measure`; invalid_argument.
template <class Measure>
[[nodiscard]] Result<void> on_each_backend(const Options& options, Measure measure) {
    const std::string& backend = options.text("backend");
    if (backend != "vulkan" && backend != "opengl" && backend != "both")
        return Error{Errc::invalid_argument, "--backend is '" + backend + "' but must be vulkan, opengl or both"};
    Result<void> status;
    const auto keep = [&](const Result<void>& done) {
        if (done || (!status && status.error().message == done.error().message)) return;
        const std::string before = status ? "" : status.error().message + "; ";
        status = Error{done.error().code, before + done.error().message};
    };
    if (backend != "opengl") keep(measure(std::type_identity<Vulkan>{}));
    if (backend != "vulkan") keep(measure(std::type_identity<OpenGL>{}));
    return status;
}

/// Prints the error, if there is one.
/// \returns the exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
[[nodiscard]] inline int exit_status(const char* stem, const Result<void>& done) {
    if (done) return 0;
    std::fprintf(stderr, "%s: %s\n", stem, done.error().message.c_str());
    return done.error().code == Errc::invalid_argument ? 2 : done.error().code == Errc::no_device ? 4 : 1;
}

/// Opens a device, measures, and fills what of the table is the same for every benchmark.
template <rhi::Backend B, class Measure>
[[nodiscard]] Result<SpeedErrorTable> measure_on(const Options& options, Measure& measure) {
    std::unique_ptr<rhi::DeviceFor<B>> device;
    PELLUCID_TRY(device, B::create({.device = options.text("device")}));
    const rhi::DeviceInfo info = device->info();
    PELLUCID_TRY(const PassSettings settings, pass_settings(options, info));
    PELLUCID_TRY(SpeedErrorTable table, measure(std::type_identity<B>{}, *device, settings));
    table.device = info;
    table.machine = describe_machine();
    table.size = settings.size;
    char text[200];
    std::snprintf(text, sizeof text, "time: %s; medians of %u rounds after %u to warm up",
                  settings.timestamps ? "GPU timestamps" : "the clock around record, submit and wait", settings.rounds,
                  settings.warm_up);
    table.notes.insert(table.notes.begin(), text);
    return table;
}

/// `measure(std::type_identity<B>, B::Device&, const PassSettings&)` → Result<SpeedErrorTable>, once for each backend
/// asked for.  Prints Markdown; writes JSON (an array of tables) and one SVG a backend.  Returns the exit status.
template <class Measure>
int run_pass_program(const char* stem, int argc, char** argv, Measure measure) {
    Options options = pass_options();
    const auto run = [&]() -> Result<void> {
        PELLUCID_CHECK(options.parse(argc, argv));
        std::vector<SpeedErrorTable> tables;
        const Result<void> status = on_each_backend(options, [&]<class B>(std::type_identity<B>) -> Result<void> {
            PELLUCID_TRY(SpeedErrorTable table, measure_on<B>(options, measure));
            std::printf("%s\n", to_markdown(table).c_str());
            std::fflush(stdout);
            tables.push_back(std::move(table));
            return {};
        });
        if (const std::string& file = options.text("json"); !file.empty() && !tables.empty()) {
            JsonWriter json;
            json.begin_array();
            for (const SpeedErrorTable& table : tables) write(json, table);
            json.end_array();
            PELLUCID_CHECK(write_file(file, json.text()));
        }
        if (const std::string& file = options.text("svg"); !file.empty())
            for (const SpeedErrorTable& table : tables)
                PELLUCID_CHECK(write_file(with_suffix(file, table.device.backend), to_svg(table)));
        return status;
    };
    return exit_status(stem, run());
}

/// [µs] for 10^6 pixels.
[[nodiscard]] inline double microseconds_per_megapixel(double milliseconds, Extent2D size) {
    return milliseconds * 1e3 / (static_cast<double>(size.width) * size.height * 1e-6);
}

}  // namespace pellucid::bench
