// SPDX-License-Identifier: MIT
// Where a triangle lands: rows from the top, winding and culling, viewport and scissor, topologies, gl_FragCoord.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEMPLATE_LIST_TEST_CASE("NDC y is up and row 0 is the top row", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{8, 4};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    // The top left texel red, the row below it from x = 4 on green: no flip or turn maps this onto itself.
    const test::Quad quads[] = {{.rect = {-1, 0.5f, -0.75f, 1}, .color = {1, 0, 0, 1}},
                                {.rect = {0, 0, 1, 0.5f}, .color = {0, 1, 0, 1}}};
    test::draw(*device, {.colors = {{.texture = target}}, .size = size}, pipeline, quads);
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const std::uint32_t expected = x == 0 && y == 0 ? 0xFF0000FFu : y == 1 && x >= 4 ? 0x00FF00FFu : 0u;
            CHECK(test::rgba(picture, x, y) == expected);
        }
}

TEMPLATE_LIST_TEST_CASE("counter-clockwise faces are front faces, and culling follows", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{4, 2};
    const auto target = test::make_target(*device, size);
    const test::Quad quads[] = {{.rect = {-1, -1, 0, 1}}, {.rect = {1, -1, 0, 1}}};  // left: front; right: back
    const struct {
        Cull cull;
        std::uint32_t left, right;
    } cases[] = {{Cull::none, 0xFF0000FFu, 0x00FF00FFu}, {Cull::back, 0xFF0000FFu, 0}, {Cull::front, 0, 0x00FF00FFu}};
    for (const auto& [cull, left, right] : cases) {
        auto desc = test::quad_desc();
        desc.fragment = &shaders::test_facing_frag;
        desc.cull = cull;
        const auto pipeline = own(*device, device->make_pipeline(desc));
        test::draw(*device, {.colors = {{.texture = target}}, .size = size}, pipeline, quads);
        const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
        CHECK(test::rgba(picture, 0, 0) == left);
        CHECK(test::rgba(picture, 1, 1) == left);
        CHECK(test::rgba(picture, 2, 0) == right);
        CHECK(test::rgba(picture, 3, 1) == right);
    }
}

TEMPLATE_LIST_TEST_CASE("viewport and scissor count from the top left", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{16, 8};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const test::Quad quads[] = {{.color = {1, 0, 0, 1}}, {.color = {0, 0, 1, 1}}};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, quads);
        commands.begin_render({.colors = {{.texture = target}}, .size = size, .name = "clear"});
        commands.end_render();
        // A render area smaller than the texture: its viewport is the area, at the top left.
        commands.begin_render(
            {.colors = {{.texture = target, .load = Load::load}}, .size = {10, 6}, .name = "part of the target"});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.draw({.vertex_count = 6, .first_instance = records.first});
        commands.set_scissor({2, 1, 3, 2});
        commands.draw({.vertex_count = 6, .first_instance = records.first + 1});
        commands.end_render();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const bool inside = x >= 2 && x < 5 && y >= 1 && y < 3;
            const bool area = x < 10 && y < 6;
            INFO("texel " << x << ", " << y);
            CHECK(test::rgba(picture, x, y) == (inside ? 0x0000FFFFu : area ? 0xFF0000FFu : 0u));
        }
}

TEMPLATE_LIST_TEST_CASE("a new pass starts with the whole render area as its scissor", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{4, 4};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const test::Quad quad{};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, std::span(&quad, 1));
        for (int i = 0; i < 2; ++i) {
            commands.begin_render({.colors = {{.texture = target}}, .size = size});
            if (i == 0) commands.set_scissor({0, 0, 1, 1});
            test::draw(commands, pipeline, std::span(&quad, 1), records);
            commands.end_render();
        }
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    CHECK(test::rgba(picture, 0, 0) == 0xFFFFFFFFu);
    CHECK(test::rgba(picture, 3, 3) == 0xFFFFFFFFu);
}

TEMPLATE_LIST_TEST_CASE("gl_FragCoord is the pixel's centre from the top left, with the stored depth", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{5, 4};
    const auto target = test::make_target(*device, size, Format::rgba32_float);
    GraphicsPipelineDesc desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_position_frag;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    test::run(*device, [&](auto& commands) {
        commands.begin_render({.colors = {{.texture = target}}, .size = size});
        commands.bind_pipeline(pipeline);
        commands.draw({.vertex_count = 3});
        commands.end_render();
    });
    const auto picture = test::read<float>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            CHECK(picture.texel(x, y)[0] == static_cast<float>(x) + 0.5f);
            CHECK(picture.texel(x, y)[1] == static_cast<float>(y) + 0.5f);
            CHECK(picture.texel(x, y)[2] == 0.5f);
            CHECK(picture.texel(x, y)[3] == 1.0f);
        }
}

