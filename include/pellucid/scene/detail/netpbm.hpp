// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The header that PGM and PFM share: a two-letter kind, width, height and one number, then one white space.
#include <pellucid/scene/detail/file.hpp>
#include <pellucid/scene/image_file.hpp>
#include <charconv>
#include <string_view>

namespace pellucid::inline v0_1::detail {

struct NetpbmHeader {
    std::string_view kind;  ///< "P5", "PF", "Pf"
    Extent2D size;
    float number = 0;      ///< PGM: largest value; PFM: scale, negative for little-endian
    std::size_t data = 0;  ///< [B] where the texels start
};

inline Result<NetpbmHeader> read_netpbm_header(std::string_view text, const std::string& path,
                                               const ImageLimits& limits) {
    const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    std::string_view words[4];
    std::size_t at = 0;
    for (std::string_view& word : words) {
        while (at < text.size() && (space(text[at]) || text[at] == '#'))
            at = text[at] == '#' ? std::min(text.find('\n', at), text.size()) : at + 1;
        const std::size_t start = at;
        while (at < text.size() && !space(text[at]) && at - start < 32) ++at;
        word = text.substr(start, at - start);
    }
    const auto number = [](std::string_view word, auto& value) {
        const auto end = word.data() + word.size();
        const auto parsed = std::from_chars(word.data(), end, value);
        return parsed.ec == std::errc{} && parsed.ptr == end;
    };
    NetpbmHeader header{.kind = words[0]};
    if (!number(words[1], header.size.width) || !number(words[2], header.size.height) ||
        !number(words[3], header.number) || at >= text.size())
        return Error{Errc::parse, path + ": the header is not a kind, a width, a height and a number"};
    if (header.size.width == 0 || header.size.height == 0 || header.size.width > limits.max_side ||
        header.size.height > limits.max_side ||
        std::uint64_t{header.size.width} * header.size.height * 4 > limits.max_bytes)
        return Error{Errc::parse, path + ": " + std::to_string(header.size.width) + " x " +
                                      std::to_string(header.size.height) + " texels is outside 1 to " +
                                      std::to_string(limits.max_side) + " a side, " + std::to_string(limits.max_bytes) +
                                      " bytes in all"};
    header.data = at + 1;
    return header;
}

}  // namespace pellucid::inline v0_1::detail
