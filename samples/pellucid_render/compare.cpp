// SPDX-License-Identifier: MIT
#include "compare.hpp"
#include <pellucid/measure/image_error.hpp>
#include <pellucid/measure/quality.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/scene/image_file.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

using namespace pellucid;

namespace {

/// The first three channels, by a function of each value.
template <class T, class F>
ImageF rgb(const Image<T>& image, F&& value) {
    ImageF out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) out.data[3 * i + c] = value(image.data[image.channels * i + c]);
    return out;
}
float signal(std::uint8_t code) {
    return static_cast<float>(code) * (1.0f / 255);
}
ImageF light(const ImageF& signals) {
    return rgb(signals,
               [](float v) { return static_cast<float>(reference::linear_from_srgb(static_cast<double>(v))); });
}

template <class T>
Result<void> check_size(const char* option, const std::string& file, const Image<T>& image, Extent2D size) {
    if (image.width == size.width && image.height == size.height) return {};
    const std::string theirs = std::to_string(image.width) + "x" + std::to_string(image.height);
    return Error{Errc::invalid_argument, std::string(option) + ": " + file + " is " + theirs +
                                             " pixels, and this picture is " + std::to_string(size.width) + "x" +
                                             std::to_string(size.height) + ": give --size " + theirs};
}

/// Every metric.  Errors and coverage are of the values as they are; what judges a picture as it is seen is given
/// light.
Result<measure::QualityReport> judge(const ImageF& test, const Target& target, measure::QualityOptions how) {
    using M = measure::QualityMetrics;
    if (!target.display) return measure::quality(test, target.picture, how);
    measure::QualityReport values, seen;
    how.metrics = M::errors | M::coverage;
    PELLUCID_TRY(values, measure::quality(test, target.picture, how));
    how.metrics = M::tone_mapped_psnr | M::ssim | M::ldr_flip;  // no HDR-FLIP: what was above 1 is gone
    PELLUCID_TRY(seen, measure::quality(light(test), light(target.picture), how));
    seen.absolute = values.absolute;
    seen.scaled = values.scaled;
    seen.layers = values.layers;
    seen.coverage = values.coverage;
    return seen;
}

}  // namespace

Result<std::optional<Target>> read_target(const Options& options) {
    if (options.compare.empty()) return std::optional<Target>();
    Target target{.name = options.compare};
    const Extent2D size = options.settings.size;
    if (!options.mask.empty()) {
        PELLUCID_TRY(target.mask, read_pgm(options.mask));
        PELLUCID_CHECK(check_size("--mask", options.mask, *target.mask, size));
        if (std::find(target.mask->data.begin(), target.mask->data.end(), 255) == target.mask->data.end())
            return Error{Errc::invalid_argument,
                         "--mask: " + options.mask + " has no pixel of 255, so none is compared"};
    }
    if (options.against_reference()) {
        target.name = "the reference";
        return std::optional(std::move(target));
    }
    if (options.compare.ends_with(".pfm")) {
        PELLUCID_TRY(const ImageF picture, read_pfm(options.compare));
        if (picture.channels != 3)
            return Error{Errc::invalid_argument,
                         "--compare: " + options.compare + " is grey, and this picture has colour"};
        target.picture = picture;
    } else {
        PELLUCID_TRY(const Image8 picture, read_image(options.compare));
        target.picture = rgb(picture, signal);
        target.display = true;
    }
    PELLUCID_CHECK(check_size("--compare", options.compare, target.picture, size));
    return std::optional(std::move(target));
}

Result<Comparison> compare(const Options& options, const Drawn& drawn, const Target& target) {
    const ImageF test = target.display ? rgb(drawn.display, signal) : rgb(drawn.linear, [](float v) { return v; });
    const Image8* const mask = target.mask ? &*target.mask : nullptr;
    measure::QualityReport report;
    PELLUCID_TRY(report, judge(test, target,
                               {.mask = mask, .test_layers = target.test_layers, .reference_layers = target.layers}));
    const measure::ImageError& error = *report.absolute;
    Comparison out{.rmse = error.rmse};
    // A pixel without a number, or no pixel at all, keeps no budget.
    if (options.error_budget)
        out.within_budget = error.values > 0 && error.nonfinite == 0 && error.nonfinite_reference == 0 &&
                            error.rmse <= *options.error_budget;
    out.text = "against " + target.name + (target.display ? " (display values): " : ": ") + measure::to_text(report);
    nlohmann::ordered_json json{{"with", options.compare}, {"values", target.display ? "display" : "linear"}};
    if (options.error_budget) {
        json["error_budget"] = *options.error_budget;
        json["within_budget"] = out.within_budget;
    }
    json.update(nlohmann::ordered_json::parse(measure::to_json(report)));
    out.json = json.dump();
    if (!options.heatmap.empty()) {
        ImageF errors;
        PELLUCID_TRY(errors, measure::error_picture(test, target.picture, {.mask = mask}));
        out.heat_map = measure::heat_map(errors);
    }
    return out;
}
