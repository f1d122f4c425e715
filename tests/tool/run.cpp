// SPDX-License-Identifier: MIT
// Runs of pellucid-render on devices that are made up, which no driver of a test machine stands for.
#include "pellucid_render/run.hpp"
#include <pellucid/renderer/renderer-inl.hpp>
#include <pellucid/rhi/null.hpp>
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include "support/catch.hpp"
#include "support/scene.hpp"

using namespace pellucid;

namespace {

/// The null backend with devices that lack what `lacking` is told to take away.
struct Lacking : Null {
    static inline void (*lacking)(rhi::DeviceInfo&) = nullptr;
    static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc) {
        auto device = Null::create(desc);
        rhi::DeviceInfo info = (*device)->info();
        lacking(info);
        (*device)->pretend(info);
        return device;
    }
};

Scene pane() {
    Scene scene;
    test::add(scene, test::quad(), test::flat({1, 0, 0, 0.5f}, AlphaMode::blend));
    return scene;
}

Result<int> run_with(Transparency method, void (*lacking)(rhi::DeviceInfo&), const std::string& stats = {}) {
    Options options;
    options.settings.size = {16, 16};
    options.settings.transparency = method;
    options.chose_transparency = true;
    options.stats = stats;
    Lacking::lacking = lacking;
    const std::optional<Target> none;  // g++ 13 takes one of its own making for uninitialised
    return run<Lacking>(options, pane(), test::flat_camera(), none);
}

}  // namespace

TEST_CASE("a method that this device cannot run ends the run with status 4, and no other one draws", "[cpu]") {
    const auto no_blending = [](rhi::DeviceInfo& info) { info.float32_blending = false; };
    const auto small = [](rhi::DeviceInfo& info) { info.max_texture_size = 8192; };
    unsigned refused = 0;
    for (const TransparencyTraits& method : all_transparencies) {
        INFO(method.name);
        const auto blended = run_with(method.method, no_blending);
        CHECK(bool(blended) == !method.float32_blending);
        if (!blended) {
            CHECK(exit_status(blended.error().code) == Exit::no_device);
            CHECK(blended.error().message == std::string("the method '") + method.name +
                                                 "' needs blending into 32-bit float targets, and null (null) has "
                                                 "none: choose another method or another device");
        }
        const auto stored = run_with(method.method, small);
        CHECK(bool(stored) == !method.memory_budget);
        if (!stored) {
            CHECK(exit_status(stored.error().code) == Exit::no_device);
            CHECK(stored.error().message == std::string("the method '") + method.name +
                                                "' needs textures of 16384 texels a side, and null (null) has at most "
                                                "8192: choose another method or another device");
        }
        refused += (blended ? 0u : 1u) + (stored ? 0u : 1u);
    }
    CHECK(refused == 6);  // peel, dual-peel and, for both reasons, interleaved and abuffer
}

TEST_CASE("layers that a device cannot count are left out of the statistics", "[cpu]") {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("pellucid_tool_run_" + std::to_string(::getpid()) + ".json");
    const auto written = [&](void (*lacking)(rhi::DeviceInfo&)) {
        CHECK(test::must(run_with(Transparency::sorted, lacking, file.string())) == 0);
        std::ifstream in(file);
        return nlohmann::json::parse(in)["translucency"];
    };
    const auto blind = written([](rhi::DeviceInfo& info) { info.float32_blending = false; });
    CHECK_FALSE(blind.contains("layers"));
    CHECK_FALSE(blind.contains("fragments"));
    CHECK(blind["method"] == "sorted");
    CHECK(written([](rhi::DeviceInfo&) {}).contains("layers"));
    std::filesystem::remove(file);
}
