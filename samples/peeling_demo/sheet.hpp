// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Many pictures in one.
#include <pellucid/core/image.hpp>
#include <algorithm>
#include <span>

namespace pellucid::samples {

/// Pictures of one size and four channels in rows of `columns`, `gap` grey texels apart and around; what is left of the
/// last row is grey, too.
[[nodiscard]] inline Image8 contact_sheet(std::span<const Image8> pictures, std::uint32_t columns,
                                          std::uint32_t gap = 8) {
    if (pictures.empty() || columns == 0) return {};
    const std::uint32_t width = pictures[0].width, height = pictures[0].height;
    const std::uint32_t rows = (static_cast<std::uint32_t>(pictures.size()) + columns - 1) / columns;
    Image8 sheet(columns * (width + gap) + gap, rows * (height + gap) + gap, 4);
    for (std::size_t i = 0; i < sheet.data.size(); ++i) sheet.data[i] = i % 4 == 3 ? 255 : 96;
    for (std::uint32_t i = 0; i < pictures.size(); ++i)
        for (std::uint32_t y = 0; y < height; ++y)
            std::copy_n(pictures[i].texel(0, y), std::size_t{4} * width,
                        sheet.texel(gap + i % columns * (width + gap), gap + i / columns * (height + gap) + y));
    return sheet;
}

}  // namespace pellucid::samples
