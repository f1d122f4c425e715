// SPDX-License-Identifier: MIT
// Storage images, indirect work, and the order of passes: each pass sees what the passes before it wrote, because both
// declare their uses.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEMPLATE_LIST_TEST_CASE("storage images are written, then sampled by a render pass", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{16, 8};
    const auto image =
        own(*device,
            device->make_texture({.size = size,
                                  .format = Format::rgba16_float,
                                  .usage = TextureUsage::storage | TextureUsage::sampled | TextureUsage::copy_source,
                                  .debug_name = "image"}));
    const auto target = test::make_target(*device, size, Format::rgba32_float);
    const GroupLayout writes{.bindings = {{0, BindingKind::storage_texture}}};
    const GroupLayout reads{.bindings = {{12, BindingKind::sampled_texture}}};
    const auto write = own(*device, device->make_pipeline(ComputePipelineDesc{
                                        .compute = &shaders::test_image_write_comp, .pass_group = writes}));
    auto desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.pass_group = reads;
    const auto fetch = own(*device, device->make_pipeline(desc));
    const auto sampler = own(*device, device->make_sampler({}));
    const auto image_group =
        own(*device, device->make_group({.layout = writes, .bindings = {{.binding = 0, .texture = image}}}));
    const auto texture_group =
        own(*device,
            device->make_group({.layout = reads, .bindings = {{.binding = 12, .texture = image, .sampler = sampler}}}));
    test::run(*device, [&](auto& commands) {
        commands.begin_compute({.uses = {use(image.get(), Access::storage_write)}, .name = "write"});
        commands.bind_pipeline(write);
        commands.bind_group(image_group);
        commands.dispatch(2, 1, 1);
        commands.end_compute();
        commands.begin_render({.colors = {{.texture = target}},
                               .uses = {use(image.get(), Access::sampled)},
                               .size = size,
                               .name = "read"});
        commands.bind_pipeline(fetch);
        commands.bind_group(texture_group);
        commands.draw({.vertex_count = 3});
        commands.end_render();
    });
    const auto picture = test::read<float>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            CHECK(picture.texel(x, y)[0] == static_cast<float>(x) / 8.0f);
            CHECK(picture.texel(x, y)[1] == static_cast<float>(y) / 8.0f);
            CHECK(picture.texel(x, y)[2] == 0.03125f);
        }
}

TEMPLATE_LIST_TEST_CASE("a chain of dispatches on one image sees each other's writes", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{8, 8};
    // Level 1 of two is bound: the other stays as it was.
    const std::vector<std::uint32_t> zeros(16 * 16 + 8 * 8, 5);
    const auto image = own(*device, device->make_texture({.size = {16, 16},
                                                          .mips = 2,
                                                          .format = Format::r32_uint,
                                                          .usage = TextureUsage::storage | TextureUsage::copy_source,
                                                          .initial = std::as_bytes(std::span(zeros)),
                                                          .debug_name = "image"}));
    const GroupLayout layout{.bindings = {{1, BindingKind::storage_texture}}};
    const auto pipeline =
        own(*device, device->make_pipeline(ComputePipelineDesc{
                         .compute = &shaders::test_image_add_comp, .pass_group = layout, .push_bytes = 16}));
    const auto group =
        own(*device, device->make_group({.layout = layout, .bindings = {{.binding = 1, .texture = image, .mip = 1}}}));
    test::run(*device, [&](auto& commands) {
        for (std::uint32_t i = 1; i <= 10; ++i) {
            commands.begin_compute({.uses = {use(image.get(), Access::storage_read_write)}, .name = "add"});
            commands.bind_pipeline(pipeline);
            commands.bind_group(group);
            const std::uint32_t amount[4] = {i, 0, 0, 0};
            commands.push(bytes_of(amount));
            commands.dispatch(1, 1, 1);
            commands.end_compute();
        }
    });
    const auto found = test::read<std::uint32_t>(*device, image, size, 1, 1);
    for (std::uint32_t i = 0; i < 64; ++i) CHECK(found.data[i] == 5 + 55 + 10 * i);
    for (const auto value : test::read<std::uint32_t>(*device, image, {16, 16}, 1).data) CHECK(value == 5);
}

