// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Counts heap allocations by operator new of the calling thread, for tests that promise none.
#include <cstdint>

namespace pellucid::test {

/// Calls of operator new by this thread since it began.
[[nodiscard]] std::uint64_t allocations() noexcept;

}  // namespace pellucid::test
