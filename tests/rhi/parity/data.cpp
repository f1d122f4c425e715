// SPDX-License-Identifier: MIT
// How numbers reach shaders: push data, records by base instance, specialisation constants, frame uniforms, indices.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEMPLATE_LIST_TEST_CASE("push data: all 128 bytes arrive, and stay bound within a pass", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{2, 1};
    const auto target = test::make_target(*device, size, Format::rgba32_float);
    auto desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_push_frag;
    desc.push_bytes = 128;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    float parts[8][4] = {};
    for (int i = 0; i < 8; ++i)
        for (int c = 0; c < 4; ++c) parts[i][c] = static_cast<float>(1 << i) * static_cast<float>(c + 1);
    float twice[8][4] = {};
    twice[7][3] = 3;
    test::run(*device, [&](auto& commands) {
        commands.begin_render({.colors = {{.texture = target}}, .size = size});
        commands.bind_pipeline(pipeline);
        commands.push(bytes_of(parts));
        commands.draw({.vertex_count = 3});
        commands.set_scissor({1, 0, 1, 1});
        commands.push(bytes_of(twice));
        commands.draw({.vertex_count = 3});
        commands.draw({.vertex_count = 3});
        commands.end_render();
    });
    const auto picture = test::read<float>(*device, target, size, 4);
    for (int c = 0; c < 4; ++c) {
        CHECK(picture.texel(0, 0)[c] == 255.0f * static_cast<float>(c + 1));
        CHECK(picture.texel(1, 0)[c] == (c == 3 ? 3.0f : 0.0f));
    }
}

