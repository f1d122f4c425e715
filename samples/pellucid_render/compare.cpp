// SPDX-License-Identifier: MIT
#include "compare.hpp"
#include <pellucid/measure/heat_map.hpp>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/scene/image_file.hpp>
#include <algorithm>
#include <cstdio>

using namespace pellucid;

namespace {

template <class T>
ImageF rgb(const Image<T>& image, float scale) {
    ImageF out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            out.data[3 * i + c] = static_cast<float>(image.data[image.channels * i + c]) * scale;
    return out;
}

}  // namespace

Result<Comparison> compare(const Options& options, const ImageF& linear, const Image8& display) {
    ImageF test, reference;
    if (options.compare.ends_with(".pfm")) {
        PELLUCID_TRY(reference, read_pfm(options.compare));
        test = rgb(linear, 1);
    } else {
        Image8 picture;
        PELLUCID_TRY(picture, read_image(options.compare));
        reference = rgb(picture, 1.0f / 255);
        test = rgb(display, 1.0f / 255);
    }
    Image8 mask;
    if (!options.mask.empty()) {
        PELLUCID_TRY(mask, read_pgm(options.mask));
    }
    measure::ImageErrorOptions how{.mask = options.mask.empty() ? nullptr : &mask};
    measure::ImageError absolute, scaled;
    PELLUCID_TRY(absolute, measure::image_error(test, reference, how));
    how.scale = measure::ErrorScale::scaled;
    PELLUCID_TRY(scaled, measure::image_error(test, reference, how));
    char text[320];
    std::snprintf(text, sizeof text,
                  "RMSE %.3g, max %.3g, p99.9 %.3g; divided by max(1, reference): RMSE %.3g, p99.9 %.3g; %llu pixels, "
                  "%llu differ, %llu values not finite",
                  absolute.rmse, absolute.max, absolute.p999, scaled.rmse, scaled.p999,
                  static_cast<unsigned long long>(absolute.pixels),
                  static_cast<unsigned long long>(absolute.different_pixels),
                  static_cast<unsigned long long>(absolute.nonfinite));
    std::printf("against %s: %s\n", options.compare.c_str(), text);
    if (!options.heatmap.empty()) {
        ImageF errors;
        PELLUCID_TRY(errors, measure::error_picture(test, reference, how));
        const measure::HeatMap map = measure::heat_map(errors);
        PELLUCID_CHECK(write_png(options.heatmap, map.rgb));
        std::printf("heat map %s: log scale from %.3g to %.3g\n", options.heatmap.c_str(), map.low, map.high);
    }
    Comparison out{.rmse = absolute.rmse, .text = text};
    out.json = "{\"absolute\": " + measure::to_json(absolute) + ", \"scaled\": " + measure::to_json(scaled) + "}";
    return out;
}
