// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// glTF files made by tests: a small valid document to spoil, bytes for its buffer, a folder that goes away.
#include <pellucid/scene/gltf.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>
#include "support/catch.hpp"

namespace pellucid::test {

/// A folder of its own under the system's temporary one, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::random_device seed;
        do {
            path_ = std::filesystem::temp_directory_path() / ("pellucid-" + std::to_string(seed()));
        } while (!std::filesystem::create_directory(path_));
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

inline void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), std::data(values), bytes.size());
    return bytes;
}

/// Chunks of a .glb; `text` is padded with spaces, `bin` with zeros.
inline std::string make_glb(std::string text, std::string bin) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t value) { return bytes_of({static_cast<std::uint32_t>(value)}); };
    std::string glb = word(0x46546C67u) + word(2) + word(20 + text.size() + (bin.empty() ? 0 : 8 + bin.size()));
    glb += word(text.size()) + word(0x4E4F534Au) + text;
    if (!bin.empty()) glb += word(bin.size()) + word(0x004E4942u) + bin;
    return glb;
}

/// One triangle with indices: 36 bytes of positions, 6 of indices, 2 of padding.
inline std::string triangle_bin() {
    return bytes_of({0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) + bytes_of<std::uint16_t>({0, 1, 2, 0});
}
/// The document of `triangle_bin`, valid.
inline const std::string triangle_json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"byteOffset":0,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":44}]})";

/// `text` with the first `from` replaced; the test fails where it is not there.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// Loads a .glb made of the two parts.
inline Result<Scene> load_parts(const std::string& json, const std::string& bin = triangle_bin(),
                                const GltfLimits& limits = {}) {
    const TemporaryFolder folder;
    write_bytes(folder / "test.glb", make_glb(json, bin));
    return load_gltf(folder / "test.glb", limits);
}

/// What the loader says against it, without the file's name; empty where it loads.
inline std::string refusal(const std::string& json, const std::string& bin = triangle_bin(),
                           const GltfLimits& limits = {}) {
    const auto scene = load_parts(json, bin, limits);
    if (scene) return {};
    const std::size_t name = scene.error().message.find("test.glb: ");
    REQUIRE(name != std::string::npos);
    return scene.error().message.substr(name + 10);
}

}  // namespace pellucid::test
