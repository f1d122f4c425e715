// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A JSON value that knows where it stands, for errors that name the place.
#include <pellucid/core/result.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace pellucid::inline v0_1::detail {

using Json = nlohmann::json;

/// Ends the loading of a file from any depth; `load_gltf` catches it and returns its error.
struct GltfFailure {
    Error error;
};
[[noreturn]] inline void gltf_fail(const std::string& message, Errc code = Errc::parse) {
    throw GltfFailure{{code, message}};
}
template <class T>
T gltf_value(Result<T> result) {
    if (!result) throw GltfFailure{result.error()};
    return std::move(*result);
}

/// A string of the file for a message: one line, of limited length.
[[nodiscard]] inline std::string gltf_printable(std::string_view text, std::size_t limit = 80) {
    std::string line(text.substr(0, limit));
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '?';
    return text.size() > limit ? line + "..." : line;
}

/// One value of the document and its JSON pointer (RFC 6901).  Invariant: the document outlives it.
class GltfValue {
public:
    GltfValue(Json& value, std::string pointer) : value_(&value), pointer_(std::move(pointer)) {}

    [[nodiscard]] const std::string& pointer() const noexcept { return pointer_; }
    [[nodiscard]] Json& json() const noexcept { return *value_; }
    [[noreturn]] void fail(const std::string& what) const {
        gltf_fail((pointer_.empty() ? "/" : pointer_) + ": " + what);
    }

    [[nodiscard]] bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
    [[nodiscard]] GltfValue operator[](const char* key) const { return {(*value_)[key], pointer_ + "/" + escape(key)}; }
    [[nodiscard]] GltfValue operator[](std::size_t i) const {
        return {(*value_)[i], pointer_ + "/" + std::to_string(i)};
    }
    [[nodiscard]] std::size_t size() const noexcept { return value_->size(); }

    /// Members that the schema check has seen; `fallback` where there is none.
    [[nodiscard]] std::uint64_t integer(const char* key, std::uint64_t fallback = 0) const {
        return has(key) ? (*value_)[key].get<std::uint64_t>() : fallback;
    }
    [[nodiscard]] bool boolean(const char* key) const { return has(key) && (*value_)[key].get<bool>(); }
    [[nodiscard]] std::string text(const char* key) const {
        return has(key) ? (*value_)[key].get<std::string>() : std::string();
    }

    /// `key` as a part of a JSON pointer.
    [[nodiscard]] static std::string escape(std::string_view key) {
        std::string text;
        for (const char c : key) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
        return gltf_printable(text);
    }

private:
    Json* value_;
    std::string pointer_;
};

/// Refuses text that nests deeper than `limit` before a recursive parser sees it.
inline void gltf_check_depth(std::string_view text, std::uint32_t limit) {
    std::uint32_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == '{' || c == '[') {
            if (++depth > limit)
                gltf_fail("byte " + std::to_string(i) + ": the JSON nests deeper than the limit of " +
                          std::to_string(limit));
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
}

}  // namespace pellucid::inline v0_1::detail
