// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// ImDrawData as plain lists: vertices and 32-bit indices of all its lists in a row, and draws with their scissors in
/// texels of the target.
#include <pellucid/rhi/desc.hpp>
#include <imgui.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pellucid::samples {

/// Identifiers of textures are numbers from 1; Dear ImGui holds them as pointers (or integers, in later versions).
[[nodiscard]] inline ImTextureID texture_id(std::size_t number) {
    return (ImTextureID)(std::uintptr_t)number;  // NOLINT: a pointer or an integer
}
[[nodiscard]] inline std::size_t texture_number(ImTextureID id) {
    return static_cast<std::size_t>((std::uintptr_t)id);  // NOLINT
}

struct GeometryDraw {
    std::size_t texture = 0;  ///< number of its identifier
    rhi::Rect scissor;        ///< inside the target, not empty
    rhi::DrawIndexed draw;
};

struct DrawGeometry {
    std::vector<ImDrawVert> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<GeometryDraw> draws;
    /// NDC = position · scale + offset.
    float scale[2] = {0, 0}, offset[2] = {0, 0};

    /// Reads the lists again; nothing is drawn where the display or the target has no size.  User callbacks are called
    /// here, in order, but Dear ImGui's own ("reset the state"), which means nothing: all state is set anyway.
    void read(const ImDrawData& data, Extent2D target);
};

// ------------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// The part of a clip rectangle that lies inside the target, from floor to ceiling as texels; false where none does.
[[nodiscard]] inline bool scissor_of(const ImDrawData& data, const ImVec4& clip, Extent2D target, rhi::Rect& out) {
    const auto texel = [](float value, float display, float scale, std::uint32_t limit) {
        const float at = (value - display) * scale;
        if (!(at > 0)) return 0u;  // NaN too
        return at < static_cast<float>(limit) ? static_cast<std::uint32_t>(at) : limit;
    };
    const std::uint32_t left = texel(clip.x, data.DisplayPos.x, data.FramebufferScale.x, target.width);
    const std::uint32_t top = texel(clip.y, data.DisplayPos.y, data.FramebufferScale.y, target.height);
    const std::uint32_t right = texel(clip.z, data.DisplayPos.x, data.FramebufferScale.x, target.width);
    const std::uint32_t bottom = texel(clip.w, data.DisplayPos.y, data.FramebufferScale.y, target.height);
    if (right <= left || bottom <= top) return false;
    out = {left, top, right - left, bottom - top};
    return true;
}

}  // namespace detail

inline void DrawGeometry::read(const ImDrawData& data, Extent2D target) {
    vertices.clear();
    indices.clear();
    draws.clear();
    if (!(data.DisplaySize.x > 0) || !(data.DisplaySize.y > 0) || target.width == 0 || target.height == 0) return;
    // The target may be of another size than the display says for a frame: points keep their texels.
    const float width = static_cast<float>(target.width) / data.FramebufferScale.x;
    const float height = static_cast<float>(target.height) / data.FramebufferScale.y;
    scale[0] = 2 / width;
    scale[1] = -2 / height;
    offset[0] = -1 - data.DisplayPos.x * scale[0];
    offset[1] = 1 - data.DisplayPos.y * scale[1];
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto first_vertex = static_cast<std::int32_t>(vertices.size());
        const auto first_index = static_cast<std::uint32_t>(indices.size());
        vertices.insert(vertices.end(), list.VtxBuffer.begin(), list.VtxBuffer.end());
        indices.insert(indices.end(), list.IdxBuffer.begin(), list.IdxBuffer.end());  // from 16 bits, most often
        for (const ImDrawCmd& cmd : list.CmdBuffer) {
            if (cmd.UserCallback != nullptr) {
                if (cmd.UserCallback != ImDrawCallback_ResetRenderState) cmd.UserCallback(&list, &cmd);
                continue;
            }
            GeometryDraw draw{.texture = texture_number(cmd.GetTexID())};
            if (cmd.ElemCount == 0 || !detail::scissor_of(data, cmd.ClipRect, target, draw.scissor)) continue;
            draw.draw = {.index_count = cmd.ElemCount,
                         .first_index = first_index + cmd.IdxOffset,
                         .vertex_offset = first_vertex + static_cast<std::int32_t>(cmd.VtxOffset)};
            draws.push_back(draw);
        }
    }
}

}  // namespace pellucid::samples
