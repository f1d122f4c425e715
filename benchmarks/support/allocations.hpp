// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Counts heap allocations: a program that calls this links allocations.cpp, which replaces the global operator new.
#include <cstdint>

namespace pellucid::bench {

/// Calls of any operator new on the calling thread since it started.  malloc, which drivers written in C use, is not
/// counted; what a driver written in C++ allocates on the calling thread is.
[[nodiscard]] std::uint64_t allocation_count() noexcept;

}  // namespace pellucid::bench
