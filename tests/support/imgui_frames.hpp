// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Frames of the user interface in tests: a context of its own, draw lists by hand, and a rasteriser on the CPU that
/// says what they must look like.
#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <pellucid/core/image.hpp>
#include "support/catch.hpp"
#include "support/imgui_geometry.hpp"

namespace pellucid::test {

/// A context with the default font and a display of this size; gone with the object.
class UiContext {
public:
    explicit UiContext(float width, float height) : context_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {width, height};
        io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
        unsigned char* texels = nullptr;
        io.Fonts->GetTexDataAsRGBA32(&texels, &atlas_width_, &atlas_height_);
        atlas_ = texels;
        ImGui::GetStyle().AntiAliasedFill = false;  // edges are then those of the triangles
        ImGui::GetStyle().AntiAliasedLines = false;
    }
    UiContext(const UiContext&) = delete;
    UiContext& operator=(const UiContext&) = delete;
    ~UiContext() { ImGui::DestroyContext(context_); }

    [[nodiscard]] ImFontAtlas& fonts() const { return *ImGui::GetIO().Fonts; }
    /// One frame whose foreground list is filled by `fill(list)`; valid until the next.
    template <class F>
    const ImDrawData& frame(F&& fill) const {
        ImGui::NewFrame();
        fill(*ImGui::GetForegroundDrawList());
        ImGui::Render();
        return *ImGui::GetDrawData();
    }
    /// Texel of the font atlas, straight alpha, codes.
    [[nodiscard]] std::array<double, 4> font_texel(double u, double v) const {
        const auto at = [](double t, int n) { return std::clamp(static_cast<int>(std::floor(t * n)), 0, n - 1); };
        const unsigned char* t = atlas_ + std::size_t{4} * (at(v, atlas_height_) * atlas_width_ + at(u, atlas_width_));
        return {t[0] / 255.0, t[1] / 255.0, t[2] / 255.0, t[3] / 255.0};
    }

private:
    ImGuiContext* context_;
    const unsigned char* atlas_ = nullptr;
    int atlas_width_ = 0, atlas_height_ = 0;
};

namespace detail {

struct Corner {
    double x, y, u, v;
    std::array<double, 4> color;
};

/// Blends one triangle over `picture` inside `clip`, a sample at each pixel's centre, the nearest texel of the font.
inline void blend_triangle(const UiContext& ui, std::array<Corner, 3> c, const std::array<double, 4>& clip,
                           Image8& picture) {
    const auto edge = [](const Corner& a, const Corner& b, double x, double y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    };
    double area = edge(c[0], c[1], c[2].x, c[2].y);
    if (area == 0) return;
    if (area < 0) std::swap(c[1], c[2]), area = -area;
    // On an edge: inside where it is a top or a left one (y down, area positive).
    const auto inside = [&](const Corner& a, const Corner& b, double w) {
        return w > 0 || (w == 0 && ((a.y == b.y && b.x > a.x) || b.y < a.y));
    };
    for (std::uint32_t row = 0; row < picture.height; ++row)
        for (std::uint32_t column = 0; column < picture.width; ++column) {
            const double x = column + 0.5, y = row + 0.5;
            if (x < clip[0] || y < clip[1] || x >= clip[2] || y >= clip[3]) continue;
            const double w0 = edge(c[1], c[2], x, y), w1 = edge(c[2], c[0], x, y), w2 = edge(c[0], c[1], x, y);
            if (!inside(c[1], c[2], w0) || !inside(c[2], c[0], w1) || !inside(c[0], c[1], w2)) continue;
            const auto mix = [&](double a, double b, double d) { return (a * w0 + b * w1 + d * w2) / area; };
            const auto texel = ui.font_texel(mix(c[0].u, c[1].u, c[2].u), mix(c[0].v, c[1].v, c[2].v));
            std::array<double, 4> src{};
            for (std::size_t i = 0; i < 4; ++i) src[i] = mix(c[0].color[i], c[1].color[i], c[2].color[i]) * texel[i];
            std::uint8_t* to = picture.texel(column, row);
            for (std::size_t i = 0; i < 4; ++i) {
                const double share = i == 3 ? 1 : src[3];
                to[i] = static_cast<std::uint8_t>(std::lround(255 * src[i] * share + to[i] * (1 - src[3])));
            }
        }
}

}  // namespace detail

/// What `data`, of the font texture alone, looks like over `picture`.
inline void rasterise(const UiContext& ui, const ImDrawData& data, Image8& picture) {
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& cmd : list.CmdBuffer) {
            const std::array<double, 4> clip{cmd.ClipRect.x, cmd.ClipRect.y, cmd.ClipRect.z, cmd.ClipRect.w};
            for (unsigned i = 0; i + 2 < cmd.ElemCount; i += 3) {
                std::array<detail::Corner, 3> corners{};
                for (unsigned k = 0; k < 3; ++k) {
                    const auto index = static_cast<unsigned>(list.IdxBuffer[static_cast<int>(cmd.IdxOffset + i + k)]);
                    const ImDrawVert& v = list.VtxBuffer[static_cast<int>(cmd.VtxOffset + index)];
                    const ImVec4 color = ImGui::ColorConvertU32ToFloat4(v.col);
                    corners[k] = {v.pos.x, v.pos.y, v.uv.x, v.uv.y, {color.x, color.y, color.z, color.w}};
                }
                detail::blend_triangle(ui, corners, clip, picture);
            }
        }
    }
}

}  // namespace pellucid::test
