// SPDX-License-Identifier: MIT
// The file of compiled programs: found again, and harmless when it is damaged.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pellucid/opengl/opengl.hpp>
#include "support/gpu.hpp"

namespace pellucid::inline v0_1 {
namespace {

struct TemporaryFile {
    std::string path =
        (std::filesystem::temp_directory_path() / ("pellucid-programs-" + std::to_string(std::rand()) + ".bin"))
            .string();
    TemporaryFile() { std::filesystem::remove(path); }
    ~TemporaryFile() { std::filesystem::remove(path); }
    std::string read() const {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }
};

/// Draws a white quad with a device that uses `file`.  \returns the middle pixel and what the device said.
std::pair<std::uint32_t, std::vector<std::string>> draw(const TemporaryFile& file, bool spirv = false) {
    auto device = test::make_device<OpenGL>([&](rhi::DeviceDesc& desc) {
        desc.pipeline_cache = file.path;
        desc.gl_spirv = spirv;
        static_cast<test::Log*>(desc.log.user)->expected = true;
    });
    if (!device) return {};
    std::uint32_t pixel = 0;
    {
        const auto target = test::make_target(*device, {8, 8});
        const auto pipeline = test::own(*device, device->make_pipeline(test::quad_desc()));
        const test::Quad white[] = {{}};
        test::draw(*device, {.colors = {{.texture = target}}, .size = {8, 8}}, pipeline, white);
        pixel = test::rgba(test::read<std::uint8_t>(*device, target, {8, 8}, 4), 4, 4);
    }
    device.device.reset();
    return {pixel, device.log->messages};
}

}  // namespace

TEST_CASE("compiled programs are kept in a file, and a damaged file is replaced", "[gpu]") {
    const TemporaryFile file;
    const auto [first, said] = draw(file);
    if (first == 0) return;
    CHECK(first == 0xFFFFFFFFu);
    CHECK(said.empty());
    const std::string stored = file.read();
    if (stored.empty()) {
        WARN("this driver stores no program binaries: nothing more to test");
        return;
    }
    CHECK(stored.substr(0, 4) == "PGL1");
    const auto written = std::filesystem::last_write_time(file.path);
    CHECK(draw(file).first == 0xFFFFFFFFu);
    CHECK(std::filesystem::last_write_time(file.path) == written);  // nothing was compiled, nothing is written

    std::string damaged = stored;
    damaged[stored.size() - 5] = static_cast<char>(damaged[stored.size() - 5] ^ 0x40);
    for (const std::string& bytes :
         {damaged, stored.substr(0, stored.size() / 2), stored.substr(0, 6), std::string("not a cache at all")}) {
        file.write(bytes);
        const auto [pixel, messages] = draw(file);
        CHECK(pixel == 0xFFFFFFFFu);
        REQUIRE(messages.size() == 1);
        CHECK(messages[0].find("is broken") != std::string::npos);
        CHECK(file.read() == stored);
    }

    std::string foreign = stored;
    foreign[10] = static_cast<char>(foreign[10] ^ 1);  // another driver's name
    file.write(foreign);
    const auto [pixel, messages] = draw(file);
    CHECK(pixel == 0xFFFFFFFFu);
    CHECK(messages.empty());
    CHECK(file.read() == stored);
}

TEST_CASE("programs from SPIR-V are never asked for their binary", "[gpu]") {
    const TemporaryFile file;
    const auto [pixel, said] = draw(file, true);
    if (pixel == 0) return;
    CHECK(pixel == 0xFFFFFFFFu);
    CHECK(said.empty());
    CHECK_FALSE(std::filesystem::exists(file.path));
}

TEST_CASE("a cache that cannot be written is a warning", "[gpu]") {
    TemporaryFile file;
    file.path = "/nonexistent-folder/programs.bin";
    const auto [pixel, said] = draw(file);
    if (pixel == 0) return;
    CHECK(pixel == 0xFFFFFFFFu);
    REQUIRE(said.size() <= 1);
    if (!said.empty()) CHECK(said[0].find("/nonexistent-folder/programs.bin") != std::string::npos);
}

}  // namespace pellucid::inline v0_1
