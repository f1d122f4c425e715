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

namespace pellucid::inline v0_1::detail {

[[nodiscard]] inline bool is_data_uri(std::string_view uri) noexcept {
    return uri.substr(0, 5) == "data:";
}

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

/// `text` with its percent escapes (RFC 3986) replaced; nothing where one is broken.
[[nodiscard]] inline std::optional<std::string> decode_percent(std::string_view text) {
    const auto digit = [&](std::size_t at) {
        const char c = at < text.size() ? text[at] : ' ';
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            plain += text[i];
            continue;
        }
        const int high = digit(i + 1), low = digit(i + 2);
        if (high < 0 || low < 0) return std::nullopt;
        plain += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return plain;
}

/// The content of a data URI (RFC 2397): base64 where it says so, else percent-encoded; nothing where it is broken.
[[nodiscard]] inline std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
    constexpr std::string_view mark = ";base64";
    const std::string_view head = uri.substr(0, comma), body = uri.substr(comma + 1);
    if (head.size() >= mark.size() && head.substr(head.size() - mark.size()) == mark) return decode_base64(body);
    const auto plain = decode_percent(body);
    if (!plain) return std::nullopt;
    const auto* bytes = reinterpret_cast<const std::byte*>(plain->data());
    return std::vector<std::byte>(bytes, bytes + plain->size());
}

/// The path that a relative address names from `folder`; nothing for an absolute one, one with a scheme, an empty one
/// or one with a broken escape.
[[nodiscard]] inline std::optional<std::string> resolve_uri(std::string_view uri, const std::filesystem::path& folder) {
    const auto path = decode_percent(uri);
    // A colon before the first slash ends a scheme.
    const std::size_t colon = uri.find(':');
    if (!path || path->empty() || (colon != std::string_view::npos && uri.find('/') > colon)) return std::nullopt;
    if (path->find('\0') != std::string::npos || path->front() == '/' || path->front() == '\\') return std::nullopt;
    return (folder / *path).string();
}

}  // namespace pellucid::inline v0_1::detail
