// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What became of a graph's passes and textures, for the frame's statistics.
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1 {

/// Whether a pass of the graph ran.
struct PassReport {
    const char* name = "";
    bool ran = false;
    std::string reason;  ///< why it was left out; empty where it ran
};
/// What a texture of the graph takes.
struct TextureReport {
    const char* name = "";
    std::uint64_t bytes = 0;
    bool shared = false;  ///< uses the memory of an earlier texture
};

}  // namespace pellucid::inline v0_1