TEMPLATE_LIST_TEST_CASE("rectangles that meet in pixel centres cover each pixel once", "[gpu]",
                        test::ValidatedBackends) {
    // On which side of such a tie a pixel falls may differ between the APIs (Mesa: by one row, because OpenGL's
    // upper-left origin turns its edge rule); that it falls on one side only may not.
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{5, 3};  // x = 0 and y = 0 run through the centres of the middle column and row
    const auto target = test::make_target(*device, size);
    auto desc = test::quad_desc();
    desc.colors[0].blend = {.enabled = true,
                            .src_color = BlendFactor::one,
                            .dst_color = BlendFactor::one,
                            .src_alpha = BlendFactor::one,
                            .dst_alpha = BlendFactor::one};
    const auto pipeline = own(*device, device->make_pipeline(desc));
    const float shade = 10.0f / 255.0f;
    const test::Quad quads[] = {{.rect = {-1, -1, 0, 0}, .color = {shade, 0, 0, 0}},
                                {.rect = {0, -1, 1, 0}, .color = {shade, 0, 0, 0}},
                                {.rect = {-1, 0, 0, 1}, .color = {shade, 0, 0, 0}},
                                {.rect = {0, 0, 1, 1}, .color = {shade, 0, 0, 0}}};
    test::draw(*device, {.colors = {{.texture = target}}, .size = size}, pipeline, quads);
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) CHECK(picture.texel(x, y)[0] == 10);
}

TEMPLATE_LIST_TEST_CASE("topologies: triangles, a strip, lines and points; the first vertex provokes", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{4, 4};
    const auto target = test::make_target(*device, size);
    const GroupLayout layout{.bindings = {{12, BindingKind::storage_buffer}}};
    // Left column bottom to top, then right column: a strip of two triangles over everything.
    const float vertices[][4] = {
        {-1, -1, 0.5f, 1}, {1, -1, 0.5f, 1}, {-1, 1, 0.5f, 1}, {1, 1, 0.5f, 1}, {-0.25f, 0.25f, 0.5f, 1}};
    const auto buffer = own(*device, device->make_buffer({.size = sizeof vertices,
                                                          .initial = std::as_bytes(std::span(vertices)),
                                                          .debug_name = "vertices"}));
    const auto group = own(*device, device->make_group({.layout = layout, .bindings = {{12, buffer.get()}}}));
    auto picture_of = [&](Topology topology, Draw what) {
        GraphicsPipelineDesc desc = test::quad_desc();
        desc.vertex = &shaders::test_points_vert;
        desc.pass_group = layout;
        desc.topology = topology;
        desc.cull = Cull::none;
        const auto pipeline = own(*device, device->make_pipeline(desc));
        test::run(*device, [&](auto& commands) {
            commands.begin_render({.colors = {{.texture = target}},
                                   .uses = {use(buffer.get(), Access::storage_read)},
                                   .size = size,
                                   .name = "topology"});
            commands.bind_pipeline(pipeline);
            commands.bind_group(group);
            commands.draw(what);
            commands.end_render();
        });
        return test::read<std::uint8_t>(*device, target, size, 4);
    };
    const auto triangle = picture_of(Topology::triangles, {.vertex_count = 3});
    CHECK(test::rgba(triangle, 0, 3) == 0x010000FFu);
    CHECK(test::rgba(triangle, 3, 0) == 0u);
    const auto strip = picture_of(Topology::triangle_strip, {.vertex_count = 4});
    CHECK(test::rgba(strip, 0, 3) == 0x010000FFu);
    CHECK(test::rgba(strip, 3, 0) == 0x020000FFu);
    const auto points = picture_of(Topology::points, {.vertex_count = 1, .first_vertex = 4});
    CHECK(test::rgba(points, 1, 1) == 0x050000FFu);
    CHECK(test::rgba(points, 2, 1) == 0u);
    const auto lines = picture_of(Topology::lines, {.vertex_count = 2, .first_vertex = 1});  // the other diagonal
    CHECK(test::rgba(lines, 1, 1) == 0x020000FFu);
    CHECK(test::rgba(lines, 0, 3) == 0u);
}
