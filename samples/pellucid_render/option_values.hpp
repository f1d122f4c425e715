// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Values of options, from text.  Each function gives an empty string, or what is wrong with the text.
#include <pellucid/core/image.hpp>
#include <glm/vec3.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

/// "WxH"; 0 is let through, so that the renderer's own sentence explains the limits.
[[nodiscard]] inline std::string parse_size(const std::string& text, pellucid::Extent2D& size) {
    unsigned long long w = 0, h = 0;
    char end = 0;
    if (std::sscanf(text.c_str(), "%llux%llu%c", &w, &h, &end) != 2 || text[0] == '-' || w > 0xFFFFFFFFull ||
        h > 0xFFFFFFFFull)
        return "'" + text + "' is not a size: write WIDTHxHEIGHT, for example 1280x720";
    size = {static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(h)};
    return {};
}

[[nodiscard]] inline std::string parse_color(const std::string& text, glm::vec3& color) {
    char end = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%c", &color.x, &color.y, &color.z, &end) != 3)
        return "'" + text + "' is not a colour: write three linear values, for example 0.1,0.1,0.2";
    for (int i = 0; i < 3; ++i)
        if (!(color[i] >= 0.0f) || !std::isfinite(color[i]))
            return "'" + text + "' has a value that is negative or not finite";
    return {};
}

/// A number of layers, 1 to 65535.
[[nodiscard]] inline std::string parse_layers(const std::string& text, std::uint32_t& layers) {
    std::uint16_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0)
        return "'" + text + "' is not a number of layers: write a whole number from 1 to 65535";
    layers = value;
    return {};
}

/// Bytes > 0, with K, M or G for multiples of 1024, 1024² and 1024³.
[[nodiscard]] inline std::string parse_bytes(const std::string& text, std::uint64_t& bytes) {
    const char* const last = text.data() + text.size();
    std::uint64_t value = 0;
    auto [end, error] = std::from_chars(text.data(), last, value);
    const std::string suffixes = "KMG";
    const std::size_t suffix = end + 1 == last ? suffixes.find(*end) : std::string::npos;
    const unsigned shift = suffix == std::string::npos ? 0 : 10 * static_cast<unsigned>(suffix + 1);
    if (error != std::errc() || (end != last && shift == 0) || value == 0 ||
        value > std::numeric_limits<std::uint64_t>::max() >> shift)
        return "'" + text +
               "' is not a number of bytes: write a whole number above 0, with K, M or G for its multiple by "
               "1024, 1024^2 or 1024^3, for example 64M";
    bytes = value << shift;
    return {};
}

/// A share of light, in [0,1).
[[nodiscard]] inline std::string parse_transmittance(const std::string& text, float& share) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= 0 && value < 1))
        return "'" + text + "' is not a share of light to stop at: write a number from 0 to below 1, for example 0.01";
    share = value;
    return {};
}
