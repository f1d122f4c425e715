// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where a number was measured: every result names the processor, the kernel, the driver, the compiler and the commit.
#include <sys/utsname.h>
#include <cstdlib>
#include <fstream>
#include <pellucid/rhi/desc.hpp>
#include <string>
#include <thread>
#include "support/json.hpp"

// What only the build knows; benchmarks/CMakeLists.txt passes both.
#if !defined(PELLUCID_BENCH_FLAGS)
#define PELLUCID_BENCH_FLAGS "unknown"
#endif
#if !defined(PELLUCID_BENCH_COMMIT)
#define PELLUCID_BENCH_COMMIT "unknown"
#endif

namespace pellucid::bench {

struct Machine {
    std::string cpu;       ///< model name as the kernel gives it
    unsigned threads = 0;  ///< hardware threads this process may use
    std::string kernel;
    std::string compiler;
    std::string flags;   ///< of the benchmark's own code
    std::string commit;  ///< of the sources; the environment's PELLUCID_COMMIT wins over what the build saw
};

[[nodiscard]] inline Machine describe_machine() {
    Machine out;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; out.cpu.empty() && std::getline(info, line);)
        if (line.starts_with("model name")) out.cpu = line.substr(line.find(':') + 2);
    if (out.cpu.empty()) out.cpu = "unknown";
    out.threads = std::thread::hardware_concurrency();
    utsname system{};
    if (uname(&system) == 0) out.kernel = std::string(system.sysname) + " " + system.release + " " + system.machine;
#if defined(__clang__)
    out.compiler = "Clang " __clang_version__;
#else
    out.compiler = "GCC " __VERSION__;
#endif
    out.flags = PELLUCID_BENCH_FLAGS;
    const char* commit = std::getenv("PELLUCID_COMMIT");
    out.commit = commit && *commit ? commit : PELLUCID_BENCH_COMMIT;
    return out;
}

/// Writes the machine as one JSON object, where a value is expected.
inline void write(JsonWriter& json, const Machine& machine) {
    json.begin_object();
    json.member("cpu", machine.cpu).member("threads", machine.threads).member("kernel", machine.kernel);
    json.member("compiler", machine.compiler).member("flags", machine.flags).member("commit", machine.commit);
    json.end_object();
}

/// Writes the device as one JSON object, where a value is expected.
inline void write(JsonWriter& json, const rhi::DeviceInfo& device) {
    json.begin_object();
    json.member("backend", device.backend).member("name", device.name).member("driver", device.driver);
    json.member("api", device.api).member("software", device.software);
    json.end_object();
}

/// The machine as lines of a Markdown list.
[[nodiscard]] inline std::string markdown(const Machine& machine) {
    return "- processor: " + machine.cpu + ", " + std::to_string(machine.threads) + " threads; " + machine.kernel +
           "\n- built by " + machine.compiler + " with `" + machine.flags + "` from commit " + machine.commit + "\n";
}

}  // namespace pellucid::bench
