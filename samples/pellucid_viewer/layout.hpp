// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where things are on the canvas: the panel on the left, the picture in the rest.
#include <pellucid/rhi/desc.hpp>
#include <algorithm>

namespace pellucid::samples::viewer {

inline constexpr std::uint32_t panel_width = 400;  ///< [pixel] at most; half of a narrow canvas

struct Layout {
    Extent2D canvas;
    std::uint32_t panel = 0;  ///< [pixel] its width
    rhi::Rect picture;        ///< empty where the canvas is

    [[nodiscard]] Extent2D picture_size() const { return {picture.width, picture.height}; }
    [[nodiscard]] bool over_picture(float x, float y) const {
        return x >= static_cast<float>(picture.x) && x < static_cast<float>(picture.x + picture.width) && y >= 0 &&
               y < static_cast<float>(picture.height);
    }
};

[[nodiscard]] inline Layout layout_of(Extent2D canvas, bool hide_ui) {
    Layout out{.canvas = canvas, .panel = hide_ui ? 0 : std::min(panel_width, canvas.width / 2)};
    out.picture = {out.panel, 0, canvas.width - out.panel, canvas.height};
    return out;
}

/// First column of the picture that is right of the split.
[[nodiscard]] inline std::uint32_t split_column(std::uint32_t width, float split) {
    return static_cast<std::uint32_t>(std::clamp(split, 0.0f, 1.0f) * static_cast<float>(width) + 0.5f);
}

}  // namespace pellucid::samples::viewer
