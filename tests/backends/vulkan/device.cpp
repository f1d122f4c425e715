// SPDX-License-Identifier: MIT
// The device as such: how it is chosen, what it counts, what it keeps in its cache file.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEST_CASE("a device is chosen by its index or a part of its name", "[gpu]") {
    const auto listed = Vulkan::list();
    if (listed.empty()) return test::skip("vulkan: no device", "PELLUCID_REQUIRE_DEVICES");
    for (std::size_t i = 0; i < listed.size(); ++i) {
        if (!listed[i].missing.empty()) continue;
        const auto by_index = Vulkan::create({.device = std::to_string(i)});
        REQUIRE(by_index);
        CHECK((*by_index)->info().name == listed[i].name);
        std::string part = listed[i].name.substr(0, 4);
        for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        CHECK(Vulkan::create({.device = part}));
    }
    const auto beyond = Vulkan::create({.device = std::to_string(listed.size())});
    REQUIRE_FALSE(beyond);
    CHECK(beyond.error().code == Errc::no_device);
    CHECK(beyond.error().message.find(listed[0].name) != std::string::npos);
    const auto frames = Vulkan::create({.frames_in_flight = 5});
    REQUIRE_FALSE(frames);
    CHECK(frames.error().code == Errc::invalid_argument);
}

TEST_CASE("validation without its layer is refused, with the package that has it", "[gpu]") {
    if (Vulkan::list().empty()) return test::skip("vulkan: no device", "PELLUCID_REQUIRE_DEVICES");
    setenv("VK_LAYER_PATH", "/nonexistent", 1);
    const auto made = Vulkan::create({.validation = true});
    unsetenv("VK_LAYER_PATH");
    REQUIRE_FALSE(made);
    CHECK(made.error().code == Errc::unsupported);
    CHECK(made.error().message.find("vulkan-validationlayers") != std::string::npos);
}

TEST_CASE("features that are missing are named", "[cpu]") {
    vulkan::Features had, wanted;
    const std::string all = vulkan::choose_features(had, wanted);
    for (const char* feature : {"geometryShader", "dynamicRendering", "shaderDrawParameters", "hostQueryReset"})
        CHECK(all.find(feature) != std::string::npos);
    CHECK(wanted.core.features.geometryShader);
    vulkan::Features complete;
    complete.core.features = wanted.core.features;
    complete.v11.shaderDrawParameters = complete.v12.hostQueryReset = VK_TRUE;
    complete.v13.dynamicRendering = complete.v13.synchronization2 = complete.v13.maintenance4 = VK_TRUE;
    complete.v13.robustImageAccess = VK_TRUE;
    CHECK(vulkan::choose_features(complete, wanted).empty());
    complete.v13.maintenance4 = VK_FALSE;
    CHECK(vulkan::choose_features(complete, wanted) == "the features maintenance4");
    CHECK_FALSE(wanted.core.features.shaderInt64);
}

TEST_CASE("API calls are counted exactly", "[gpu]") {
    const auto device = test::make_device<Vulkan>([](DeviceDesc& desc) { desc.count_api_calls = true; });
    if (!device) return;
    constexpr Extent2D size{4, 4};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const std::vector<test::Quad> quads(10);
    const auto frame = [&](std::uint32_t draws) {
        const std::uint64_t before = device->api_calls();
        test::run(*device, [&](auto& commands) {
            const auto records = test::upload(commands, quads);
            commands.begin_render({.colors = {{.texture = target}}, .size = size});
            commands.bind_pipeline(pipeline);
            commands.bind_frame({}, records);
            for (std::uint32_t i = 0; i < draws; ++i) {
                commands.bind_pipeline(pipeline);  // bound already: no call
                commands.draw({.vertex_count = 6, .first_instance = records.first + i});
            }
            commands.end_render();
        });
        return device->api_calls() - before;
    };
    (void)frame(1);
    const std::uint64_t one = frame(1);
    CHECK(frame(10) == one + 9);
    // reset pool, begin, label, barrier, begin rendering, viewport, scissor, pipeline, group, draw, end rendering,
    // label, end, reset fence, submit, wait
    CHECK(one == 16);
}

