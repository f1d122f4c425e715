// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where the library says what it has to say: one plain function pointer, no global state, no formatting library.
#include <cstdint>
#include <cstdio>

namespace pellucid::inline v0_1 {

/// How much a message matters; an error is one after which results are not to be trusted.
enum class Severity : std::uint8_t { info, warning, error };

/// Receives messages of a device: driver and validation messages, fall-backs, cache misses.
/// Called on the thread that made the device's call; `text` is only valid during the call.
struct LogSink {
    void (*write)(void* user, Severity severity, const char* text) = nullptr;  ///< null: messages go to stderr
    void* user = nullptr;

    void operator()(Severity severity, const char* text) const {
        if (write) return write(user, severity, text);
        constexpr const char* names[] = {"info", "warning", "error"};
        std::fprintf(stderr, "pellucid %s: %s\n", names[static_cast<int>(severity)], text);
    }
};

}  // namespace pellucid::inline v0_1
