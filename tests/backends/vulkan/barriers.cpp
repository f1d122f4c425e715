// SPDX-License-Identifier: MIT
// Barriers and group bindings where Vulkan is stricter than the RHI: the layer's synchronisation checks are the test,
// and the last case shows that they would find what is missing.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {
const GroupLayout scale_layout{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
constexpr std::uint32_t factor[4] = {2, 0, 0, 0};
constexpr std::uint32_t push[4] = {1, 64, 0, 0};

/// A dispatch that replaces each value v of 64 by 2 v + 1.
struct Scale {
    explicit Scale(vulkan::Device& device)
        : uniforms(own(device,
                       device.make_buffer({.size = 16, .usage = BufferUsage::uniform, .initial = bytes_of(factor)}))),
          values(own(device, device.make_buffer({.size = 256,
                                                 .usage = BufferUsage::storage | BufferUsage::copy_source |
                                                          BufferUsage::copy_destination | BufferUsage::index |
                                                          BufferUsage::indirect,
                                                 .debug_name = "values"}))),
          group(own(device, device.make_group(
                                {.layout = scale_layout, .bindings = {{12, uniforms.get()}, {13, values.get()}}}))),
          pipeline(
              own(device, device.make_pipeline(ComputePipelineDesc{
                              .compute = &shaders::test_scale_comp, .pass_group = scale_layout, .push_bytes = 16}))) {}
    void clear(vulkan::Commands& commands, std::uint32_t word) const {
        commands.begin_copy({.uses = {use(values.get(), Access::copy_write)}});
        commands.fill(values, 0, 256, word);
        commands.end_copy();
    }
    void dispatch(vulkan::Commands& commands) const {
        commands.begin_compute(
            {.uses = {use(uniforms.get(), Access::uniform_read), use(values.get(), Access::storage_read_write)}});
        commands.bind_pipeline(pipeline);
        commands.bind_group(group);
        commands.push(bytes_of(push));
        commands.dispatch(1, 1, 1);
        commands.end_compute();
    }
    Unique<vulkan::Device, Buffer> uniforms, values;
    Unique<vulkan::Device, Group> group;
    Unique<vulkan::Device, Pipeline> pipeline;
};
}  // namespace

TEST_CASE("writes after writes, within a frame and across frames in flight", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    const Scale scale(*device);
    Ticket last{};
    for (int frame = 0; frame < 4; ++frame) {
        auto* commands = test::must(device->begin_frame());
        if (frame == 0) scale.clear(*commands, 0);
        scale.dispatch(*commands);
        scale.dispatch(*commands);
        last = test::must(device->submit());  // not waited for: the next frame follows on the same buffer
    }
    test::must(device->wait(last));
    CHECK(test::read<std::uint32_t>(*device, scale.values.get(), 64) == std::vector<std::uint32_t>(64, 255));
}

TEST_CASE("one buffer in several roles at once: read as index, as indirect, and copied", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    const Scale scale(*device);
    const auto target = test::make_target(*device, {4, 4});
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    // 5 words {6, 1, 0, 0, 0} of an indirect draw, whose indices 0 … 5 start at word 8.
    const std::uint32_t words[16] = {6, 1, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 0, 0};
    const auto arguments =
        own(*device, device->make_buffer({.size = 64,
                                          .usage = BufferUsage::index | BufferUsage::indirect |
                                                   BufferUsage::copy_source | BufferUsage::copy_destination,
                                          .debug_name = "arguments"}));
    const test::Quad quad[] = {{.color = {0, 1, 0, 1}}};
    for (int frame = 0; frame < 3; ++frame) {
        test::run(*device, [&](auto& commands) {
            auto records = test::upload(commands, quad);
            std::uint32_t filled[16];
            std::memcpy(filled, words, sizeof filled);
            filled[2] = 8;              // first index
            filled[4] = records.first;  // base instance
            commands.begin_copy({.uses = {use(arguments.get(), Access::copy_write)}});
            commands.update(arguments, 0, bytes_of(filled));
            commands.end_copy();
            commands.begin_render(
                {.colors = {{.texture = target}},
                 .uses = {use(arguments.get(), Access::index_read), use(arguments.get(), Access::indirect_read)},
                 .size = {4, 4}});
            commands.bind_pipeline(pipeline);
            commands.bind_frame({}, records);
            commands.bind_index_buffer(arguments);
            commands.draw_indexed_indirect(arguments, 0, 1);
            commands.end_render();
        });
        CHECK(test::rgba(test::read<std::uint8_t>(*device, target.get(), {4, 4}, 4), 1, 1) == 0x00FF00FF);
        CHECK(test::read<std::uint32_t>(*device, arguments.get(), 14)[13] == 5);
    }
}

