// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How far a picture is from its reference.  Definitions (v: test value, r: reference value, e: error of one channel of
/// one pixel that the mask lets through, n: number of such values that are finite on both sides):
///   absolute e = |v − r|;  scaled e = |v − r| / max(1, |r|);  computed in double
///   mean = Σ e / n;  rmse = √(Σ e² / n);  max = largest e;  p999 = the ⌈0.999 n⌉-th smallest e (nearest rank)
///   relative_mse = (1/n) Σ (v − r)² / (r² + 0.01), whatever the scale of e
///   ulp distance of two floats = number of representable floats between them (+0 and −0 are the same float)
///   psnr = 10 log10(255² n / Σ (v − r)²) of 8-bit values [dB]
/// Values that are not finite on either side never enter a sum: they are counted, and `within` then says no.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/statistics.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::measure {

/// Absolute: |v − r|; scaled: that over max(1, |r|).
enum class ErrorScale : std::uint8_t { absolute, scaled };

/// How errors are scaled, and which pixels count.
struct ImageErrorOptions {
    ErrorScale scale = ErrorScale::absolute;
    /// Null, or `[h, w, 1]`: pixels of value 255 are compared, all others are not.
    const Image8* mask = nullptr;
};

/// Where the largest error is.
struct WorstPixel {
    std::uint32_t x = 0, y = 0, channel = 0;
    float value = 0, reference = 0;
};

/// Errors of floats: the file's comment has the definitions.
struct ImageError {
    ErrorScale scale = ErrorScale::absolute;  ///< of mean, rmse, max and p999
    std::uint64_t pixels = 0;                 ///< compared
    std::uint64_t masked_out = 0;             ///< pixels that the mask left out
    std::uint64_t values = 0;                 ///< n: finite on both sides
    double mean = 0, rmse = 0, max = 0, p999 = 0;
    double relative_mse = 0;
    WorstPixel worst;                       ///< first in row order where several are equally bad
    std::uint64_t nonfinite = 0;            ///< values of the test picture that are NaN or infinite
    std::uint64_t nonfinite_reference = 0;  ///< the same in the reference
    std::uint64_t different_pixels = 0;     ///< pixels with any bit unlike
    std::uint64_t different_values = 0;     ///< values with any bit unlike
    std::uint64_t different_bits = 0;       ///< unlike bits of all values
    std::uint32_t max_ulp = 0;              ///< largest ulp distance of finite values

    /// Something was compared, every compared value is finite, and no error exceeds `budget`.
    [[nodiscard]] bool within(double budget) const noexcept {
        return values > 0 && nonfinite == 0 && nonfinite_reference == 0 && max <= budget;
    }
    [[nodiscard]] bool bit_equal() const noexcept { return different_bits == 0; }
};

/// Errors of 8-bit codes.
struct Image8Error {
    std::uint64_t pixels = 0;            ///< compared
    std::uint64_t masked_out = 0;        ///< pixels that the mask left out
    std::uint64_t different_pixels = 0;  ///< pixels with any channel unlike
    std::uint32_t max = 0;               ///< largest difference of a channel [1/255]
    double mse = 0;                      ///< [1/255²]
    double psnr = 0;                     ///< [dB] infinite for equal pictures
};

/// Number of representable floats from `a` to `b`, both finite.
[[nodiscard]] constexpr std::uint32_t ulp_distance(float a, float b) noexcept {
    // Sign and magnitude → an integer that grows with the float and is 0 for both zeros.
    const auto ordered = [](float value) {
        const auto magnitude = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(value) & 0x7FFFFFFFu);
        return std::bit_cast<std::uint32_t>(value) >> 31u ? -magnitude : magnitude;
    };
    const std::int64_t difference = ordered(a) - ordered(b);
    return static_cast<std::uint32_t>(difference < 0 ? -difference : difference);
}

/// Error of one value by `scale`.
[[nodiscard]] inline double value_error(float value, float reference, ErrorScale scale) noexcept {
    const double error = std::abs(static_cast<double>(value) - static_cast<double>(reference));
    return scale == ErrorScale::scaled ? error / std::max(1.0, std::abs(static_cast<double>(reference))) : error;
}