TEST_CASE("four devices can be counted at once, and a fifth is refused", "[gpu]") {
    if (Vulkan::list().empty()) return test::skip("vulkan: no device", "PELLUCID_REQUIRE_DEVICES");
    std::vector<std::unique_ptr<vulkan::Device>> devices;
    for (int i = 0; i < vulkan::max_counted_devices; ++i)
        devices.push_back(test::must(Vulkan::create({.count_api_calls = true})));
    const std::uint64_t other = devices[1]->api_calls();
    (void)test::must(devices[0]->begin_frame());
    CHECK(devices[1]->api_calls() == other);
    CHECK(Vulkan::create({.count_api_calls = true}).error().code == Errc::unsupported);
    devices.pop_back();
    CHECK(Vulkan::create({.count_api_calls = true}));
    CHECK(test::must(Vulkan::create({}))->api_calls() == 0);
}

TEST_CASE("memory goes back: blocks of what is destroyed serve what is made", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    test::run(*device, [](auto&) {});
    const std::uint64_t held = device->memory_held(), used = device->memory_used();
    for (int round = 0; round < 20; ++round) {
        const auto large = own(*device, device->make_buffer({.size = 100u << 20u, .debug_name = "large"}));
        CHECK(device->memory_used() >= used + (100u << 20u));
        test::run(*device, [](auto&) {});
    }
    CHECK(device->memory_held() == held);
    CHECK(device->memory_used() == used);
    // Content larger than both pieces of staging memory.
    const std::vector<std::byte> content(40u << 20u, std::byte{7});
    const auto filled = own(
        *device,
        device->make_buffer(
            {.size = content.size(), .usage = BufferUsage::copy_source, .initial = content, .debug_name = "filled"}));
    test::run(*device, [](auto&) {});
    CHECK(device->memory_used() < used + content.size() + (17u << 20u));
    CHECK(test::read<std::uint32_t>(*device, filled.get(), 10u << 20u) ==
          std::vector<std::uint32_t>(10u << 20u, 0x07070707u));
}

TEST_CASE("the pipeline cache is written, read again, and ignored when it is broken or another's", "[gpu]") {
    if (Vulkan::list().empty()) return test::skip("vulkan: no device", "PELLUCID_REQUIRE_DEVICES");
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("pellucid_cache_" + std::to_string(std::rand()));
    fs::remove_all(folder);  // of an earlier run that failed
    fs::create_directory(folder);
    const std::string file = (folder / "pipelines").string();
    const auto use_it = [&](bool make_pipeline) {
        auto device = test::make_device<Vulkan>([&](DeviceDesc& desc) { desc.pipeline_cache = file; });
        device.log->expected = true;
        const std::vector<std::string> at_start = device.log->messages;
        if (make_pipeline) (void)own(*device, device->make_pipeline(test::quad_desc()));
        return at_start;
    };
    const auto bytes = [&] {
        std::ifstream in(file, std::ios::binary);
        return std::vector<char>(std::istreambuf_iterator<char>(in), {});
    };
    const auto write = [&](const std::vector<char>& data) {
        std::ofstream(file, std::ios::binary | std::ios::trunc)
            .write(data.data(), static_cast<std::streamsize>(data.size()));
    };
    const auto ignored = [&](const char* why) {
        test::Log log;
        log.expected = true;
        DeviceDesc desc = log.desc();
        desc.pipeline_cache = file;
        { const auto device = test::must(Vulkan::create(desc)); }
        REQUIRE(log.messages.size() == 1);
        INFO(log.messages[0]);
        CHECK(log.messages[0].find(why) != std::string::npos);
        CHECK(log.messages[0].find(file) != std::string::npos);
    };
    CHECK(use_it(false).empty());
    CHECK_FALSE(fs::exists(file));  // nothing was made
    CHECK(use_it(true).empty());
    const std::vector<char> good = bytes();
    REQUIRE(good.size() >= 24 + 32);
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);  // no partial file stays
    CHECK(use_it(true).empty());
    std::vector<char> bad = good;
    bad.back() = static_cast<char>(bad.back() ^ 1);
    write(bad);
    ignored("damaged");
    bad = good;
    bad.pop_back();
    write(bad);
    ignored("damaged");
    write({'n', 'o'});
    ignored("no pipeline cache");
    fs::remove(file);
    CHECK(use_it(true).empty());
    CHECK(fs::exists(file));
    fs::remove_all(folder);
}