TEMPLATE_LIST_TEST_CASE("indirect draws and dispatches read what a dispatch wrote", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{2, 1};
    const auto target = test::make_target(*device, size);
    const GroupLayout layout{.bindings = {{12, BindingKind::storage_buffer}}};
    const auto arguments = own(
        *device, device->make_buffer(
                     {.size = 64, .usage = BufferUsage::storage | BufferUsage::indirect, .debug_name = "arguments"}));
    const auto write =
        own(*device, device->make_pipeline(ComputePipelineDesc{
                         .compute = &shaders::test_arguments_comp, .pass_group = layout, .push_bytes = 16}));
    const auto group = own(*device, device->make_group({.layout = layout, .bindings = {{12, arguments.get()}}}));
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const std::uint32_t numbers[] = {0, 1, 2, 3, 4, 5};
    const auto indices = own(*device, device->make_buffer({.size = sizeof numbers,
                                                           .usage = BufferUsage::index,
                                                           .initial = std::as_bytes(std::span(numbers))}));
    // The indirect dispatch: two groups of 64 scale 100 values.
    const GroupLayout scale_layout{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
    const auto scale =
        own(*device, device->make_pipeline(ComputePipelineDesc{
                         .compute = &shaders::test_scale_comp, .pass_group = scale_layout, .push_bytes = 16}));
    const std::uint32_t factor[4] = {2, 0, 0, 0};
    const auto uniforms = own(
        *device,
        device->make_buffer({.size = 16, .usage = BufferUsage::uniform, .initial = std::as_bytes(std::span(factor))}));
    const std::vector<std::uint32_t> ones(100, 1);
    const auto values = own(*device, device->make_buffer({.size = 400,
                                                          .usage = BufferUsage::storage | BufferUsage::copy_source,
                                                          .initial = std::as_bytes(std::span(ones))}));
    const auto scale_group = own(
        *device, device->make_group({.layout = scale_layout, .bindings = {{12, uniforms.get()}, {13, values.get()}}}));
    const test::Quad quads[] = {{.rect = {-1, -1, 0, 1}, .color = {1, 0, 0, 1}},
                                {.rect = {0, -1, 1, 1}, .color = {0, 0, 1, 1}}};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, quads);
        commands.begin_compute({.uses = {use(arguments.get(), Access::storage_write)}, .name = "arguments"});
        commands.bind_pipeline(write);
        commands.bind_group(group);
        const std::uint32_t first[4] = {records.first, 0, 0, 0};
        commands.push(bytes_of(first));
        commands.dispatch(1, 1, 1);
        commands.end_compute();
        commands.begin_render(
            {.colors = {{.texture = target}},
             .uses = {use(arguments.get(), Access::indirect_read), use(indices.get(), Access::index_read)},
             .size = size,
             .name = "indirect"});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.bind_index_buffer(indices);
        commands.draw_indexed_indirect(arguments, 0, 2);
        commands.end_render();
        commands.begin_compute(
            {.uses = {use(arguments.get(), Access::indirect_read), use(uniforms.get(), Access::uniform_read),
                      use(values.get(), Access::storage_read_write)},
             .name = "indirect dispatch"});
        commands.bind_pipeline(scale);
        commands.bind_group(scale_group);
        const std::uint32_t push[4] = {7, 100, 0, 0};
        commands.push(bytes_of(push));
        commands.dispatch_indirect(arguments, 40);
        commands.end_compute();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    CHECK(test::rgba(picture, 0, 0) == 0xFF0000FFu);
    CHECK(test::rgba(picture, 1, 0) == 0x0000FFFFu);
    for (const auto value : test::read<std::uint32_t>(*device, values.get(), 100)) CHECK(value == 9);
}