/// Compares `test` with `reference`: both `[h, w, c]`, the same h, w and c, c in 1 … 4; all channels count alike.
/// Errors: invalid_argument where the shapes do not match or the mask is not `[h, w, 1]`.
[[nodiscard]] inline Result<ImageError> image_error(const ImageF& test, const ImageF& reference,
                                                    const ImageErrorOptions& options = {});

/// The same for 8-bit pictures.
[[nodiscard]] inline Result<Image8Error> image_error(const Image8& test, const Image8& reference,
                                                     const Image8* mask = nullptr);

/// `[h, w, 1]`: for each pixel the largest error of its channels; NaN where a channel is not finite on either side, and
/// where the mask leaves it out.
[[nodiscard]] inline Result<ImageF> error_picture(const ImageF& test, const ImageF& reference,
                                                  const ImageErrorOptions& options = {});

/// One JSON object with the members' names; numbers that are not finite become null.
[[nodiscard]] inline std::string to_json(const ImageError& error);
[[nodiscard]] inline std::string to_json(const Image8Error& error);

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

template <class T>
[[nodiscard]] std::string shape(const Image<T>& image) {
    return "[" + std::to_string(image.height) + ", " + std::to_string(image.width) + ", " +
           std::to_string(image.channels) + "]";
}

template <class T>
[[nodiscard]] Result<void> check_shapes(const Image<T>& test, const Image<T>& reference, const Image8* mask,
                                        const char* what = "image error") {
    if (test.width != reference.width || test.height != reference.height || test.channels != reference.channels ||
        test.channels < 1 || test.channels > 4)
        return Error{Errc::invalid_argument, std::string(what) + ": the test picture is " + shape(test) +
                                                 " and the reference is " + shape(reference) +
                                                 ", but both must have the same [h, w, c] with c in 1 ... 4"};
    if (mask && (mask->width != test.width || mask->height != test.height || mask->channels != 1))
        return Error{Errc::invalid_argument, std::string(what) + ": the mask is " + shape(*mask) + ", but must be [" +
                                                 std::to_string(test.height) + ", " + std::to_string(test.width) +
                                                 ", 1] like the pictures"};
    return {};
}

/// Appends `"name": number` members; no locale, shortest digits that read back as the same double.
class JsonObject {
public:
    JsonObject& add(const char* key, double value) {
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value);
        return raw(key, std::isfinite(value) ? std::string(text, end.ptr) : std::string("null"));
    }
    JsonObject& add(const char* key, std::uint64_t value) { return raw(key, std::to_string(value)); }
    JsonObject& raw(const char* key, const std::string& value) {
        text_ += (text_.size() > 1 ? ", \"" : "\"") + std::string(key) + "\": " + value;
        return *this;
    }
    [[nodiscard]] std::string close() const { return text_ + "}"; }

private:
    std::string text_ = "{";
};

[[nodiscard]] inline std::string to_json(const WorstPixel& worst) {
    JsonObject object;
    object.add("x", std::uint64_t{worst.x}).add("y", std::uint64_t{worst.y});
    object.add("channel", std::uint64_t{worst.channel}).add("value", static_cast<double>(worst.value));
    object.add("reference", static_cast<double>(worst.reference));
    return object.close();
}

}  // namespace detail

Result<ImageError> image_error(const ImageF& test, const ImageF& reference, const ImageErrorOptions& options) {
    PELLUCID_CHECK(detail::check_shapes(test, reference, options.mask));
    ImageError result{.scale = options.scale};
    std::vector<double> errors;
    errors.reserve(test.data.size());
    double sum = 0, sum_of_squares = 0, relative = 0;
    for (std::uint32_t y = 0; y < test.height; ++y)
        for (std::uint32_t x = 0; x < test.width; ++x) {
            if (options.mask && *options.mask->texel(x, y) != 255) {
                ++result.masked_out;
                continue;
            }
            ++result.pixels;
            bool different = false;
            for (std::uint32_t c = 0; c < test.channels; ++c) {
                const float v = test.texel(x, y)[c], r = reference.texel(x, y)[c];
                const std::uint32_t unlike = std::bit_cast<std::uint32_t>(v) ^ std::bit_cast<std::uint32_t>(r);
                result.different_bits += static_cast<std::uint64_t>(std::popcount(unlike));
                result.different_values += unlike != 0;
                different |= unlike != 0;
                result.nonfinite += !std::isfinite(v);
                result.nonfinite_reference += !std::isfinite(r);
                if (!std::isfinite(v) || !std::isfinite(r)) continue;
                const double error = value_error(v, r, options.scale);
                const double difference = static_cast<double>(v) - static_cast<double>(r);
                if (errors.empty() || error > result.max) {
                    result.max = error;
                    result.worst = {x, y, c, v, r};
                }
                errors.push_back(error);
                sum += error;
                sum_of_squares += error * error;
                relative += difference * difference / (static_cast<double>(r) * static_cast<double>(r) + 0.01);
                result.max_ulp = std::max(result.max_ulp, ulp_distance(v, r));
            }
            result.different_pixels += different;
        }
    result.values = errors.size();
    if (errors.empty()) return result;
    const auto n = static_cast<double>(errors.size());
    result.mean = sum / n;
    result.rmse = std::sqrt(sum_of_squares / n);
    result.relative_mse = relative / n;
    result.p999 = nearest_rank(errors, 0.999);
    return result;
}

