// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What devices say, on stderr, and how much of it was a warning or an error.
#include <pellucid/core/log.hpp>
#include <cstdio>

namespace pellucid::samples {

struct Messages {
    const char* program = "";
    unsigned errors = 0;  ///< warnings too

    /// It must outlive the device.
    [[nodiscard]] LogSink sink() { return {&Messages::write, this}; }

private:
    static void write(void* user, Severity severity, const char* text) {
        auto& messages = *static_cast<Messages*>(user);
        if (severity != Severity::info) ++messages.errors;
        std::fprintf(stderr, "%s: device: %s\n", messages.program, text);
    }
};

}  // namespace pellucid::samples
