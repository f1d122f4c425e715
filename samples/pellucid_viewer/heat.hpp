// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Numbers of pixels as colours, with what the legend has to say.
#include <pellucid/measure/heat_map.hpp>
#include <pellucid/measure/image_error.hpp>
#include <string>

namespace pellucid::samples::viewer {

struct Legend {
    std::string what;  ///< "translucent fragments a pixel"
    measure::HeatScale scale = measure::HeatScale::linear;
    double low = 0, high = 0;  ///< of the darkest and the brightest colour
    double mean = 0;           ///< of all pixels that are finite
    [[nodiscard]] bool empty() const { return what.empty(); }
};

struct HeatPicture {
    Image8 display;  ///< [h, w, 4] sRGB codes
    Legend legend;
};

/// `[h, w, 1]` values from 0 as colours; 0 is black.
[[nodiscard]] inline HeatPicture heat_picture(const ImageF& values, std::string what, measure::HeatScale scale) {
    const measure::HeatMap map = measure::heat_map(values, {.scale = scale});
    HeatPicture out{.display = Image8(values.width, values.height, 4),
                    .legend = {.what = std::move(what), .scale = scale, .low = map.low, .high = map.high}};
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.data.size(); ++i) {
        std::copy_n(&map.rgb.data[3 * i], 3, &out.display.data[4 * i]);
        out.display.data[4 * i + 3] = 255;
        if (!std::isfinite(values.data[i])) continue;
        sum += static_cast<double>(values.data[i]);
        ++count;
    }
    out.legend.mean = count > 0 ? sum / count : 0;
    return out;
}
[[nodiscard]] inline HeatPicture heat_picture(const Image<std::uint32_t>& counts, std::string what) {
    ImageF values(counts.width, counts.height, 1);
    std::copy(counts.data.begin(), counts.data.end(), values.data.begin());
    return heat_picture(values, std::move(what), measure::HeatScale::linear);
}

}  // namespace pellucid::samples::viewer