Result<Image8Error> image_error(const Image8& test, const Image8& reference, const Image8* mask) {
    PELLUCID_CHECK(detail::check_shapes(test, reference, mask));
    Image8Error result;
    std::uint64_t squares = 0;
    for (std::uint32_t y = 0; y < test.height; ++y)
        for (std::uint32_t x = 0; x < test.width; ++x) {
            if (mask && *mask->texel(x, y) != 255) {
                ++result.masked_out;
                continue;
            }
            ++result.pixels;
            std::uint32_t largest = 0;
            for (std::uint32_t c = 0; c < test.channels; ++c) {
                const int difference = int{test.texel(x, y)[c]} - int{reference.texel(x, y)[c]};
                squares += static_cast<std::uint64_t>(difference * difference);
                largest = std::max(largest, static_cast<std::uint32_t>(std::abs(difference)));
            }
            result.different_pixels += largest != 0;
            result.max = std::max(result.max, largest);
        }
    const auto n = static_cast<double>(result.pixels * test.channels);
    result.mse = n > 0 ? static_cast<double>(squares) / n : 0;
    result.psnr = squares > 0 ? 10 * std::log10(255.0 * 255.0 / result.mse) : std::numeric_limits<double>::infinity();
    return result;
}

Result<ImageF> error_picture(const ImageF& test, const ImageF& reference, const ImageErrorOptions& options) {
    PELLUCID_CHECK(detail::check_shapes(test, reference, options.mask));
    ImageF errors(test.width, test.height, 1);
    for (std::uint32_t y = 0; y < test.height; ++y)
        for (std::uint32_t x = 0; x < test.width; ++x) {
            bool usable = !options.mask || *options.mask->texel(x, y) == 255;
            double largest = 0;
            for (std::uint32_t c = 0; c < test.channels; ++c) {
                const float v = test.texel(x, y)[c], r = reference.texel(x, y)[c];
                usable = usable && std::isfinite(v) && std::isfinite(r);
                if (usable) largest = std::max(largest, value_error(v, r, options.scale));
            }
            *errors.texel(x, y) = usable ? static_cast<float>(largest) : std::numeric_limits<float>::quiet_NaN();
        }
    return errors;
}

std::string to_json(const ImageError& error) {
    detail::JsonObject object;
    object.raw("scale", error.scale == ErrorScale::scaled ? "\"scaled\"" : "\"absolute\"");
    object.add("pixels", error.pixels).add("masked_out", error.masked_out).add("values", error.values);
    object.add("mean", error.mean).add("rmse", error.rmse).add("max", error.max).add("p999", error.p999);
    object.add("relative_mse", error.relative_mse).raw("worst", detail::to_json(error.worst));
    object.add("nonfinite", error.nonfinite).add("nonfinite_reference", error.nonfinite_reference);
    object.add("different_pixels", error.different_pixels).add("different_values", error.different_values);
    object.add("different_bits", error.different_bits).add("max_ulp", std::uint64_t{error.max_ulp});
    return object.close();
}

/// One JSON object with the members' names.
std::string to_json(const Image8Error& error) {
    detail::JsonObject object;
    object.add("pixels", error.pixels).add("masked_out", error.masked_out);
    object.add("different_pixels", error.different_pixels).add("max", std::uint64_t{error.max});
    object.add("mse", error.mse).add("psnr", error.psnr);
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