TEMPLATE_LIST_TEST_CASE("records are found by base instance, in plain, indexed and instanced draws", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{8, 1};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    std::vector<test::Quad> quads;
    for (int i = 0; i < 8; ++i) {
        const float x = static_cast<float>(i) / 4.0f - 1.0f;
        quads.push_back({.rect = {x, -1, x + 0.25f, 1}, .color = {static_cast<float>(i + 1) / 255.0f, 0, 0, 1}});
    }
    const std::uint32_t numbers[] = {99, 7, 8, 9, 10, 11, 12};  // vertex_offset -7, first_index 1: vertices 0 … 5
    const auto indices = own(*device, device->make_buffer({.size = sizeof numbers,
                                                           .usage = BufferUsage::index,
                                                           .initial = std::as_bytes(std::span(numbers)),
                                                           .debug_name = "indices"}));
    test::run(*device, [&](auto& commands) {
        // An earlier slice of the frame, so that `first` is not zero.
        (void)test::must(commands.upload_records(5, 16));
        const auto records = test::upload(commands, quads);
        commands.begin_render({.colors = {{.texture = target}},
                               .uses = {use(indices.get(), Access::index_read)},
                               .size = size,
                               .name = "records"});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.bind_index_buffer(indices);
        commands.draw({.vertex_count = 6, .first_instance = records.first + 1});
        commands.draw({.vertex_count = 6, .instance_count = 2, .first_instance = records.first + 2});
        commands.draw_indexed(
            {.index_count = 6, .first_index = 1, .vertex_offset = -7, .first_instance = records.first + 4});
        commands.draw_indexed({.index_count = 6,
                               .instance_count = 3,
                               .first_index = 1,
                               .vertex_offset = -7,
                               .first_instance = records.first + 5});
        commands.draw({.vertex_count = 6, .first_instance = records.first});
        commands.end_render();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t x = 0; x < 8; ++x) CHECK(test::rgba(picture, x, 0) == ((x + 1) << 24 | 0xFFu));
}

TEMPLATE_LIST_TEST_CASE("two slices of records in one frame are both readable", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{2, 1};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const test::Quad left[] = {{.rect = {-1, -1, 0, 1}, .color = {1, 0, 0, 1}}};
    const test::Quad right[] = {{.rect = {0, -1, 1, 1}, .color = {0, 0, 1, 1}}};
    test::run(*device, [&](auto& commands) {
        const auto first = test::upload(commands, left);
        const auto second = test::upload(commands, right);
        commands.begin_render({.colors = {{.texture = target}}, .size = size});
        test::draw(commands, pipeline, left, first);
        commands.bind_frame({}, second);
        commands.draw({.vertex_count = 6, .first_instance = second.first});
        commands.end_render();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    CHECK(test::rgba(picture, 0, 0) == 0xFF0000FFu);
    CHECK(test::rgba(picture, 1, 0) == 0x0000FFFFu);
}

TEMPLATE_LIST_TEST_CASE("specialisation constants are found by number, in any order", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto target = test::make_target(*device, {1, 1});
    auto draw_with = [&](std::span<const SpecConstant> constants) {
        auto desc = test::quad_desc();
        desc.vertex = &shaders::test_fullscreen_vert;
        desc.fragment = &shaders::test_spec_frag;
        desc.constants = constants;
        const auto pipeline = own(*device, device->make_pipeline(desc));
        test::run(*device, [&](auto& commands) {
            commands.begin_render({.colors = {{.texture = target}}, .size = {1, 1}});
            commands.bind_pipeline(pipeline);
            commands.draw({.vertex_count = 3});
            commands.end_render();
        });
        return test::rgba(test::read<std::uint8_t>(*device, target, {1, 1}, 4), 0, 0);
    };
    const SpecConstant both[] = {{0, 5}, {7, 200}};
    const SpecConstant other[] = {{7, 9}, {0, 4}};
    const std::uint32_t first = draw_with(both);
    CHECK(first == 0x05C801FFu);
    const std::uint32_t second = draw_with(other);
    CHECK(second == 0x040900FFu);
}

TEMPLATE_LIST_TEST_CASE("frame uniforms: more than a megabyte in a frame, over many frames", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t slices = 96;  // of 16 KiB: 1.5 MiB a frame
    constexpr Extent2D size{slices, 1};
    const auto target = test::make_target(*device, size, Format::rgba32_float);
    auto desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_frame_frag;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    std::vector<float> bytes(4096);
    for (int frame = 0; frame < 6; ++frame) {
        test::run(*device, [&](auto& commands) {
            commands.begin_render({.colors = {{.texture = target}}, .size = size});
            commands.bind_pipeline(pipeline);
            for (std::uint32_t i = 0; i < slices; ++i) {
                bytes[0] = static_cast<float>(frame);
                bytes[1] = static_cast<float>(i);
                const auto slice = test::must(commands.upload_uniforms(std::as_bytes(std::span(bytes))));
                commands.bind_frame(slice, {});
                commands.set_scissor({i, 0, 1, 1});
                commands.draw({.vertex_count = 3});
            }
            commands.end_render();
        });
        const auto picture = test::read<float>(*device, target, size, 4);
        std::uint32_t wrong = 0;
        for (std::uint32_t i = 0; i < slices; ++i)
            wrong +=
                picture.texel(i, 0)[0] != static_cast<float>(frame) || picture.texel(i, 0)[1] != static_cast<float>(i);
        CHECK(wrong == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("frames in flight do not overwrite each other's data", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>([](DeviceDesc& desc) { desc.frames_in_flight = 3; });
    if (!device) return;
    constexpr std::uint32_t frames = 12;
    constexpr Extent2D size{frames, 1};
    const auto target = test::make_target(*device, size, Format::rgba32_float);
    auto desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_frame_frag;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    Ticket last{};
    for (std::uint32_t i = 0; i < frames; ++i) {  // no waiting in between
        auto* commands = test::must(device->begin_frame());
        const float color[4] = {static_cast<float>(i), 1, 2, 3};
        const auto slice = test::must(commands->upload_uniforms(bytes_of(color)));
        commands->begin_render({.colors = {{.texture = target, .load = i == 0 ? Load::clear : Load::load}},
                                .size = size,
                                .name = "frame"});
        commands->bind_pipeline(pipeline);
        commands->bind_frame(slice, {});
        commands->set_scissor({i, 0, 1, 1});
        commands->draw({.vertex_count = 3});
        commands->end_render();
        const Ticket ticket = test::must(device->submit());
        CHECK(static_cast<std::uint64_t>(ticket) > static_cast<std::uint64_t>(last));
        last = ticket;
    }
    test::must(device->wait(last));
    CHECK(device->done(last));
    CHECK(device->done(Ticket::none));
    const auto picture = test::read<float>(*device, target, size, 4);
    for (std::uint32_t i = 0; i < frames; ++i) CHECK(picture.texel(i, 0)[0] == static_cast<float>(i));
}
