// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where in the picture there are pixels of so many layers.
#include <pellucid/core/image.hpp>
#include <pellucid/gpu/layer_count.h>
#include <pellucid/rhi/desc.hpp>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pellucid::inline v0_1 {

/// `[k]`: the smallest rectangle of whole tiles with all pixels that have more than k fragments; as many as the deepest
/// tile has.  A pixel has no more layers than fragments, so the k-th layer from the front, counted from 0, lies in
/// there.  `tile_depths`: LayerCountPass::tile_depths(), of a picture of `size` [pixel].
[[nodiscard]] inline std::vector<rhi::Rect> layer_areas(std::span<const std::uint32_t> tile_depths, Extent2D size) {
    constexpr std::uint32_t side = PELLUCID_LAYERS_TILE;
    struct Edges {
        std::uint32_t x0 = ~0u, y0 = ~0u, x1 = 0, y1 = 0;
        void include(const Edges& e) {
            *this = {std::min(x0, e.x0), std::min(y0, e.y0), std::max(x1, e.x1), std::max(y1, e.y1)};
        }
    };
    std::uint32_t deepest = 0;
    for (const std::uint32_t depth : tile_depths) deepest = std::max(deepest, depth);
    // First the tiles of exactly k + 1, then from the deepest on what is deeper.
    std::vector<Edges> edges(deepest);
    const std::uint32_t columns = (size.width + side - 1) / side;
    for (std::uint32_t i = 0; i < tile_depths.size(); ++i) {
        const std::uint32_t x = i % columns * side, y = i / columns * side;
        if (tile_depths[i] != 0)
            edges[tile_depths[i] - 1].include({x, y, std::min(x + side, size.width), std::min(y + side, size.height)});
    }
    for (std::uint32_t k = deepest; k-- > 1;) edges[k - 1].include(edges[k]);
    std::vector<rhi::Rect> areas;
    areas.reserve(deepest);
    for (const Edges& e : edges) areas.push_back({e.x0, e.y0, e.x1 - e.x0, e.y1 - e.y0});
    return areas;
}

}  // namespace pellucid::inline v0_1
