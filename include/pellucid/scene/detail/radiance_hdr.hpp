// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Radiance pictures (.hdr): the header and the scan lines, as in Ward, "Radiance File Formats" (the file filefmts.pdf
/// of the Radiance distribution), section "Picture File Format"; colours as in Ward, "Real Pixels", Graphics Gems II
/// (1991).  Old run lengths (a texel with mantissas 1 1 1), which no program has written since 1991, are refused.
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <pellucid/scene/image_file.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::inline v0_1::detail {

struct HdrHeader {
    Extent2D size;
    std::array<double, 3> scale{1, 1, 1};  ///< what the file's numbers are multiplied by: 1/(EXPOSURE · COLORCORR)
    std::size_t data = 0;                  ///< [B] where the scan lines start
};

/// Reads one Radiance picture out of `bytes`; `name` is what it is called in errors, all of them Errc::parse.
class HdrReader {
public:
    HdrReader(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits)
        : bytes_(bytes),
          text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
          name_(name),
          limits_(limits) {}

    [[nodiscard]] Result<ImageF> read() {
        PELLUCID_TRY(const HdrHeader header, read_header());
        PELLUCID_CHECK(check_size(header));
        ImageF image(header.size.width, header.size.height, 3);
        std::vector<std::uint8_t> line(std::size_t{image.width} * 4);
        at_ = header.data;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            PELLUCID_CHECK(read_line(line, y, image.width));
            for (std::uint32_t x = 0; x < image.width; ++x) {
                float* out = image.texel(x, y);
                const std::uint8_t* texel = line.data() + std::size_t{x} * 4;
                // E = 0 is black; else a mantissa stands for the middle of its step, (m + 1/2)/256 · 2^(E − 128).
                const double step = texel[3] == 0 ? 0.0 : std::ldexp(1.0, texel[3] - 136);
                for (std::size_t c = 0; c < 3; ++c) {
                    out[c] = static_cast<float>((texel[c] + 0.5) * step * header.scale[c]);
                    if (!std::isfinite(out[c]))
                        return fail("texel (" + std::to_string(x) + ", " + std::to_string(y) +
                                    ") is beyond what a float holds once EXPOSURE and COLORCORR are taken out");
                }
            }
        }
        if (at_ != bytes_.size())
            return fail("holds " + std::to_string(bytes_.size() - at_) + " bytes after its last scan line, at byte " +
                        std::to_string(at_) + ": its size, " + size_text(header.size) + ", disagrees with its data");
        return image;
    }

private:
    static constexpr std::size_t max_header = 65536;  // [B]
    static constexpr std::string_view supported_format = "32-bit_rle_rgbe";

    [[nodiscard]] Error fail(const std::string& what) const { return Error{Errc::parse, name_ + ": " + what}; }
    [[nodiscard]] static std::string size_text(Extent2D size) {
        return std::to_string(size.width) + " x " + std::to_string(size.height) + " texels";
    }
    /// What a file says, fit to stand in a sentence.
    [[nodiscard]] static std::string quoted(std::string_view text) {
        std::string out = "\"";
        for (const char c : text.substr(0, 60)) out += c >= ' ' && c <= '~' ? c : '?';
        return out + (text.size() > 60 ? "...\"" : "\"");
    }

    /// The line that starts at `at`, which moves behind its end; false where the header's longest has none.
    [[nodiscard]] bool next_line(std::size_t& at, std::string_view& line) const {
        const std::size_t end = text_.substr(0, max_header).find('\n', at);
        if (end == std::string_view::npos) return false;
        line = text_.substr(at, end - at);
        at = end + 1;
        return true;
    }
    /// Exactly `values.size()` numbers between blanks.
    [[nodiscard]] static bool read_numbers(std::string_view text, std::span<double> values) {
        const char* at = text.data();
        const char* end = at + text.size();
        const auto skip_blanks = [&] { at = std::find_if(at, end, [](char c) { return c != ' ' && c != '\t'; }); };
        for (double& value : values) {
            skip_blanks();
            const auto [rest, code] = std::from_chars(at, end, value);
            if (code != std::errc{} || (rest != end && *rest != ' ' && *rest != '\t')) return false;
            at = rest;
        }
        skip_blanks();
        return at == end;
    }

    [[nodiscard]] Result<HdrHeader> read_header() const {
        if (!text_.starts_with("#?"))
            return fail("is no Radiance picture: it starts with " + quoted(text_.substr(0, 10)) + ", not with \"#?\"");
        HdrHeader header;
        bool has_format = false;
        std::string_view line;
        std::size_t at = 0;
        for (int number = 1;; ++number) {
            if (!next_line(at, line))
                return fail("its header does not end: no empty line in its first " +
                            std::to_string(std::min(text_.size(), max_header)) + " bytes");
            if (line.empty()) break;
            const std::size_t sign = line.find('=');
            if (sign == std::string_view::npos || line[0] == '#') continue;  // a command or a remark
            std::string_view value = line.substr(sign + 1);
            const std::string_view key = line.substr(0, sign);
            if (key == "FORMAT") {
                value = value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
                value = value.substr(0, value.find_last_not_of(" \t") + 1);
                if (value != supported_format)
                    return fail("line " + std::to_string(number) + ": FORMAT is " + quoted(value) +
                                (value == "32-bit_rle_xyze" ? ", CIE XYZ" : "") + ", only " +
                                std::string(supported_format) + " can be read; convert the picture (ra_xyze -r)");
                has_format = true;
            } else if (key == "EXPOSURE" || key == "COLORCORR") {
                std::array<double, 3> factors{};
                const std::size_t count = key == "EXPOSURE" ? 1 : 3;
                if (!read_numbers(value, std::span(factors).first(count)))
                    return fail("line " + std::to_string(number) + ": " + std::string(key) + " is " + quoted(value) +
                                ", but must be " + (count == 1 ? "a number" : "three numbers"));
                if (count == 1) factors[1] = factors[2] = factors[0];
                for (std::size_t c = 0; c < 3; ++c) {
                    header.scale[c] /= factors[c];
                    if (!(factors[c] > 0) || !std::isnormal(header.scale[c]))
                        return fail("line " + std::to_string(number) + ": " + std::string(key) + " is " +
                                    quoted(value) + ", but must be above 0, and so must all such lines together");
                }
            }
        }
        if (!has_format) return fail("its header has no FORMAT line, but must say " + std::string(supported_format));
        if (!next_line(at, line)) return fail("ends behind its header: there is no line with its size");
        PELLUCID_TRY(header.size, read_resolution(line));
        header.data = at;
        return header;
    }

    /// "-Y h +X w": rows from the top, texels from the left.
    [[nodiscard]] Result<Extent2D> read_resolution(std::string_view line) const {
        const std::string what = "its size is given as " + quoted(line);
        const auto axis = [](std::string_view& rest, char& sign, char& letter, std::uint32_t& count) {
            if (rest.size() < 4 || (rest[0] != '-' && rest[0] != '+') || (rest[1] != 'X' && rest[1] != 'Y') ||
                rest[2] != ' ')
                return false;
            sign = rest[0];
            letter = rest[1];
            const char* end = rest.data() + rest.size();
            const auto [stop, code] = std::from_chars(rest.data() + 3, end, count);
            rest = {stop, static_cast<std::size_t>(end - stop)};
            return code == std::errc{};
        };
        char sign[2] = {}, letter[2] = {};
        std::uint32_t count[2] = {};
        std::string_view rest = line;
        if (!axis(rest, sign[0], letter[0], count[0]) || rest.empty() || rest[0] != ' ' ||
            !axis(rest = rest.substr(1), sign[1], letter[1], count[1]) || !rest.empty() || letter[0] == letter[1])
            return fail(what + ", but must be \"-Y height +X width\"");
        if (letter[0] != 'Y' || sign[0] != '-' || sign[1] != '+')
            return fail(what +
                        ", another orientation than \"-Y height +X width\", the only one that can be read; turn "
                        "the picture (protate, pflip)");
        return Extent2D{count[1], count[0]};
    }

    /// Before anything is allocated: the limits, and what the shortest scan lines would take.
    [[nodiscard]] Result<void> check_size(const HdrHeader& header) const {
        const Extent2D size = header.size;
        if (size.width == 0 || size.height == 0 || size.width > limits_.max_side || size.height > limits_.max_side ||
            std::uint64_t{size.width} * size.height * 4 > limits_.max_bytes)
            return fail(size_text(size) + " is outside 1 to " + std::to_string(limits_.max_side) + " a side, " +
                        std::to_string(limits_.max_bytes) + " bytes in all at 4 a texel");
        const std::uint64_t flat = std::uint64_t{size.width} * 4;
        // Two bytes make a run of 127 at most, in each of four channels.
        const std::uint64_t shortest =
            can_be_packed(size.width) ? std::min(flat, 4 + 8 * ((std::uint64_t{size.width} + 126) / 127)) : flat;
        if (const std::uint64_t rest = bytes_.size() - header.data; rest < shortest * size.height)
            return fail("holds " + std::to_string(rest) + " bytes of scan lines, " + size_text(size) +
                        " take at least " + std::to_string(shortest * size.height));
        return {};
    }
    [[nodiscard]] static bool can_be_packed(std::uint32_t width) { return width >= 8 && width <= 0x7FFF; }

    [[nodiscard]] std::string place(std::uint32_t y) const {
        return "scan line " + std::to_string(y) + ", byte " + std::to_string(at_) + ": ";
    }
    [[nodiscard]] std::uint8_t byte(std::size_t at) const { return static_cast<std::uint8_t>(bytes_[at]); }

    /// One scan line to RGBE texels.  Four bytes, 2 2 and the width, announce four channels of runs; else texels lie
    /// as they are.
    [[nodiscard]] Result<void> read_line(std::vector<std::uint8_t>& line, std::uint32_t y, std::uint32_t width) {
        if (can_be_packed(width) && bytes_.size() - at_ >= 4 && byte(at_) == 2 && byte(at_ + 1) == 2 &&
            byte(at_ + 2) < 128) {
            const unsigned announced = byte(at_ + 2) * 256u + byte(at_ + 3);
            if (announced != width)
                return fail(place(y) + "says that it has " + std::to_string(announced) + " texels, the picture is " +
                            std::to_string(width) + " wide");
            at_ += 4;
            for (std::size_t channel = 0; channel < 4; ++channel)
                PELLUCID_CHECK(read_channel(line.data() + channel, y, width));
            return {};
        }
        if (bytes_.size() - at_ < line.size())
            return fail(place(y) + "ends after " + std::to_string(bytes_.size() - at_) + " bytes of " +
                        std::to_string(line.size()));
        for (std::size_t i = 0; i < line.size(); ++i) line[i] = byte(at_ + i);
        for (std::size_t i = 0; i < line.size(); i += 4)
            if (line[i] == 1 && line[i + 1] == 1 && line[i + 2] == 1)
                return fail(place(y) + "texel " + std::to_string(i / 4) +
                            " is a run of the old kind, which cannot be read; convert the picture (ra_rgbe)");
        at_ += line.size();
        return {};
    }

    /// One channel of a line: a code above 128 and a byte, repeated code − 128 times; or a code and so many bytes.
    [[nodiscard]] Result<void> read_channel(std::uint8_t* target, std::uint32_t y, std::uint32_t width) {
        for (std::uint32_t x = 0; x < width;) {
            if (at_ == bytes_.size()) return fail(place(y) + "the file ends inside the line");
            const std::uint32_t code = byte(at_);
            const bool run = code > 128;
            const std::uint32_t count = run ? code - 128 : code, stored = run ? 1 : count;
            if (count == 0) return fail(place(y) + "a run has no texels");
            if (count > width - x)
                return fail(place(y) + "a run of " + std::to_string(count) + " texels starts at texel " +
                            std::to_string(x) + " of " + std::to_string(width) + ", beyond the end of the line");
            if (bytes_.size() - at_ - 1 < stored) return fail(place(y) + "the file ends inside a run");
            for (std::uint32_t i = 0; i < count; ++i, ++x) target[std::size_t{x} * 4] = byte(at_ + 1 + (run ? 0 : i));
            at_ += 1 + stored;
        }
        return {};
    }

    std::span<const std::byte> bytes_;
    std::string_view text_;
    const std::string& name_;
    const ImageLimits& limits_;
    std::size_t at_ = 0;  ///< [B] of the scan lines read so far
};

}  // namespace pellucid::inline v0_1::detail
