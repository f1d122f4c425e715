// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// From a file's bytes to its JSON document and its binary chunk.
#include <pellucid/scene/detail/file.hpp>
#include <pellucid/scene/detail/gltf_json.hpp>
#include <pellucid/scene/gltf.hpp>
#include <optional>
#include <span>

namespace pellucid::inline v0_1::detail {

/// What a file may still take of something: what it asks for twice it pays for twice, so that work and memory stay in
/// proportion to the file whatever refers to what.
struct GltfBudget {
    std::uint64_t limit = 0;  ///< [B]
    std::uint64_t used = 0;   ///< [B]

    /// Ends the loading where `bytes` more are too much; `place` and `what` say of what.
    void take(std::uint64_t bytes, const std::string& place, const char* what) {
        if (bytes > limit - used)
            gltf_fail(place + ": " + what + " so far take " + std::to_string(used + bytes) +
                      " bytes, the limit for this file is " + std::to_string(limit));
        used += bytes;
    }
};

struct GltfContainer {
    std::string_view json;                          ///< into `bytes`
    std::optional<std::span<const std::byte>> bin;  ///< into `bytes`; nothing where there is no such chunk
    bool binary = false;                            ///< a .glb
};

/// Takes a .glb apart: a header of magic, version and length, then chunks of length, type and data, each a multiple of
/// four bytes; JSON first, BIN second, others are passed over.  Anything else is taken to be JSON text.
/// `container` points into `bytes`.
inline GltfContainer gltf_open(std::span<const std::byte> bytes) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    const auto text = [](std::span<const std::byte> part) {
        return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
    };
    constexpr std::uint32_t magic = 0x46546C67u, json_type = 0x4E4F534Au, bin_type = 0x004E4942u;
    if (bytes.size() < 4 || word(0) != magic) return {.json = text(bytes)};
    if (bytes.size() < 12) gltf_fail("byte 0: the GLB header has " + std::to_string(bytes.size()) + " bytes, not 12");
    if (word(4) != 2) gltf_fail("byte 4: the GLB version is " + std::to_string(word(4)) + ", only 2 is supported");
    const std::size_t length = word(8);
    if (length > bytes.size() || length < 20)
        gltf_fail("byte 8: the GLB length is " + std::to_string(length) + ", the file has " +
                  std::to_string(bytes.size()) + " bytes");
    GltfContainer container{.binary = true};
    bool has_json = false;
    for (std::size_t at = 12; at < length;) {
        const std::string place = "byte " + std::to_string(at) + ": ";
        if (length - at < 8) gltf_fail(place + "the file ends inside a chunk's header");
        const std::size_t size = word(at);
        const std::uint32_t type = word(at + 4);
        if (size % 4 != 0) gltf_fail(place + "the chunk's length is " + std::to_string(size) + ", no multiple of 4");
        if (size > length - at - 8)
            gltf_fail(place + "the chunk's length is " + std::to_string(size) + ", only " +
                      std::to_string(length - at - 8) + " bytes follow");
        const auto data = bytes.subspan(at + 8, size);
        if (has_json != (type != json_type))
            gltf_fail(place + (has_json ? "a second JSON chunk" : "the first chunk is not JSON"));
        if (type == json_type) {
            container.json = text(data);
            has_json = true;
        } else if (type == bin_type) {
            if (container.bin) gltf_fail(place + "a second BIN chunk");
            container.bin = data;
        }
        at += 8 + size;
    }
    if (!has_json) gltf_fail("byte 12: there is no JSON chunk");
    return container;
}

/// Parses the JSON.  Without a parser callback: with one, nlohmann::json takes quadratic time for long arrays of
/// objects.
inline Json gltf_parse_json(std::string_view text, const GltfLimits& limits) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") gltf_fail("byte 0: the JSON starts with a byte order mark");
    if (text.size() > limits.max_json_bytes)
        gltf_fail("the JSON has " + std::to_string(text.size()) + " bytes, the limit is " +
                  std::to_string(limits.max_json_bytes));
    gltf_check_depth(text, limits.max_json_depth);
    try {
        return Json::parse(text);
    } catch (const Json::exception& exception) {
        // "[json.exception.kind.number] parse error at line 1, column 2: …"; it quotes what it has read last.
        std::string_view why = exception.what();
        why.remove_prefix(std::min(why.find("] ") + 2, why.size()));
        gltf_fail("is not valid JSON: " + gltf_printable(why, 160));
    }
}

}  // namespace pellucid::inline v0_1::detail
