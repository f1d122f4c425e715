// SPDX-License-Identifier: MIT
#pragma once

namespace pellucid {

/// "major.minor.patch" of the compiled library that the program was linked with.
[[nodiscard]] const char* version() noexcept;

}  // namespace pellucid
