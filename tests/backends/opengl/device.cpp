// SPDX-License-Identifier: MIT
// The device's edges: threads, debug output, names that OpenGL uses again, passes with few attachments.
#include <pellucid/opengl/opengl.hpp>
#include <thread>
#include "support/gpu.hpp"

namespace pellucid::inline v0_1 {

using test::must;
using test::own;

TEST_CASE("a second thread gets a sentence, and the first goes on", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    std::string said;
    std::thread([&] {
        const auto made = device->make_buffer({.size = 16});
        if (!made) said = made.error().message;
    }).join();
    CHECK(said.find("another thread") != std::string::npos);
    const auto buffer = own(*device, device->make_buffer({.size = 16}));
    CHECK(device->alive(buffer.get()));
}

TEST_CASE("with validation a wrong call of OpenGL is an error in the log", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    device.log->expected = true;
    REQUIRE(device->make_current());
    glEnable(0xDEAD);
    REQUIRE(device.log->messages.size() == 1);
    CHECK(device.log->messages[0].find("OpenGL: ") == 0);
}

TEST_CASE("a texture that gets an old one's OpenGL name gets its own framebuffer", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    for (const std::uint32_t size : {4u, 16u, 8u, 32u}) {
        const auto target = test::make_target(*device, {size, size});
        test::run(*device, [&](opengl::Commands& commands) {
            commands.begin_render({.colors = {{.texture = target, .clear = {1, 0, 0, 1}}}, .size = {size, size}});
            commands.end_render();
        });
        const Image8 picture = test::read<std::uint8_t>(*device, target, {size, size}, 4);
        CHECK(test::rgba(picture, size - 1, size - 1) == 0xFF0000FFu);
    }
}

TEST_CASE("depth alone, without a fragment shader; discarded attachments; no records", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    const auto depth = test::make_depth(*device, {8, 8});
    const auto color = test::make_target(*device, {8, 8});
    rhi::GraphicsPipelineDesc desc;
    desc.vertex = &shaders::test_quad_vert;
    desc.depth = {.format = rhi::Format::d32_float, .test = true, .write = true};
    desc.debug_name = "depth only";
    const auto pipeline = own(*device, device->make_pipeline(desc));
    test::run(*device, [&](opengl::Commands& commands) {
        CHECK(must(commands.upload_records(0, 64)).bytes.empty());
        const test::Quad left[] = {{.rect = {-1, -1, 0, 1}, .depth = {0.25f}}};
        const auto records = test::upload(commands, std::span(left));
        commands.begin_render({.colors = {{.texture = color, .load = rhi::Load::discard, .store = rhi::Store::discard}},
                               .depth = {.texture = depth},
                               .size = {8, 8},
                               .name = "depth"});
        test::draw(commands, pipeline, left, records);
        commands.end_render();
    });
    const ImageF read = test::read<float>(*device, depth, {8, 8}, 1);
    CHECK(*read.texel(1, 4) == 0.25f);
    CHECK(*read.texel(6, 4) == 0.0f);
}

TEST_CASE("a pass without attachments runs its fragments", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    const rhi::GroupLayout layout{.bindings = {{13, rhi::BindingKind::storage_buffer}}};
    rhi::GraphicsPipelineDesc desc;
    desc.vertex = &shaders::test_quad_vert;
    desc.fragment = &shaders::test_count_frag;
    desc.pass_group = layout;
    desc.debug_name = "count";
    const auto pipeline = own(*device, device->make_pipeline(desc));
    constexpr std::uint32_t zeros[4] = {};
    const auto counter = own(*device, device->make_buffer({.size = sizeof zeros,
                                                           .usage = rhi::BufferUsage::storage,
                                                           .memory = rhi::Memory::readback,
                                                           .initial = rhi::bytes_of(zeros)}));
    const auto group =
        own(*device, device->make_group(
                         {.layout = layout, .bindings = {{.binding = 13, .buffer = counter}}, .debug_name = "count"}));
    test::run(*device, [&](opengl::Commands& commands) {
        const test::Quad all[] = {{}};
        const auto records = test::upload(commands, std::span(all));
        commands.begin_render(
            {.uses = {rhi::use(counter.get(), rhi::Access::storage_read_write)}, .size = {12, 5}, .name = "count"});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.bind_group(group);
        commands.draw({.vertex_count = 6, .first_instance = records.first});
        commands.end_render();
    });
    std::uint32_t counted = 0;
    std::memcpy(&counted, device->mapped(counter).data(), sizeof counted);
    CHECK(counted == 60);
}

TEST_CASE("a group that does not fit is refused with its name and the binding", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    const rhi::GroupLayout layout{.bindings = {{13, rhi::BindingKind::storage_buffer}}};
    auto message = [&](const rhi::GroupDesc& desc) {
        const auto made = device->make_group(desc);
        return made ? std::string("was made") : made.error().message;
    };
    CHECK(message({.layout = layout, .debug_name = "g"}) == "The group 'g' fills 0 bindings of a layout of 1");
    CHECK(message({.layout = layout, .bindings = {{.binding = 12}}, .debug_name = "g"}) ==
          "The group 'g' leaves binding 13, a storage buffer, empty");
    CHECK(message({.layout = layout, .bindings = {{.binding = 13}}, .debug_name = "g"}) ==
          "The group 'g' has no living buffer at binding 13");
    CHECK(message({.slot = rhi::GroupSlot::frame, .debug_name = "g"}).find("bind_frame") != std::string::npos);
}

}  // namespace pellucid::inline v0_1
