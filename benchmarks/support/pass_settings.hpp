// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What every benchmark of a pass may be asked on its command line.
#include <pellucid/rhi/desc.hpp>
#include "support/options.hpp"

namespace pellucid::bench {

struct PassSettings {
    Extent2D size = {};         ///< [pixel]
    std::uint32_t rounds = 0;   ///< timed, after `warm_up` that are not
    std::uint32_t warm_up = 5;  ///< rounds
    bool quick = false;         ///< a few cases only: does the program still run?
    bool software = false;      ///< the device is a processor, or has no timestamps
    bool timestamps = true;     ///< false: the clock is around record, submit and wait
    double bandwidth = 0;       ///< [byte/s] the floor's; 0: that of the device copy of the same run
    std::uint32_t repeats = 1;  ///< times that a short pass is recorded between two timestamps
    std::uint64_t copied = 0;   ///< [byte] size of the device copy
};

/// The common options: `--backend vulkan|opengl|both --device N|name --size WxH --rounds N --bandwidth TB/s
/// --clock auto|timestamps|wall --json FILE --svg FILE --quick`.
[[nodiscard]] inline Options pass_options() {
    return Options({{"backend", "both"},
                    {"device", ""},
                    {"size", "auto"},
                    {"rounds", "auto"},
                    {"bandwidth", "measured"},
                    {"clock", "auto"},
                    {"json", ""},
                    {"svg", ""}},
                   {"quick"});
}

/// `--size`, or `automatic`.  Errors: invalid_argument.
[[nodiscard]] inline Result<Extent2D> size_option(const Options& options, Extent2D automatic) {
    const std::string& text = options.text("size");
    if (text == "auto") return automatic;
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width < 8 || height < 8 || width > 16384 ||
        height > 16384)
        return Error{Errc::invalid_argument, "--size is '" + text + "' but must be WIDTHxHEIGHT, each from 8 to 16384"};
    return Extent2D{width, height};
}

/// Whether `--clock` means timestamps.  Automatic: where the device is no processor and has them.
/// Errors: invalid_argument.
[[nodiscard]] inline Result<bool> timestamps_option(const Options& options, const rhi::DeviceInfo& device) {
    const std::string& clock = options.text("clock");
    if (clock != "auto" && clock != "timestamps" && clock != "wall")
        return Error{Errc::invalid_argument, "--clock is '" + clock + "' but must be auto, timestamps or wall"};
    if (clock == "timestamps" && device.timestamp_ns == 0)
        return Error{Errc::invalid_argument, "--clock timestamps: " + device.name + " has none; use --clock wall"};
    return clock == "auto" ? !device.software && device.timestamp_ns != 0 : clock == "timestamps";
}

/// The settings for one device.  GPUs: 1920x1080, 31 rounds; software: 256x256, 5 rounds; quick: 64x64, 3 rounds.
/// Errors: invalid_argument.
[[nodiscard]] inline Result<PassSettings> pass_settings(const Options& options, const rhi::DeviceInfo& device) {
    PassSettings out;
    out.quick = options.flag("quick");
    out.software = device.software || device.timestamp_ns == 0;
    out.size = out.quick ? Extent2D{64, 64} : out.software ? Extent2D{256, 256} : Extent2D{1920, 1080};
    out.rounds = out.quick ? 3 : out.software ? 5 : 31;
    if (out.quick || out.software) out.warm_up = 1;
    out.repeats = out.software ? 1 : 4;
    out.copied = std::uint64_t{out.quick ? 1u : out.software ? 32u : 512u} << 20u;

    PELLUCID_TRY(out.size, size_option(options, out.size));
    if (options.text("rounds") != "auto") {
        PELLUCID_TRY(out.rounds, options.number("rounds", 1, 10000));
    }
    PELLUCID_TRY(out.timestamps, timestamps_option(options, device));
    if (const std::string& text = options.text("bandwidth"); text != "measured") {
        double terabytes = 0;
        char rest = 0;
        if (std::sscanf(text.c_str(), "%lf%c", &terabytes, &rest) != 1 || !(terabytes > 0) || terabytes > 1000)
            return Error{Errc::invalid_argument,
                         "--bandwidth is '" + text + "' but must be a number of TB/s above 0 and up to 1000"};
        out.bandwidth = terabytes * 1e12;
    }
    return out;
}

}  // namespace pellucid::bench
