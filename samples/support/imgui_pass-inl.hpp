// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of ImGuiPass<B>.
#include "support/imgui_pass.hpp"

namespace pellucid::samples {

template <rhi::Backend B>
Result<ImGuiPass<B>> ImGuiPass<B>::create(typename B::Device& device, ImFontAtlas& fonts, rhi::Format target) {
    static_assert(sizeof(ImDrawVert) == 4 * PELLUCID_IMGUI_VERTEX_WORDS && offsetof(ImDrawVert, pos) == 0 &&
                      offsetof(ImDrawVert, uv) == 8 && offsetof(ImDrawVert, col) == 16,
                  "this build of Dear ImGui has vertices of its own: the shader reads pos, uv, col");
    ImGuiPass pass;
    pass.device_ = &device;
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsRGBA32(&texels, &width, &height);
    const Extent2D size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    PELLUCID_OWN(pass.fonts_, device,
                 device.make_texture({.size = size,
                                      .initial = rhi::bytes_of(std::span<const unsigned char>(
                                          texels, std::size_t{4} * size.width * size.height)),
                                      .debug_name = "imgui.fonts"}));
    for (const rhi::Filter filter : {rhi::Filter::nearest, rhi::Filter::linear}) {
        PELLUCID_OWN(pass.samplers_[static_cast<std::size_t>(filter)], device,
                     device.make_sampler({.min = filter,
                                          .mag = filter,
                                          .mipmapped = false,
                                          .wrap_u = rhi::Wrap::clamp,
                                          .wrap_v = rhi::Wrap::clamp,
                                          .debug_name = "imgui"}));
    }
    constexpr rhi::Blend over{.enabled = true,
                              .src_color = rhi::BlendFactor::src_alpha,
                              .dst_color = rhi::BlendFactor::one_minus_src_alpha,
                              .dst_alpha = rhi::BlendFactor::one_minus_src_alpha};
    PELLUCID_OWN(pass.pipeline_, device,
                 device.make_pipeline(rhi::GraphicsPipelineDesc{.vertex = &shaders::imgui_vert,
                                                                .fragment = &shaders::imgui_frag,
                                                                .pass_group = layout(),
                                                                .push_bytes = sizeof(gpu::ImguiPush),
                                                                .colors = {{.format = target, .blend = over}},
                                                                .cull = rhi::Cull::none,
                                                                .debug_name = "imgui"}));
    PELLUCID_TRY(const ImTextureID id, pass.add(pass.fonts_));
    fonts.SetTexID(id);
    return pass;
}

template <rhi::Backend B>
Result<ImTextureID> ImGuiPass<B>::add(rhi::Texture texture, rhi::Filter filter) {
    std::size_t at = 0;
    while (at < slots_.size() && slots_[at].texture) ++at;
    if (at == max_textures)
        return Error{Errc::invalid_argument, "the user interface has " + std::to_string(max_textures) +
                                                 " textures already, as many as it can have: remove one"};
    if (at == slots_.size()) slots_.emplace_back();
    slots_[at].texture = texture;
    slots_[at].filter = filter;
    return texture_id(at + 1);
}

template <rhi::Backend B>
void ImGuiPass<B>::remove(ImTextureID id) {
    const std::size_t number = texture_number(id);
    if (number >= 1 && number <= slots_.size()) slots_[number - 1] = {};
}

template <rhi::Backend B>
Result<void> ImGuiPass<B>::fit(Growing& buffer, std::uint64_t bytes, rhi::BufferUsage usage, const char* name) {
    if (bytes <= buffer.size) return {};
    std::uint64_t size = 1u << 16;
    while (size < bytes) size *= 2;
    PELLUCID_OWN(
        buffer.buffer, *device_,
        device_->make_buffer({.size = size, .usage = usage | rhi::BufferUsage::copy_destination, .debug_name = name}));
    buffer.size = size;
    return {};
}

/// A group for each texture that is drawn.  Errors: a number that no texture has; those of creation.
template <rhi::Backend B>
Result<void> ImGuiPass<B>::make_groups(const DrawGeometry& geometry) {
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.texture == 0 || draw.texture > slots_.size() || !slots_[draw.texture - 1].texture)
            return Error{Errc::invalid_argument, "the user interface draws with texture " +
                                                     std::to_string(draw.texture) +
                                                     ", which was never added or is removed: add it first"};
        Slot& slot = slots_[draw.texture - 1];
        if (slot.group) continue;
        PELLUCID_OWN(slot.group, *device_,
                     device_->make_group({.layout = layout(),
                                          .bindings = {{.binding = PELLUCID_IMGUI_VERTICES, .buffer = vertices_.buffer},
                                                       {.binding = PELLUCID_IMGUI_TEXTURE,
                                                        .texture = slot.texture,
                                                        .sampler = samplers_[static_cast<std::size_t>(slot.filter)]}},
                                          .debug_name = "imgui"}));
    }
    return {};
}

