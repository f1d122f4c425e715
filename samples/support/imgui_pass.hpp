// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Draws what Dear ImGui has laid out (1.86 to 1.90), through the RHI, into any texture of display-referred codes: with
/// a window or without one, on any backend.  Dear ImGui's own backends are not used.
///
/// Colours are blended as codes, as every backend of Dear ImGui does: C = a·C_src + (1 - a)·C_dst, and the alpha
/// of the target A = a + (1 - a)·A_dst.
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/imgui.hpp>
#include <imgui.h>
#include <cstdint>
#include <optional>
#include <vector>
#include "support/imgui/imgui_pass.h"
#include "support/imgui_geometry.hpp"

namespace pellucid::samples {

/// Fonts, pipeline and buffers of the user interface on one device, which must outlive it.
template <rhi::Backend B>
class ImGuiPass {
public:
    static constexpr std::size_t max_textures = 24;  ///< at a time, the fonts among them

    /// Uploads the atlas of `fonts` and gives it its identifier.  Tell Dear ImGui that vertex offsets are understood:
    /// `io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset`.  `target`: format of what is drawn into.
    /// Errors: those of creation.
    [[nodiscard]] static Result<ImGuiPass> create(typename B::Device& device, ImFontAtlas& fonts,
                                                  rhi::Format target = rhi::Format::rgba8_unorm);

    /// A texture (usage sampled) for ImGui::Image and draw lists, until it is removed; it stays the caller's.
    /// Errors: `invalid_argument` where there are `max_textures` already.
    [[nodiscard]] Result<ImTextureID> add(rhi::Texture texture, rhi::Filter filter = rhi::Filter::linear);
    /// No draw list of a later `record` may name it.
    void remove(ImTextureID id);

    /// Records a copy of vertices and indices and one render pass over what `target` holds.  `size`: of the target, in
    /// texels; what lies outside of it is not drawn.  Nothing is recorded where there is nothing to draw.
    /// Precondition: no pass is open.  Errors: those of creation (buffers grow); `invalid_argument` for a texture that
    /// was never added.
    [[nodiscard]] Result<void> record(typename B::Commands& cmd, const ImDrawData& data, rhi::Texture target,
                                      Extent2D size);

private:
    template <class Handle>
    using Unique = rhi::Unique<typename B::Device, Handle>;
    struct Slot {
        rhi::Texture texture = {};  ///< null: free
        rhi::Filter filter = rhi::Filter::linear;
        Unique<rhi::Group> group;
    };
    /// A buffer of device memory that is made again where it is too small.
    struct Growing {
        Unique<rhi::Buffer> buffer;
        std::uint64_t size = 0;
    };
    [[nodiscard]] static rhi::GroupLayout layout() {
        return {{{PELLUCID_IMGUI_VERTICES, rhi::BindingKind::storage_buffer},
                 {PELLUCID_IMGUI_TEXTURE, rhi::BindingKind::sampled_texture}}};
    }
    [[nodiscard]] Result<void> fit(Growing& buffer, std::uint64_t bytes, rhi::BufferUsage usage, const char* name);
    [[nodiscard]] Result<void> make_groups(const DrawGeometry& geometry);
    void upload(typename B::Commands& cmd) const;

    typename B::Device* device_ = nullptr;
    Unique<rhi::Texture> fonts_;
    Unique<rhi::Sampler> samplers_[2];  ///< by rhi::Filter
    Unique<rhi::Pipeline> pipeline_;
    Growing vertices_, indices_;
    std::vector<Slot> slots_;  ///< identifier i is slot i - 1
    DrawGeometry geometry_;
};

}  // namespace pellucid::samples

#include "support/imgui_pass-inl.hpp"
