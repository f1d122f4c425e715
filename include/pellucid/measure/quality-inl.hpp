// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of quality.hpp.
#include <pellucid/measure/quality.hpp>
#include <pellucid/measure/detail/flip_pictures.hpp>
#include <cstdarg>
#include <cstdio>

namespace pellucid::inline v0_1::measure {
namespace detail {

/// A string as JSON.
[[nodiscard]] inline std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

template <class T>
void add_metric(JsonObject& object, const char* key, const std::optional<T>& metric) {
    using measure::to_json;
    object.raw(key, metric ? to_json(*metric) : "null");
}

/// printf into a string; all texts here are short.
[[nodiscard]] inline std::string format(const char* pattern, ...) {
    char text[256];
    std::va_list values;
    va_start(values, pattern);
    std::vsnprintf(text, sizeof text, pattern, values);
    va_end(values);
    return text;
}

[[nodiscard]] inline unsigned long long count(std::uint64_t value) {
    return value;
}

/// What the coverage says.
[[nodiscard]] inline std::string coverage_text(const CoverageError& coverage) {
    if (coverage.unstable_pixels == 0) return "every pixel is stable";
    std::string text = format("%llu of %llu pixels are unstable, with", count(coverage.unstable_pixels),
                              count(coverage.unstable_pixels + coverage.stable_pixels));
    text += coverage.unstable.scale == ErrorScale::scaled ? " scaled" : " absolute";
    return text + format(" RMSE %.4g and maximum %.4g there (elsewhere %.4g and %.4g)", coverage.unstable.rmse,
                         coverage.unstable.max, coverage.stable.rmse, coverage.stable.max);
}

}  // namespace detail

PELLUCID_INLINE Result<QualityReport> quality(const ImageF& test, const ImageF& reference,
                                              const QualityOptions& options) {
    using M = QualityMetrics;
    const auto wanted = [&](M metric) { return has_any(options.metrics, metric); };
    PELLUCID_CHECK(detail::check_flip(test, reference, {options.pixels_per_degree, options.mask}, "quality"));
    if (!options.test_layers != !options.reference_layers)
        return Error{Errc::invalid_argument, std::string("quality: only the ") +
                                                 (options.test_layers ? "test" : "reference") +
                                                 " picture's layer counts were given; give both or none"};
    QualityReport report{.width = test.width, .height = test.height, .channels = test.channels};
    if (wanted(M::errors)) {
        PELLUCID_TRY(report.absolute, image_error(test, reference, {ErrorScale::absolute, options.mask}));
        PELLUCID_TRY(report.scaled, image_error(test, reference, {ErrorScale::scaled, options.mask}));
    }
    if (wanted(M::tone_mapped_psnr)) {
        PELLUCID_TRY(report.tone_mapped_psnr, tone_mapped_psnr(test, reference, options.mask));
    }
    if (wanted(M::ssim)) {
        if (Result<SsimResult> result = ssim(test, reference, options.mask))
            report.ssim = std::move(*result);
        else
            report.notes.push_back(result.error().message);
    }
    if (wanted(M::ldr_flip)) {
        PELLUCID_TRY(report.ldr_flip, ldr_flip(test, reference, {options.pixels_per_degree, options.mask}));
    }
    if (wanted(M::hdr_flip)) {
        const HdrFlipOptions flip_options{.pixels_per_degree = options.pixels_per_degree, .mask = options.mask};
        PELLUCID_TRY(report.hdr_flip, hdr_flip(test, reference, flip_options));
    }
    if (!wanted(M::coverage)) return report;
    if (options.test_layers) {
        PELLUCID_TRY(report.layers, layer_difference(*options.test_layers, *options.reference_layers));
        if (options.test_layers->width != test.width || options.test_layers->height != test.height)
            return Error{Errc::invalid_argument, "quality: the layer counts are " +
                                                     detail::shape(*options.test_layers) + ", but the pictures are " +
                                                     detail::shape(test)};
        Image8 stable = report.layers->stable;
        if (options.mask)
            for (std::size_t i = 0; i < stable.data.size() && i < options.mask->data.size(); ++i)
                if (options.mask->data[i] != 255) stable.data[i] = 0;
        PELLUCID_TRY(report.coverage, coverage_error(test, reference, stable, options.scale));
    } else if (options.mask) {
        PELLUCID_TRY(report.coverage, coverage_error(test, reference, *options.mask, options.scale));
    }
    return report;
}

PELLUCID_INLINE std::string to_json(const QualityReport& report) {
    detail::JsonObject object;
    object.add("width", std::uint64_t{report.width}).add("height", std::uint64_t{report.height});
    object.add("channels", std::uint64_t{report.channels});
    detail::add_metric(object, "absolute", report.absolute);
    detail::add_metric(object, "scaled", report.scaled);
    detail::add_metric(object, "tone_mapped_psnr", report.tone_mapped_psnr);
    detail::add_metric(object, "ssim", report.ssim);
    detail::add_metric(object, "ldr_flip", report.ldr_flip);
    detail::add_metric(object, "hdr_flip", report.hdr_flip);
    detail::add_metric(object, "layers", report.layers);
    detail::add_metric(object, "coverage", report.coverage);
    std::string notes;
    for (const std::string& note : report.notes) notes += (notes.empty() ? "" : ", ") + detail::quoted(note);
    object.raw("notes", "[" + notes + "]");
    return object.close();
}

PELLUCID_INLINE std::string to_text(const QualityReport& report) {
    using detail::count, detail::format;
    std::string text = format("%u x %u pixels", report.width, report.height);
    if (report.absolute) {
        const ImageError& e = *report.absolute;
        text += format(", %llu compared, %llu left out: ", count(e.pixels), count(e.masked_out));
        text += e.bit_equal() && e.pixels > 0
                    ? std::string("bit for bit equal")
                    : format("RMSE %.4g, maximum %.4g at (%u, %u)", e.rmse, e.max, e.worst.x, e.worst.y);
        if (report.scaled)
            text += format(", scaled RMSE %.4g and maximum %.4g", report.scaled->rmse, report.scaled->max);
        if (e.nonfinite + e.nonfinite_reference > 0)
            text +=
                format(", NOT FINITE: %llu values (reference: %llu)", count(e.nonfinite), count(e.nonfinite_reference));
    }
    if (report.tone_mapped_psnr) text += format("; PSNR %.2f dB", report.tone_mapped_psnr->psnr);
    if (report.ssim) text += format("; SSIM %.5f", report.ssim->mean);
    if (report.ldr_flip) text += format("; LDR-FLIP %.4f", report.ldr_flip->mean);
    if (report.hdr_flip)
        text += format("; HDR-FLIP %.4f over %u exposures from %+.2f to %+.2f stops", report.hdr_flip->error.mean,
                       report.hdr_flip->exposures, report.hdr_flip->start_exposure, report.hdr_flip->stop_exposure);
    if (report.layers) text += format("; %llu pixels have another number of layers", count(report.layers->different));
    if (report.coverage) text += "; " + detail::coverage_text(*report.coverage);
    for (const std::string& note : report.notes) text += "; left out: " + note;
    return text + ".";
}

}  // namespace pellucid::inline v0_1::measure
