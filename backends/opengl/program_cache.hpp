// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Compiled programs in one file, so that the next start need not compile them.
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <pellucid/core/log.hpp>
#include <pellucid/opengl/calls.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::inline v0_1::opengl {

/// 128 bits of FNV-1a (two streams): names the sources and constants of a program.
class ProgramKey {
public:
    void add(std::span<const std::byte> bytes);
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
    [[nodiscard]] std::array<std::uint64_t, 2> value() const noexcept { return state_; }

private:
    std::array<std::uint64_t, 2> state_ = {0xCBF29CE484222325u, 0x9E3779B97F4A7C15u};
};

/// File: "PGL1", the driver's identity, then entries (key, binary format, bytes).  A file of another driver, or a
/// broken one, is reported and ignored; it is replaced, by rename, when something new was compiled.
class ProgramCache {
public:
    /// `identity`: renderer and version strings.
    ProgramCache(std::string file, std::string identity, LogSink log);
    /// A linked program from the stored binary; 0 where there is none or the driver refuses it.
    [[nodiscard]] GLuint load(const ProgramKey& key);
    /// Keeps the binary of a linked program, never of one made from SPIR-V: Mesa 22.3 crashes when asked for that.
    void store(const ProgramKey& key, GLuint program);
    /// Writes the file if there is something new.
    void save();

private:
    struct Entry {
        GLenum format = 0;
        std::vector<std::byte> bytes;
    };
    void read();

    std::string file_, identity_;
    LogSink log_;
    std::map<std::array<std::uint64_t, 2>, Entry> entries_;
    bool changed_ = false;
};

}  // namespace pellucid::inline v0_1::opengl
