// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exit statuses of the programs: DESIGN.md has the contract.
#include <pellucid/core/result.hpp>

namespace pellucid::samples {

/// `failed`: a driver, the validation layer or this program is at fault.
enum class Exit : int { done = 0, failed = 1, usage = 2, input = 3, no_device = 4, device = 5, error_budget = 6 };

/// The exit status of a run that ended with this error.
[[nodiscard]] inline Exit exit_status(Errc error) {
    switch (error) {
        case Errc::invalid_argument:
            return Exit::usage;
        case Errc::no_device:
        case Errc::unsupported:
            return Exit::no_device;
        case Errc::device_lost:
        case Errc::out_of_memory:
            return Exit::device;
        case Errc::internal:
            return Exit::failed;
        default:
            return Exit::input;
    }
}

}  // namespace pellucid::samples
