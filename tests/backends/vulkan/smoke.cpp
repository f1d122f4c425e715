// SPDX-License-Identifier: MIT
// One frame of everything, through the concepts and beside them through Vulkan itself, validated.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEST_CASE("one frame clears, draws by records, pushes, dispatches, samples and reads back", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    constexpr Extent2D size{8, 8};
    const auto image = own(
        *device, device->make_texture(
                     {.size = size, .usage = TextureUsage::attachment | TextureUsage::sampled, .debug_name = "image"}));
    const auto target = test::make_target(*device, size);
    const auto depth = test::make_depth(*device, size);
    const auto sampler = own(*device, device->make_sampler({.min = Filter::nearest, .mag = Filter::nearest}));
    const auto values = own(*device, device->make_buffer({.size = 256,
                                                          .usage = BufferUsage::storage | BufferUsage::copy_source |
                                                                   BufferUsage::copy_destination,
                                                          .debug_name = "values"}));
    const std::uint32_t factor[4] = {3, 0, 0, 0};
    const auto uniforms = own(
        *device, device->make_buffer(
                     {.size = 16, .usage = BufferUsage::uniform, .initial = bytes_of(factor), .debug_name = "factor"}));
    const GroupLayout buffers{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
    const GroupLayout textures{.bindings = {{12, BindingKind::sampled_texture}}};
    const auto scale_group =
        own(*device, device->make_group({.layout = buffers, .bindings = {{12, uniforms.get()}, {13, values.get()}}}));
    const auto fetch_group = own(
        *device,
        device->make_group({.layout = textures, .bindings = {{.binding = 12, .texture = image, .sampler = sampler}}}));
    const auto scale =
        own(*device,
            device->make_pipeline(ComputePipelineDesc{
                .compute = &shaders::test_scale_comp, .pass_group = buffers, .push_bytes = 16, .debug_name = "scale"}));
    const auto quads = own(*device, device->make_pipeline(test::quad_desc()));
    auto desc = test::quad_desc();
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.pass_group = textures;
    desc.depth = {.format = Format::d32_float, .test = true, .write = true};
    desc.debug_name = "fetch";
    const auto fetch = own(*device, device->make_pipeline(desc));
    const auto result = own(
        *device,
        device->make_buffer(
            {.size = 512, .usage = BufferUsage::copy_destination, .memory = Memory::readback, .debug_name = "result"}));

    for (int frame = 0; frame < 3; ++frame) {
        auto* commands = test::must(device->begin_frame());
        CHECK(commands->native() != VK_NULL_HANDLE);
        const test::Quad left{.rect = {-1, -1, 0, 1}, .color = {1, 0, 0, 1}};
        const test::Quad top{.rect = {-1, 0, 1, 1}, .color = {0, 1, 0, 1}};
        const test::Quad both[] = {left, top};
        (void)test::must(commands->upload_records(1, 256));  // the records do not start at 0
        const auto records = test::upload(*commands, both);
        CHECK(records.first == 4);
        commands->begin_copy({.uses = {use(values.get(), Access::copy_write)}, .name = "fill"});
        commands->fill(values, 0, 256, 5);
        commands->end_copy();
        commands->begin_compute(
            {.uses = {use(uniforms.get(), Access::uniform_read), use(values.get(), Access::storage_read_write)},
             .name = "scale"});
        commands->bind_pipeline(scale);
        commands->bind_group(scale_group);
        const std::uint32_t push[4] = {1, 32, 0, 0};
        commands->push(bytes_of(push));
        commands->dispatch(1, 1, 1);
        commands->end_compute();
        commands->begin_render({.colors = {{.texture = image, .clear = {0, 0, 1, 1}}}, .size = size, .name = "quads"});
        test::draw(*commands, quads, both, records);
        commands->end_render();
        commands->begin_render({.colors = {{.texture = target}},
                                .depth = {.texture = depth},
                                .uses = {use(image.get(), Access::sampled)},
                                .size = size,
                                .name = "fetch"});
        commands->bind_pipeline(fetch);
        commands->bind_group(fetch_group);
        commands->draw({.vertex_count = 3});
        commands->end_render();
        commands->begin_copy({.uses = {use(target.get(), Access::copy_read), use(values.get(), Access::copy_read),
                                       use(result.get(), Access::copy_write)},
                              .name = "read"});
        commands->copy(target.get(), result.get(), TextureCopy{});
        commands->copy(values.get(), result.get(), BufferCopy{.destination_offset = 256, .size = 256});
        commands->end_copy();
        test::must(device->wait(test::must(device->submit())));

        std::uint32_t found[128];
        std::memcpy(found, device->mapped(result).data(), sizeof found);
        CHECK(found[0] == 0xFF00FF00u);          // top left: green over red
        CHECK(found[7 * 8] == 0xFF0000FFu);      // bottom left: red
        CHECK(found[7 * 8 + 7] == 0xFFFF0000u);  // bottom right: cleared to blue
        CHECK(found[64] == 16);                  // 5 · 3 + 1
        CHECK(found[64 + 31] == 16);
        CHECK(found[64 + 32] == 5);
    }
}

TEST_CASE("calls by hand and calls of the command list mix in one pass", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    constexpr Extent2D size{4, 4};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const auto native = device->native();
    CHECK(native.instance != VK_NULL_HANDLE);
    CHECK(native.physical != VK_NULL_HANDLE);
    CHECK(native.queue != VK_NULL_HANDLE);
    CHECK(device->native(target.get()).image != VK_NULL_HANDLE);
    CHECK(device->native(pipeline.get()).layout != VK_NULL_HANDLE);
    const test::Quad quads[] = {{.rect = {-1, -1, 0, 1}, .color = {1, 0, 0, 1}},
                                {.rect = {0, -1, 1, 1}, .color = {0, 1, 0, 1}}};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, quads);
        commands.begin_render({.colors = {{.texture = target}}, .size = size});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.draw({.vertex_count = 6, .first_instance = records.first});
        native.table->CmdDraw(commands.native(), 6, 1, 0, records.first + 1);
        commands.end_render();
    });
    const Image8 picture = test::read<std::uint8_t>(*device, target.get(), size, 4);
    CHECK(test::rgba(picture, 0, 0) == 0xFF0000FF);
    CHECK(test::rgba(picture, 3, 0) == 0x00FF00FF);
}
