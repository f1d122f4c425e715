// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Triangles sorted into screen tiles.
#include <oneapi/tbb/parallel_for.h>
#include <cstddef>
#include <cstdint>
#include <pellucid/reference/detail/draws.hpp>
#include <span>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1::reference::detail {

inline constexpr std::int32_t tile_side = 32;  // [pixel]

/// The pixels that each triangle may cover: empty where it is culled or not in the picture.
inline std::vector<PixelRect> find_bounds(const Prepared& prepared) {
    const double margin = prepared.options->stability ? 1.0 / sample_steps : 0.0;
    std::vector<PixelRect> bounds(prepared.primitives);
    oneapi::tbb::parallel_for(std::size_t{0}, prepared.draws.size(), [&](std::size_t d) {
        const Draw& draw = prepared.draws[d];
        const bool both_sides = draw.material->factors.double_sided;
        oneapi::tbb::parallel_for(draw.first_primitive, draw.end_primitive, [&](std::uint32_t primitive) {
            const RasterTriangle triangle = prepared.triangle(draw, primitive);
            if (triangle.facing() != 0 && (both_sides || draw.front(triangle)))
                bounds[primitive] = triangle.bounds(prepared.options->size, margin);
        });
    });
    return bounds;
}

/// For each tile, in rows, the triangles that may cover any of its pixels, in draw order.
struct Tiles {
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::size_t> ends;
    std::vector<std::uint32_t> primitives;

    [[nodiscard]] std::size_t count() const noexcept { return std::size_t{columns} * rows; }
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t tile) const noexcept {
        const std::size_t begin = tile == 0 ? 0 : ends[tile - 1];
        return {primitives.data() + begin, ends[tile] - begin};
    }
    [[nodiscard]] PixelRect rect(std::size_t tile, Extent2D size) const noexcept {
        const auto x = static_cast<std::int32_t>(tile % columns) * tile_side;
        const auto y = static_cast<std::int32_t>(tile / columns) * tile_side;
        return intersection({x, y, x + tile_side, y + tile_side},
                            {0, 0, static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height)});
    }
};

inline Tiles make_tiles(const Prepared& prepared) {
    const std::vector<PixelRect> bounds = find_bounds(prepared);
    const Extent2D size = prepared.options->size;
    Tiles tiles;
    tiles.columns = (size.width + tile_side - 1) / tile_side;
    tiles.rows = (size.height + tile_side - 1) / tile_side;
    const auto for_each_entry = [&](auto&& visit) {
        for (std::uint32_t p = 0; p < bounds.size(); ++p) {
            const PixelRect& b = bounds[p];
            if (b.empty()) continue;
            for (std::int32_t y = b.top / tile_side; y <= (b.bottom - 1) / tile_side; ++y)
                for (std::int32_t x = b.left / tile_side; x <= (b.right - 1) / tile_side; ++x)
                    visit(static_cast<std::size_t>(y) * tiles.columns + static_cast<std::size_t>(x), p);
        }
    };
    std::vector<std::size_t> next(tiles.count(), 0);
    for_each_entry([&](std::size_t tile, std::uint32_t) { ++next[tile]; });
    std::size_t total = 0;
    for (std::size_t& n : next) n = std::exchange(total, total + n);
    tiles.primitives.resize(total);
    for_each_entry([&](std::size_t tile, std::uint32_t p) { tiles.primitives[next[tile]++] = p; });
    tiles.ends = std::move(next);
    return tiles;
}

}  // namespace pellucid::inline v0_1::reference::detail
