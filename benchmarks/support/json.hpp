// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A writer of JSON text (RFC 8259): calls in document order, commas and indentation by itself.
///
///     JsonWriter json;
///     json.begin_object();
///     json.member("draws", 10000);
///     json.key("rounds").begin_array();
///     json.value(1.5);
///     json.end_array();
///     json.end_object();
///     write_file("result.json", json.text());
#include <cmath>
#include <concepts>
#include <cstdio>
#include <pellucid/core/result.hpp>
#include <string>
#include <string_view>
#include "support/time.hpp"

namespace pellucid::bench {

/// Nesting is the caller's business: every begin has its end, and a value inside an object follows a key.
class JsonWriter {
public:
    JsonWriter& begin_object() { return open('{'); }
    JsonWriter& begin_array() { return open('['); }
    JsonWriter& end_object() { return close('}'); }
    JsonWriter& end_array() { return close(']'); }

    JsonWriter& key(std::string_view name) {
        separate();
        quote(name);
        text_ += ": ";
        after_key_ = true;
        return *this;
    }
    /// Numbers that JSON cannot hold (infinities, not-a-number) become null.
    JsonWriter& value(double number) {
        char digits[32] = "null";
        if (std::isfinite(number)) std::snprintf(digits, sizeof digits, "%.9g", number);
        return raw(digits);
    }
    JsonWriter& value(std::integral auto number) { return raw(std::to_string(number)); }
    JsonWriter& value(bool truth) { return raw(truth ? "true" : "false"); }
    JsonWriter& value(std::string_view string) {
        separate();
        quote(string);
        return *this;
    }
    JsonWriter& value(const char* string) { return value(std::string_view(string)); }
    JsonWriter& value(const Summary& s) {
        begin_object();
        member("median", s.median).member("q1", s.q1).member("q3", s.q3);
        member("lowest", s.lowest).member("highest", s.highest).member("count", s.count);
        return end_object();
    }
    JsonWriter& member(std::string_view name, const auto& v) { return key(name).value(v); }

    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    JsonWriter& raw(std::string_view token) {
        separate();
        text_ += token;
        return *this;
    }
    JsonWriter& open(char bracket) {
        separate();
        text_ += bracket;
        ++depth_;
        first_ = true;
        return *this;
    }
    JsonWriter& close(char bracket) {
        --depth_;
        if (!first_) new_line();
        text_ += bracket;
        first_ = false;
        return *this;
    }
    void separate() {
        if (after_key_) {
            after_key_ = false;
            return;
        }
        if (depth_ == 0) return;
        if (!first_) text_ += ',';
        first_ = false;
        new_line();
    }
    void new_line() { text_.append("\n").append(2 * depth_, ' '); }
    void quote(std::string_view string) {
        text_ += '"';
        for (const char c : string) {
            if (c == '"' || c == '\\') {
                text_ += '\\';
                text_ += c;
            } else if (static_cast<unsigned char>(c) < 0x20) {
                char escape[8];
                std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
                text_ += escape;
            } else {
                text_ += c;
            }
        }
        text_ += '"';
    }

    std::string text_;
    std::size_t depth_ = 0;
    bool first_ = true;
    bool after_key_ = false;
};

/// Writes `text` and a final newline over whatever `path` held.
inline Result<void> write_file(const std::string& path, std::string_view text) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) return Error{Errc::io, "cannot open '" + path + "' for writing"};
    const bool written =
        std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fputc('\n', file) == '\n';
    if (std::fclose(file) != 0 || !written) return Error{Errc::io, "cannot write '" + path + "': is the disk full?"};
    return {};
}

}  // namespace pellucid::bench
