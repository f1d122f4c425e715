// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Addresses in glTF files: data URIs with base64, and relative paths with percent escapes.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::detail {

[[nodiscard]] inline bool is_data_uri(std::string_view uri) noexcept { return uri.substr(0, 5) == "data:"; }

/// RFC 4648 base64, padding optional; nothing where a character is outside the alphabet or the length is impossible.
[[nodiscard]] inline std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        std::uint32_t value;
        if (c >= 'A' && c <= 'Z')
            value = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            value = static_cast<std::uint32_t>(c - 'a') + 26;
        else if (c >= '0' && c <= '9')
            value = static_cast<std::uint32_t>(c - '0') + 52;
        else if (c == '+')
            value = 62;
        else if (c == '/')
            value = 63;
        else
            return std::nullopt;
        bits = (bits << 6u | value) & 0xFFFFFFu;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> held & 0xFFu));
    }
    return bytes;
}

/// The content of a base64 data URI; nothing where it is not one.
[[nodiscard]] inline std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    constexpr std::string_view mark = ";base64";
    if (!is_data_uri(uri) || comma == std::string_view::npos || comma < mark.size() ||
        uri.substr(comma - mark.size(), mark.size()) != mark)
        return std::nullopt;
    return decode_base64(uri.substr(comma + 1));
}

/// The path that a relative address names from `folder`; nothing for an absolute one, one with a scheme, an empty one
/// or one with a broken escape.
[[nodiscard]] inline std::optional<std::string> resolve_uri(std::string_view uri, const std::filesystem::path& folder) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            path += uri[i];
            continue;
        }
        const auto digit = [&](std::size_t at) {
            const char c = at < uri.size() ? uri[at] : ' ';
            return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
        };
        const int high = digit(i + 1), low = digit(i + 2);
        if (high < 0 || low < 0 || high * 16 + low == 0) return std::nullopt;
        path += static_cast<char>(high * 16 + low);
        i += 2;
    }
    // A colon before the first slash ends a scheme.
    const std::size_t colon = uri.find(':');
    const bool scheme = colon != std::string_view::npos && uri.find('/') > colon;
    if (path.empty() || scheme || path.find('\0') != std::string::npos || path.front() == '/' || path.front() == '\\')
        return std::nullopt;
    return (folder / path).string();
}

}  // namespace pellucid::detail
