// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How a picture is cut into bands, so that the fragments of each fit the memory there is.
#include <pellucid/core/result.hpp>
#include <pellucid/gpu/layer_count.h>
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// Strips [first, first + count) whose fragments are stored at the same time.
struct StripBand {
    std::uint32_t first = 0, count = 0;
    std::uint32_t slots = 0;  ///< places that their fragments take
    friend bool operator==(const StripBand&, const StripBand&) = default;
};

/// Cuts the strips into as few consecutive bands as take at most `capacity` places each; strips without fragments at
/// the ends of a band belong to none.  `place_bytes`: [byte] of one place, for the sentence. Error: `invalid_argument`
/// where one strip alone takes more, with the one that takes most.
[[nodiscard]] inline Result<std::vector<StripBand>> split_strips(std::span<const gpu::LayerStrip> strips,
                                                                 std::uint64_t capacity, std::uint64_t place_bytes) {
    std::vector<StripBand> bands;
    const auto deepest =
        std::max_element(strips.begin(), strips.end(), [](const auto& a, const auto& b) { return a.slots < b.slots; });
    if (deepest != strips.end() && deepest->slots > capacity) {
        const auto row = static_cast<std::uint64_t>(deepest - strips.begin()) * PELLUCID_LAYERS_TILE;
        return Error{Errc::invalid_argument,
                     "the translucent fragments of rows " + std::to_string(row) + " to " +
                         std::to_string(row + PELLUCID_LAYERS_TILE - 1) + " of the picture alone take " +
                         std::to_string(deepest->slots * place_bytes) + " bytes, and the memory budget has room for " +
                         std::to_string(capacity * place_bytes) + " bytes of fragments: raise it to at least that"};
    }
    for (std::uint32_t i = 0; i < strips.size(); ++i) {
        const std::uint64_t slots = strips[i].slots;
        if (slots == 0) continue;
        if (bands.empty() || bands.back().slots + slots > capacity) bands.push_back({.first = i});
        bands.back().count = i + 1 - bands.back().first;
        bands.back().slots += static_cast<std::uint32_t>(slots);
    }
    return bands;
}

}  // namespace pellucid::inline v0_1