template <rhi::Backend B>
void ImGuiPass<B>::upload(typename B::Commands& cmd) const {
    cmd.begin_copy({.uses = {rhi::use(vertices_.buffer, rhi::Access::copy_write),
                             rhi::use(indices_.buffer, rhi::Access::copy_write)},
                    .name = "imgui.upload"});
    const auto write = [&](rhi::Buffer buffer, std::span<const std::byte> bytes) {
        constexpr std::size_t piece = 65536;
        for (std::size_t at = 0; at < bytes.size(); at += piece)
            cmd.update(buffer, at, bytes.subspan(at, std::min(piece, bytes.size() - at)));
    };
    write(vertices_.buffer, rhi::bytes_of(std::span(geometry_.vertices)));
    write(indices_.buffer, rhi::bytes_of(std::span(geometry_.indices)));
    cmd.end_copy();
}

template <rhi::Backend B>
Result<void> ImGuiPass<B>::record(typename B::Commands& cmd, const ImDrawData& data, rhi::Texture target,
                                  Extent2D size) {
    geometry_.read(data, size);
    if (geometry_.draws.empty()) return {};
    const std::uint64_t vertex_bytes = geometry_.vertices.size() * sizeof(ImDrawVert);
    if (vertex_bytes > vertices_.size)  // groups name the old buffer
        for (Slot& slot : slots_) slot.group.reset();
    PELLUCID_CHECK(fit(vertices_, vertex_bytes, rhi::BufferUsage::storage, "imgui.vertices"));
    PELLUCID_CHECK(fit(indices_, 4 * geometry_.indices.size(), rhi::BufferUsage::index, "imgui.indices"));
    PELLUCID_CHECK(make_groups(geometry_));
    upload(cmd);

    rhi::RenderPassDesc pass{.colors = {{.texture = target, .load = rhi::Load::load}}, .size = size, .name = "imgui"};
    pass.uses.push_back(rhi::use(vertices_.buffer, rhi::Access::storage_read));
    pass.uses.push_back(rhi::use(indices_.buffer, rhi::Access::index_read));
    for (const Slot& slot : slots_)
        if (slot.texture && slot.group) pass.uses.push_back(rhi::use(slot.texture, rhi::Access::sampled));
    cmd.begin_render(pass);
    cmd.bind_pipeline(pipeline_);
    cmd.bind_index_buffer(indices_.buffer);
    const auto& g = geometry_;
    cmd.push(rhi::bytes_of(gpu::ImguiPush{.place = {g.scale[0], g.scale[1], g.offset[0], g.offset[1]}}));
    std::size_t bound = 0;
    for (const GeometryDraw& draw : geometry_.draws) {
        if (draw.texture != bound) cmd.bind_group(slots_[draw.texture - 1].group);
        bound = draw.texture;
        cmd.set_scissor(draw.scissor);
        cmd.draw_indexed(draw.draw);
    }
    cmd.end_render();
    return {};
}

}  // namespace pellucid::samples