TEST_CASE("the scene group stays bound when the pass group's shape changes or is empty", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    const auto target = test::make_target(*device, {4, 1});
    const auto colour = [&](float r, float g, float b, BufferUsage usage) {
        const float rgba[4] = {r, g, b, 1};
        return own(*device, device->make_buffer({.size = 16, .usage = usage, .initial = bytes_of(rgba)}));
    };
    const auto red = colour(1, 0, 0, BufferUsage::storage);
    const auto green = colour(0, 1, 0, BufferUsage::uniform);
    const auto blue = colour(0, 0, 1, BufferUsage::storage);
    const GroupLayout none{}, storage{.bindings = {{12, BindingKind::storage_buffer}}},
        uniform{.bindings = {{13, BindingKind::uniform_buffer}}},
        scene{.bindings = {{24, BindingKind::storage_buffer}}};
    const auto red_group = own(*device, device->make_group({.layout = storage, .bindings = {{12, red.get()}}}));
    const auto green_group = own(*device, device->make_group({.layout = uniform, .bindings = {{13, green.get()}}}));
    const auto blue_group =
        own(*device, device->make_group({.slot = GroupSlot::scene, .layout = scene, .bindings = {{24, blue.get()}}}));
    const auto make = [&](const Shader& fragment, const GroupLayout& pass) {
        auto desc = test::quad_desc();
        desc.vertex = &shaders::test_fullscreen_vert;
        desc.fragment = &fragment;
        desc.pass_group = pass;
        desc.scene_group = scene;
        return own(*device, device->make_pipeline(desc));
    };
    const auto with_storage = make(shaders::test_scene_storage_frag, storage);
    const auto with_uniform = make(shaders::test_scene_uniform_frag, uniform);
    const auto alone = make(shaders::test_scene_frag, none);
    test::run(*device, [&](auto& commands) {
        commands.begin_render({.colors = {{.texture = target}},
                               .uses = {use(red.get(), Access::storage_read), use(green.get(), Access::uniform_read),
                                        use(blue.get(), Access::storage_read)},
                               .size = {4, 1}});
        const auto draw = [&](std::uint32_t x) {
            commands.set_scissor({x, 0, 1, 1});
            commands.draw({.vertex_count = 3});
        };
        commands.bind_pipeline(with_storage);
        commands.bind_group(blue_group);
        commands.bind_group(red_group);
        draw(0);
        commands.bind_pipeline(alone);  // no pass group: Vulkan drops the scene's with the changed layout
        draw(1);
        commands.bind_pipeline(with_uniform);
        commands.bind_group(green_group);
        draw(2);
        commands.bind_pipeline(with_storage);
        commands.bind_group(red_group);
        draw(3);
        commands.end_render();
    });
    const Image8 picture = test::read<std::uint8_t>(*device, target.get(), {4, 1}, 4);
    CHECK(test::rgba(picture, 0, 0) == 0xFF00FFFF);
    CHECK(test::rgba(picture, 1, 0) == 0x0000FFFF);
    CHECK(test::rgba(picture, 2, 0) == 0x00FFFFFF);
    CHECK(test::rgba(picture, 3, 0) == 0xFF00FFFF);
}

TEST_CASE("depth with stencil: the depth is sampled and tested while the stencil is written", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    constexpr Extent2D size{4, 4};
    const auto depth = own(*device, device->make_texture({.size = size,
                                                          .format = Format::d32_float_s8_uint,
                                                          .usage = TextureUsage::attachment | TextureUsage::sampled,
                                                          .debug_name = "depth with stencil"}));
    const auto target = test::make_target(*device, size);
    const auto sampler = own(*device, device->make_sampler({.min = Filter::nearest, .mag = Filter::nearest}));
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}}};
    const auto group = own(
        *device,
        device->make_group({.layout = layout, .bindings = {{.binding = 12, .texture = depth, .sampler = sampler}}}));
    auto desc = test::quad_desc();
    desc.depth = {.format = Format::d32_float_s8_uint, .test = true, .write = true};
    desc.colors = {};
    desc.fragment = nullptr;
    const auto fill = own(*device, device->make_pipeline(desc));
    desc = test::quad_desc();
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.pass_group = layout;
    StencilFace face;
    face.compare = Compare::equal;
    face.pass = StencilFace::Op::increment_clamp;
    desc.depth = {.format = Format::d32_float_s8_uint,
                  .test = true,
                  .compare = Compare::less,
                  .stencil_test = true,
                  .front = face,
                  .back = face};
    const auto fetch = own(*device, device->make_pipeline(desc));
    const test::Quad quad[] = {{.rect = {-1, -1, 0, 1}, .depth = {0.75f}}};
    for (int frame = 0; frame < 2; ++frame) {
        test::run(*device, [&](auto& commands) {
            const auto records = test::upload(commands, quad);
            commands.begin_render({.depth = {.texture = depth}, .size = size});
            test::draw(commands, fill, quad, records);
            commands.end_render();
            commands.begin_render({.colors = {{.texture = target}},
                                   .depth = {.texture = depth, .load = Load::load, .read_only = true},
                                   .uses = {use(depth.get(), Access::sampled)},
                                   .size = size});
            commands.bind_pipeline(fetch);
            commands.bind_group(group);
            commands.draw({.vertex_count = 3});  // at 0.5 < 0.75: left half, where the stencil is 0
            commands.draw({.vertex_count = 3});  // the stencil is 1 by now
            commands.end_render();
        });
        const Image8 picture = test::read<std::uint8_t>(*device, target.get(), size, 4);
        CHECK(picture.texel(0, 0)[0] == 191);
        CHECK(picture.texel(3, 0)[3] == 0);
    }
}

TEST_CASE("the checks find what is not declared, also across submissions", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    device.log->expected = true;
    const Scale scale(*device);
    const auto said = [&](const char* part) {
        for (const std::string& message : device.log->messages)
            if (message.find(part) != std::string::npos) return true;
        return false;
    };
    auto* commands = test::must(device->begin_frame());
    scale.clear(*commands, 1);
    commands->fill(scale.values, 0, 256, 2);  // in no pass: no barrier
    CHECK(said("SYNC-HAZARD-WRITE-AFTER-WRITE"));
    (void)test::must(device->submit());
    device.log->messages.clear();
    commands = test::must(device->begin_frame());
    commands->fill(scale.values, 0, 256, 3);  // nor here: the other write is in the frame before
    CHECK(device.log->messages.empty());
    test::must(device->wait(test::must(device->submit())));
    CHECK(said("SYNC-HAZARD-WRITE-AFTER-WRITE"));
}