TEMPLATE_LIST_TEST_CASE("a vertex stage reads vertices that a dispatch wrote", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{4, 2};
    const auto target = test::make_target(*device, size);
    const GroupLayout layout{.bindings = {{12, BindingKind::storage_buffer}}};
    const auto vertices = own(*device, device->make_buffer({.size = 96, .debug_name = "vertices"}));
    const auto group = own(*device, device->make_group({.layout = layout, .bindings = {{12, vertices.get()}}}));
    const auto write =
        own(*device,
            device->make_pipeline(ComputePipelineDesc{.compute = &shaders::test_vertices_comp, .pass_group = layout}));
    auto desc = test::quad_desc();
    desc.vertex = &shaders::test_points_vert;
    desc.pass_group = layout;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    test::run(*device, [&](auto& commands) {
        commands.begin_compute({.uses = {use(vertices.get(), Access::storage_write)}, .name = "vertices"});
        commands.bind_pipeline(write);
        commands.bind_group(group);
        commands.dispatch(1, 1, 1);
        commands.end_compute();
        commands.begin_render({.colors = {{.texture = target}},
                               .uses = {use(vertices.get(), Access::storage_read)},
                               .size = size,
                               .name = "triangles"});
        commands.bind_pipeline(pipeline);
        commands.bind_group(group);
        commands.draw({.vertex_count = 6});
        commands.end_render();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t x = 0; x < 4; ++x) CHECK((test::rgba(picture, x, 0) != 0) == (x < 2));
}

TEMPLATE_LIST_TEST_CASE("a dispatch sees what fragments counted, and a second pass goes on from it", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{10, 7};
    const auto target = test::make_target(*device, size);
    const auto depth = test::make_depth(*device, size);  // drivers may drop hidden side effects where there is none
    const GroupLayout counts{.bindings = {{13, BindingKind::storage_buffer}}};
    const GroupLayout scales{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
    auto desc = test::quad_desc();
    desc.fragment = &shaders::test_count_frag;
    desc.pass_group = counts;
    desc.depth = {.format = Format::d32_float};
    const auto count = own(*device, device->make_pipeline(desc));
    const auto scale = own(*device, device->make_pipeline(ComputePipelineDesc{
                                        .compute = &shaders::test_scale_comp, .pass_group = scales, .push_bytes = 16}));
    const std::uint32_t zero[4] = {};
    const auto counter = own(*device, device->make_buffer({.size = 16,
                                                           .usage = BufferUsage::storage | BufferUsage::copy_source,
                                                           .initial = bytes_of(zero),
                                                           .debug_name = "counter"}));
    const std::uint32_t factor[4] = {10, 0, 0, 0};
    const auto uniforms =
        own(*device, device->make_buffer({.size = 16, .usage = BufferUsage::uniform, .initial = bytes_of(factor)}));
    const auto count_group = own(*device, device->make_group({.layout = counts, .bindings = {{13, counter.get()}}}));
    const auto scale_group =
        own(*device, device->make_group({.layout = scales, .bindings = {{12, uniforms.get()}, {13, counter.get()}}}));
    const test::Quad quads[] = {{}, {}, {}};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, quads);
        for (int i = 0; i < 2; ++i) {
            commands.begin_render({.colors = {{.texture = target}},
                                   .depth = {.texture = depth},
                                   .uses = {use(counter.get(), Access::storage_read_write)},
                                   .size = size,
                                   .name = "count"});
            commands.bind_pipeline(count);
            commands.bind_group(count_group);
            commands.bind_frame({}, records);
            for (std::uint32_t q = 0; q < 3; ++q)
                commands.draw({.vertex_count = 6, .first_instance = records.first + q});
            commands.end_render();
            commands.begin_compute(
                {.uses = {use(uniforms.get(), Access::uniform_read), use(counter.get(), Access::storage_read_write)},
                 .name = "scale"});
            commands.bind_pipeline(scale);
            commands.bind_group(scale_group);
            const std::uint32_t push[4] = {1, 1, 0, 0};
            commands.push(bytes_of(push));
            commands.dispatch(1, 1, 1);
            commands.end_compute();
        }
    });
    // (0 + 210)·10 + 1 = 2101; (2101 + 210)·10 + 1 = 23111
    CHECK(test::read<std::uint32_t>(*device, counter.get(), 1)[0] == 23111);
}

TEMPLATE_LIST_TEST_CASE("a target becomes a texture, then a target again", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{4, 4};
    auto make = [&](const char* name) {
        return own(*device, device->make_texture(
                                {.size = size,
                                 .format = Format::rgba32_float,
                                 .usage = TextureUsage::attachment | TextureUsage::sampled | TextureUsage::copy_source,
                                 .debug_name = name}));
    };
    const auto a = make("a");
    const auto b = make("b");
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}}};
    auto desc = test::quad_desc(Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.pass_group = layout;
    desc.colors[0].blend = {.enabled = true,
                            .src_color = BlendFactor::one,
                            .dst_color = BlendFactor::one,
                            .src_alpha = BlendFactor::one,
                            .dst_alpha = BlendFactor::one};
    const auto add = own(*device, device->make_pipeline(desc));
    const auto sampler = own(*device, device->make_sampler({.min = Filter::nearest, .mag = Filter::nearest}));
    const auto from_a =
        own(*device,
            device->make_group({.layout = layout, .bindings = {{.binding = 12, .texture = a, .sampler = sampler}}}));
    const auto from_b =
        own(*device,
            device->make_group({.layout = layout, .bindings = {{.binding = 12, .texture = b, .sampler = sampler}}}));
    test::run(*device, [&](auto& commands) {
        commands.begin_render({.colors = {{.texture = a, .clear = {1, 0, 0, 0}}}, .size = size, .name = "clear a"});
        commands.end_render();
        commands.begin_render({.colors = {{.texture = b, .clear = {1, 0, 0, 0}}}, .size = size, .name = "clear b"});
        commands.end_render();
        for (int i = 0; i < 10; ++i) {  // Fibonacci: a += b, b += a
            const bool even = i % 2 == 0;
            commands.begin_render({.colors = {{.texture = even ? a : b, .load = Load::load}},
                                   .uses = {use(even ? b.get() : a.get(), Access::sampled)},
                                   .size = size,
                                   .name = "add"});
            commands.bind_pipeline(add);
            commands.bind_group(even ? from_b : from_a);
            commands.draw({.vertex_count = 3});
            commands.end_render();
        }
    });
    for (std::uint32_t i = 0; i < 4; ++i) {
        CHECK(test::read<float>(*device, a, size, 4).texel(i, i)[0] == 89.0f);
        CHECK(test::read<float>(*device, b, size, 4).texel(i, i)[0] == 144.0f);
    }
}
