// SPDX-License-Identifier: MIT
// One frame of everything, from GLSL text and from SPIR-V: the same bits, and not one message of the driver.
#include <cstring>
#include <pellucid/opengl/opengl.hpp>
#include "support/gpu.hpp"

namespace pellucid::inline v0_1 {
namespace {

using test::must;
using test::own;

test::TestDevice<OpenGL> make(bool spirv, bool validation = true) {
    return test::make_device<OpenGL>([&](rhi::DeviceDesc& desc) {
        desc.gl_spirv = spirv;
        desc.validation = validation;
    });
}

struct Pictures {
    Image8 quads, pushed, fetched, chosen, framed;
    std::vector<std::uint32_t> scaled;
};

/// Clears, draws records by base instance, pushes, samples, chooses by constants, reads frame uniforms, dispatches.
Pictures render(opengl::Device& device) {
    constexpr Extent2D size{16, 16};
    constexpr float sum[8][4] = {{0.5f, 0, 0, 0.5f}, {0, 0.25f, 0, 0.5f}};
    const auto target = test::make_target(device, size);
    const auto depth = test::make_depth(device, size);
    const auto source =
        own(device, device.make_texture({.size = size,
                                         .usage = rhi::TextureUsage::attachment | rhi::TextureUsage::sampled |
                                                  rhi::TextureUsage::copy_source,
                                         .debug_name = "source"}));
    const auto sampler = own(device, device.make_sampler({.debug_name = "sampler"}));

    auto desc = test::quad_desc();
    desc.depth = {.format = rhi::Format::d32_float, .test = true, .write = true};
    const auto quads = own(device, device.make_pipeline(desc));
    auto full_screen = [&](const rhi::Shader& fragment, std::span<const rhi::SpecConstant> constants = {},
                           rhi::GroupLayout group = {}, std::uint32_t push = 0) {
        rhi::GraphicsPipelineDesc out = test::quad_desc();
        out.vertex = &shaders::test_fullscreen_vert;
        out.fragment = &fragment;
        out.constants = constants;
        out.pass_group = group;
        out.push_bytes = push;
        return own(device, device.make_pipeline(out));
    };
    const rhi::GroupLayout fetch_layout{.bindings = {{12, rhi::BindingKind::sampled_texture}}};
    constexpr rhi::SpecConstant constants[] = {{.id = 7, .value = 99}, {.id = 0, .value = 5}, {.id = 1234, .value = 1}};
    const auto pushes = full_screen(shaders::test_push_frag, {}, {}, sizeof sum);
    const auto fetches = full_screen(shaders::test_fetch_frag, {}, fetch_layout);
    const auto chooses = full_screen(shaders::test_spec_frag, constants);
    const auto frames = full_screen(shaders::test_frame_frag);
    const auto group =
        own(device, device.make_group({.layout = fetch_layout,
                                       .bindings = {{.binding = 12, .texture = source, .sampler = sampler}},
                                       .debug_name = "fetch"}));

    Pictures out;
    constexpr test::Quad records[] = {{.rect = {-1, 0, 0, 1}, .color = {1, 0, 0, 1}, .depth = {0.5f}},
                                      {.rect = {-1, -1, 1, 1}, .color = {0, 1, 0, 1}, .depth = {0.25f}}};
    test::draw(device, {.colors = {{.texture = source}}, .depth = {.texture = depth}, .size = size, .name = "quads"},
               quads, records);
    out.quads = test::read<std::uint8_t>(device, source, size, 4);
    auto pass = [&](const rhi::Uses& uses, auto&& record) {
        test::run(device, [&](opengl::Commands& commands) {
            constexpr float frame_color[4] = {0, 0, 1, 1};
            const auto uniforms = must(commands.upload_uniforms(rhi::bytes_of(frame_color)));
            commands.begin_render({.colors = {{.texture = target}}, .uses = uses, .size = size, .name = "full screen"});
            commands.bind_frame(uniforms, {});
            record(commands);
            commands.draw({.vertex_count = 3});
            commands.end_render();
        });
        return test::read<std::uint8_t>(device, target, size, 4);
    };
    out.pushed = pass({}, [&](opengl::Commands& commands) {
        commands.bind_pipeline(pushes);
        commands.push(rhi::bytes_of(sum));
    });
    out.fetched = pass({rhi::use(source.get(), rhi::Access::sampled)}, [&](opengl::Commands& commands) {
        commands.bind_pipeline(fetches);
        commands.bind_group(group);
    });
    out.chosen = pass({}, [&](opengl::Commands& commands) { commands.bind_pipeline(chooses); });
    out.framed = pass({}, [&](opengl::Commands& commands) { commands.bind_pipeline(frames); });

    const rhi::GroupLayout scale_layout{
        .bindings = {{12, rhi::BindingKind::uniform_buffer}, {13, rhi::BindingKind::storage_buffer}}};
    const auto scale = own(device, device.make_pipeline({.compute = &shaders::test_scale_comp,
                                                         .pass_group = scale_layout,
                                                         .push_bytes = 16,
                                                         .debug_name = "scale"}));
    constexpr std::uint32_t factor[4] = {3}, values[4] = {1, 2, 3, 4}, offset[4] = {7, 3};
    const auto factors = own(
        device, device.make_buffer({.size = 16, .usage = rhi::BufferUsage::uniform, .initial = rhi::bytes_of(factor)}));
    const auto data =
        own(device, device.make_buffer({.size = 16,
                                        .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_source,
                                        .initial = rhi::bytes_of(values)}));
    const auto bound = own(
        device, device.make_group({.layout = scale_layout,
                                   .bindings = {{.binding = 12, .buffer = factors}, {.binding = 13, .buffer = data}},
                                   .debug_name = "scale"}));
    test::run(device, [&](opengl::Commands& commands) {
        commands.begin_compute({.uses = {rhi::use(factors.get(), rhi::Access::uniform_read),
                                         rhi::use(data.get(), rhi::Access::storage_read_write)}});
        commands.bind_pipeline(scale);
        commands.bind_group(bound);
        commands.push(rhi::bytes_of(offset));
        commands.dispatch(1, 1, 1);
        commands.end_compute();
    });
    out.scaled = test::read<std::uint32_t>(device, data, 4);
    return out;
}

}  // namespace

TEST_CASE("a frame of everything, from GLSL text and from SPIR-V", "[gpu]") {
    Image8 first;
    for (const bool spirv : {false, true}) {
        CAPTURE(spirv);
        const auto device = make(spirv);
        if (!device) return;
        const Pictures out = render(*device);
        CHECK(test::rgba(out.quads, 0, 0) == 0xFF0000FFu);  // top left: the nearer quad, drawn first
        CHECK(test::rgba(out.quads, 15, 0) == 0x00FF00FFu);
        CHECK(test::rgba(out.quads, 0, 15) == 0x00FF00FFu);
        CHECK(test::rgba(out.pushed, 3, 3) == 0x804000FFu);
        CHECK(out.fetched.data == out.quads.data);
        CHECK(test::rgba(out.chosen, 8, 8) == 0x056301FFu);
        CHECK(test::rgba(out.framed, 8, 8) == 0x0000FFFFu);
        CHECK(out.scaled == std::vector<std::uint32_t>{10, 13, 16, 4});
        CHECK(device.log->messages.empty());
    }
}

TEST_CASE("the same pictures without validation, in a context that checks no errors", "[gpu]") {
    const auto device = make(false, false);
    if (!device) return;
    const Pictures out = render(*device);
    CHECK(test::rgba(out.quads, 0, 0) == 0xFF0000FFu);
    CHECK(test::rgba(out.chosen, 8, 8) == 0x056301FFu);
    CHECK(out.scaled == std::vector<std::uint32_t>{10, 13, 16, 4});
}

TEST_CASE("a constant that a pipeline does not give keeps the shader's own value, in text and SPIR-V", "[gpu]") {
    for (const bool spirv : {false, true}) {
        CAPTURE(spirv);
        const auto device = make(spirv);
        if (!device) return;
        const auto target = test::make_target(*device, {4, 4});
        constexpr rhi::SpecConstant one[] = {{.id = 0, .value = 5}};
        rhi::GraphicsPipelineDesc desc = test::quad_desc();
        desc.vertex = &shaders::test_fullscreen_vert;
        desc.fragment = &shaders::test_spec_frag;
        desc.constants = one;
        const auto pipeline = own(*device, device->make_pipeline(desc));
        test::run(*device, [&](opengl::Commands& commands) {
            commands.begin_render({.colors = {{.texture = target}}, .size = {4, 4}});
            commands.bind_pipeline(pipeline);
            commands.bind_frame({}, {});
            commands.draw({.vertex_count = 3});
            commands.end_render();
        });
        CHECK(test::rgba(test::read<std::uint8_t>(*device, target, {4, 4}, 4), 1, 1) == 0x050201FFu);
    }
}

TEST_CASE("two devices on one thread: every call finds its own context", "[gpu]") {
    const auto a = make(false), b = make(true);
    if (!a || !b) return;
    const auto red = test::make_target(*a, {4, 4});
    const auto green = test::make_target(*b, {4, 4});
    auto* of_a = must(a->begin_frame());
    auto* of_b = must(b->begin_frame());
    of_a->begin_render({.colors = {{.texture = red, .clear = {1, 0, 0, 1}}}, .size = {4, 4}});
    of_a->end_render();
    of_b->begin_render({.colors = {{.texture = green, .clear = {0, 1, 0, 1}}}, .size = {4, 4}});
    of_b->end_render();
    must(a->wait(must(a->submit())));
    must(b->wait(must(b->submit())));
    CHECK(test::rgba(test::read<std::uint8_t>(*a, red, {4, 4}, 4), 0, 0) == 0xFF0000FFu);
    CHECK(test::rgba(test::read<std::uint8_t>(*b, green, {4, 4}, 4), 0, 0) == 0x00FF00FFu);
    CHECK_FALSE(OpenGL::list().empty());  // makes and drops contexts of its own
    CHECK(test::rgba(test::read<std::uint8_t>(*a, red, {4, 4}, 4), 3, 3) == 0xFF0000FFu);
}

TEST_CASE("errors name the pipeline, the shader and the driver's reason", "[gpu]") {
    for (const bool spirv : {false, true}) {
        CAPTURE(spirv);
        const auto device = make(spirv);
        if (!device) return;
        rhi::Shader broken = shaders::test_color_frag;
        broken.name = "test/broken.frag";
        broken.gl_text = "#version 450\nvoid main() { no_such_function(); }\n";
        broken.gl_spirv = {};
        auto desc = test::quad_desc();
        desc.fragment = &broken;
        desc.debug_name = "the broken one";
        const auto made = device->make_pipeline(desc);
        REQUIRE_FALSE(made);
        CHECK(made.error().message.find("'the broken one'") != std::string::npos);
        CHECK(made.error().message.find("test/broken.frag") != std::string::npos);
        if (!spirv) CHECK(made.error().message.find("no_such_function") != std::string::npos);
        CHECK(device.log->messages.empty());
    }
}

TEST_CASE("wrong frames and tickets are results", "[gpu]") {
    const auto device = make(false);
    if (!device) return;
    CHECK(device->submit().error().code == Errc::invalid_argument);
    must(device->begin_frame());
    CHECK(device->begin_frame().error().code == Errc::invalid_argument);
    const rhi::Ticket ticket = must(device->submit());
    CHECK(device->wait(rhi::Ticket{static_cast<std::uint64_t>(ticket) + 1}).error().code == Errc::invalid_argument);
    must(device->wait(ticket));
    CHECK(device->done(ticket));
    CHECK(device->done(rhi::Ticket::none));
    CHECK_FALSE(device->done(rhi::Ticket{static_cast<std::uint64_t>(ticket) + 1}));
}

}  // namespace pellucid::inline v0_1
