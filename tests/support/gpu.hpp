// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The few lines that every test of an RHI would repeat: own, run, read back, draw rectangles.  Written against the
/// concepts only, so each test runs on every backend.
#include <cstring>
#include <pellucid/core/image.hpp>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/test.hpp>
#include <vector>
#include "support/devices.hpp"

namespace pellucid::test {

/// Owns what was made, or fails the test with the sentence of the error.
template <class D, class H>
[[nodiscard]] rhi::Unique<D, H> own(D& device, Result<H> made) {
    return rhi::Unique<D, H>(device, must(std::move(made)));
}

/// One frame: `record(commands)`, submitted and waited for.
template <class D, class F>
void run(D& device, F&& record) {
    auto* commands = must(device.begin_frame());
    record(*commands);
    must(device.wait(must(device.submit())));
}

/// One level and layer of a texture as `channels` values of `T` a texel, row 0 = top.
template <class T, class D>
[[nodiscard]] Image<T> read(D& device, rhi::Texture texture, Extent2D size, std::uint32_t channels,
                            std::uint32_t mip = 0, std::uint32_t layer = 0) {
    Image<T> out(size.width, size.height, channels);
    const auto bytes = std::as_writable_bytes(std::span(out.data));
    const auto buffer = own(device, device.make_buffer({.size = bytes.size(),
                                                        .usage = rhi::BufferUsage::copy_destination,
                                                        .memory = rhi::Memory::readback,
                                                        .debug_name = "read back"}));
    run(device, [&](auto& commands) {
        commands.begin_copy(
            {.uses = {rhi::use(texture, rhi::Access::copy_read), rhi::use(buffer.get(), rhi::Access::copy_write)},
             .name = "read a texture"});
        commands.copy(texture, buffer.get(), rhi::TextureCopy{.mip = mip, .layer = layer});
        commands.end_copy();
    });
    std::memcpy(bytes.data(), device.mapped(buffer).data(), bytes.size());
    return out;
}

/// `count` values of `T` from the start of a buffer.
template <class T, class D>
[[nodiscard]] std::vector<T> read(D& device, rhi::Buffer from, std::size_t count) {
    std::vector<T> out(count);
    const auto bytes = std::as_writable_bytes(std::span(out));
    const auto buffer = own(device, device.make_buffer({.size = bytes.size(),
                                                        .usage = rhi::BufferUsage::copy_destination,
                                                        .memory = rhi::Memory::readback,
                                                        .debug_name = "read back"}));
    run(device, [&](auto& commands) {
        commands.begin_copy(
            {.uses = {rhi::use(from, rhi::Access::copy_read), rhi::use(buffer.get(), rhi::Access::copy_write)},
             .name = "read a buffer"});
        commands.copy(from, buffer.get(), rhi::BufferCopy{.size = bytes.size()});
        commands.end_copy();
    });
    std::memcpy(bytes.data(), device.mapped(buffer).data(), bytes.size());
    return out;
}

/// A render target that can be read back.
template <class D>
[[nodiscard]] rhi::Unique<D, rhi::Texture> make_target(D& device, Extent2D size,
                                                       rhi::Format format = rhi::Format::rgba8_unorm) {
    return own(device, device.make_texture({.size = size,
                                            .format = format,
                                            .usage = rhi::TextureUsage::attachment | rhi::TextureUsage::copy_source,
                                            .debug_name = "target"}));
}

/// A depth buffer that can be read back.
template <class D>
[[nodiscard]] rhi::Unique<D, rhi::Texture> make_depth(D& device, Extent2D size,
                                                      rhi::Format format = rhi::Format::d32_float) {
    return own(device, device.make_texture({.size = size,
                                            .format = format,
                                            .usage = rhi::TextureUsage::attachment | rhi::TextureUsage::copy_source,
                                            .debug_name = "depth"}));
}

/// The record of quad.vert.
struct Quad {
    float rect[4] = {-1, -1, 1, 1};  ///< x0, y0, x1, y1 in NDC, y up
    float color[4] = {1, 1, 1, 1};
    float depth[4] = {0.5f, 0, 0, 0};  ///< z in [0]
    float unused[4] = {};
};
static_assert(sizeof(Quad) == 64);

/// Descriptor of a pipeline that draws rectangles into one target.
[[nodiscard]] inline rhi::GraphicsPipelineDesc quad_desc(rhi::Format format = rhi::Format::rgba8_unorm) {
    rhi::GraphicsPipelineDesc out;
    out.vertex = &shaders::test_quad_vert;
    out.fragment = &shaders::test_color_frag;
    out.colors.push_back({.format = format});
    out.debug_name = "quads";
    return out;
}

/// Uploads records for `quads`.
template <class C>
[[nodiscard]] rhi::RecordSlice upload(C& commands, std::span<const Quad> quads) {
    const auto records = must(commands.upload_records(static_cast<std::uint32_t>(quads.size()), sizeof(Quad)));
    std::memcpy(records.bytes.data(), quads.data(), quads.size_bytes());
    return records;
}

/// Draws rectangles in order, one draw each, with `pipeline`, inside a render pass.
template <class C>
void draw(C& commands, rhi::Pipeline pipeline, std::span<const Quad> quads, const rhi::RecordSlice& records) {
    commands.bind_pipeline(pipeline);
    commands.bind_frame({}, records);
    for (std::uint32_t i = 0; i < quads.size(); ++i)
        commands.draw({.vertex_count = 6, .first_instance = records.first + i});
}

/// One frame with one pass that draws rectangles.
template <class D>
void draw(D& device, const rhi::RenderPassDesc& pass, rhi::Pipeline pipeline, std::span<const Quad> quads) {
    run(device, [&](auto& commands) {
        const auto records = upload(commands, quads);
        commands.begin_render(pass);
        draw(commands, pipeline, quads, records);
        commands.end_render();
    });
}

/// The texel at (x, y) of an 8-bit RGBA picture as 0xRRGGBBAA: failures print readably.
[[nodiscard]] inline std::uint32_t rgba(const Image8& picture, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* t = picture.texel(x, y);
    return std::uint32_t{t[0]} << 24 | std::uint32_t{t[1]} << 16 | std::uint32_t{t[2]} << 8 | t[3];
}

}  // namespace pellucid::test
