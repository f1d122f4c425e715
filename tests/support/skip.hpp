// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Tests that need something the machine lacks say so in one sentence and end, or fail where it must be there.
#include <cstdio>
#include <cstdlib>
#include <string>
#include "support/catch.hpp"

namespace pellucid::test {

/// Prints why a test does not run.  Where the environment variable `must` is "1" the test fails instead, so that a
/// machine meant to run everything cannot pass by running nothing.
inline void skip(const std::string& why, const char* must) {
    const char* value = std::getenv(must);
    if (value && std::string(value) == "1") FAIL(why << " (" << must << "=1)");
    std::printf("skipped: %s\n", why.c_str());
}

}  // namespace pellucid::test
