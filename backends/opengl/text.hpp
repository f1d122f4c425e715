// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Sentences for errors: printf into a std::string.
#include <pellucid/core/result.hpp>
#include <string>

namespace pellucid::inline v0_1::opengl {

/// `printf` into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace pellucid::inline v0_1::opengl
