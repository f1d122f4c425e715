// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which layers are shown, as keys choose them.
#include <algorithm>
#include <cstdint>
#include <string>

namespace pellucid::samples {

/// Layers [first, end) of each pixel, nearest first; `end` 0: all there are.
struct LayerRange {
    std::uint32_t first = 0, end = 0;
    friend constexpr bool operator==(LayerRange, LayerRange) = default;
};

/// All layers, or layer `number` (1 is the nearest), alone or with those before it.
struct LayerChoice {
    static constexpr std::uint32_t most = 99;
    std::uint32_t number = 0;  ///< 0: all
    bool alone = true;

    void choose(std::uint32_t layer) { number = std::min(layer, most); }
    void next() { choose(number + 1); }
    void previous() { choose(number > 0 ? number - 1 : 0); }
    void toggle() { alone = !alone; }

    [[nodiscard]] LayerRange range() const { return {.first = alone && number > 0 ? number - 1 : 0, .end = number}; }
    [[nodiscard]] std::string text() const {
        if (number == 0) return "all layers";
        return alone         ? "layer " + std::to_string(number) + " alone"
               : number == 1 ? std::string("the first layer")
                             : "the first " + std::to_string(number) + " layers";
    }
};

}  // namespace pellucid::samples
