// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The one-call renderer: a scene, a camera and settings in; a picture and an account of what it took out.
#include <pellucid/core/half.hpp>
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/passes/light_volumes.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/passes/shadow_map.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/render_frame.hpp>
#include <pellucid/renderer/translucent.hpp>
#include <pellucid/rhi/readback.hpp>
#include <bit>
#include <memory>
#include <optional>

namespace pellucid::inline v0_1 {

/// What a frame took.  Bytes are of the renderer's own objects; the device's rings are apart.
struct RenderStats {
    std::vector<PassReport> passes;        ///< in order; left-out ones with the reason
    std::vector<TextureReport> resources;  ///< targets, the passes' own buffers and textures, the scene's
    std::uint64_t bytes = 0;               ///< their sum
    std::uint32_t pipelines = 0;           ///< built
    std::uint32_t draws = 0;               ///< a frame
    std::uint64_t triangles = 0;           ///< of the scene's instances
    std::uint32_t lights = 0;
    LightAssignment lighting = LightAssignment::loop;
    std::string lighting_why;  ///< where it is not the one that was asked for
    Shadows shadows = Shadows::none;
    std::string shadows_why;            ///< where they are not what was asked for
    std::uint32_t shadow_lights = 0;    ///< with shadow maps
    std::uint32_t shadow_maps = 0;      ///< that there is room for
    std::uint32_t shadows_drawn = 0;    ///< maps that the last frame drew
    TranslucencyStats translucency;     ///< of the last frame
    std::vector<std::string> warnings;  ///< of the scene and of its upload
};

/// Renders one scene with one set of settings on one device, which must outlive it.
template <rhi::Backend B>
class Renderer {
public:
    static constexpr std::size_t depth_index = 15;

    /// Builds what the scene needs and nothing else.  `scene` is copied where it must be kept.
    /// Errors: `invalid_argument` for a size of 0 or beyond the device's limit and for a light out of the ranges that
    /// scene/light.hpp documents; `unsupported` where the device cannot run the method of transparency; those of
    /// check_environment, check_shadows and of creation.
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(typename B::Device& device, const Scene& scene,
                                                                  const RenderSettings& settings = {});
    ~Renderer();  ///< declared, so that it is among what a backend's library instantiates

    /// Records and submits one frame; returns at once, but for methods that must see on the CPU what the GPU counted
    /// (settings.transparency: abuffer waits once).  Errors: device loss, memory, a memory budget that is too small.
    [[nodiscard]] Result<rhi::Ticket> render(const Camera& camera);

    /// Lights that take the place of the scene's from the next frame on; nothing is built again, and the picture is
    /// that of a new renderer, bit for bit.  As many of them as the scene has, in its order, each of the same kind,
    /// with a range where that one has one and, where shadow maps are drawn, with as many maps (renderer/needs.hpp:
    /// spots wider than widest_shadow_spot take six).  Error: `invalid_argument`, and nothing changes.
    [[nodiscard]] Result<void> set_lights(std::span<const Light> lights);
    /// RenderSettings::exposure_ev from the next frame on.
    void set_exposure(float ev) noexcept { settings_.exposure_ev = ev; }

    /// `[h, w, 4]` linear radiance before the tone curve, of the last frame; waits for it.
    [[nodiscard]] Result<ImageF> read_hdr() { return read_float(graph_[hdr_]); }
    /// `[h, w, 4]` display-referred sRGB codes of the last frame; waits for it.
    [[nodiscard]] Result<Image8> read_display();
    /// The texels of a G-buffer target, in the order of gbuffer_formats, or depth for `depth_index`; waits.  Needs
    /// settings.keep_gbuffer and an opaque surface in the scene, else `invalid_argument`.
    [[nodiscard]] Result<rhi::Texels> read_gbuffer(std::size_t index);

    /// The words of needs().grid (gpu/light_lists.h) of the last frame; waits.  Empty for methods without lists.
    [[nodiscard]] Result<std::vector<std::uint32_t>> read_light_lists() {
        return rhi::download<B, std::uint32_t>(*device_, scene_->lights().lists(), needs_.grid.bytes() / 4);
    }

    /// `[size, size]` depths of a layer of the shadow maps of the last frame; waits.  `invalid_argument` where there is
    /// no such layer.
    [[nodiscard]] Result<rhi::Texels> read_shadow_map(std::uint32_t layer);
    /// What the layers of the shadow maps are views of; null where no light has one.
    [[nodiscard]] const GpuShadows<B>* shadows() const noexcept { return scene_->shadows(); }

    /// `[h, w, 1]` translucent fragments in front of what is opaque, of the last frame; counts them in a frame of its
    /// own and waits.  `unsupported` on devices without float32_blending.
    [[nodiscard]] Result<Image<std::uint32_t>> count_layers();
    /// `[h, w, 1]` fragments that the last frame composited in each pixel (`interleaved`: surfaces that it lit), with
    /// settings.audit; waits.
    [[nodiscard]] Result<Image<std::uint32_t>> read_composited() { return translucent_.read_composited(*device_); }
    /// In [0,1]: a bound of what fragments that the last frame left out are worth, as a share of the largest radiance
    /// behind; waits.  `invalid_argument` for methods without one: those that do not heed min_transmittance.
    [[nodiscard]] Result<double> read_transmittance_left() { return translucent_.read_transmittance_left(*device_); }

    /// The texture of `read_display`, for windows and passes of the user's own (usages sampled and copy_source).
    [[nodiscard]] rhi::Texture display() const noexcept { return graph_[display_]; }
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] const SceneNeeds& needs() const noexcept { return needs_; }
    [[nodiscard]] const RenderSettings& settings() const noexcept { return settings_; }
    /// GPU time of each pass of the newest frame whose timestamps have arrived; empty on devices without timestamps.
    [[nodiscard]] auto gpu_times() { return clock_->collect(); }
    /// Targets of the G-buffer, for passes of the user's own; null handles where the scene has nothing opaque.
    [[nodiscard]] const GBufferTargets& gbuffer() const noexcept { return gbuffer_; }
    [[nodiscard]] const SceneBinding& scene_binding() const noexcept { return scene_->binding(); }

private:
    explicit Renderer(typename B::Device& device) : device_(&device) {}
    [[nodiscard]] Result<void> build(const Scene& scene);
    void declare_shadows();
    void declare_gbuffer();
    void declare_light_lists(GraphTexture depth);
    void declare_lighting(const LightingChanges& changes);
    void declare_light_volumes(const LightingChanges& changes);
    void declare_emitted();
    void declare_background();
    void declare_tonemap();
    [[nodiscard]] LightingDesc lighting_desc() const {
        return {.layout = settings_.gbuffer,
                .emissive = needs_.emissive_target,
                .stage = settings_.shading,
                .brdf = settings_.brdf,
                .needs = needs_.mask,
                .exact = settings_.exact};
    }
    [[nodiscard]] Result<ImageF> read_float(rhi::Texture texture);

    typename B::Device* device_;
    RenderSettings settings_;
    SceneNeeds needs_;
    std::optional<GpuScene<B>> scene_;
    Graph<B> graph_;
    GraphTexture hdr_, depth_, display_;
    SmallVector<GraphTexture, 5> colors_;
    GBufferTargets gbuffer_;
    std::optional<ShadowMapPass<B>> shadow_map_pass_;
    std::optional<GBufferPass<B>> gbuffer_pass_;
    std::optional<LightListsPass<B>> light_lists_pass_;
    std::optional<LightingPass<B>> lighting_pass_;
    std::optional<LightVolumesPass<B>> light_volumes_pass_;
    Translucent<B> translucent_;
    std::optional<TonemapPass<B>> tonemap_pass_;
    std::optional<FrameClock<B>> clock_;
    Camera camera_;  ///< of the last frame
    std::vector<std::string> warnings_;
    std::uint32_t pipelines_ = 0;
};

template <rhi::Backend B>
Renderer<B>::~Renderer() = default;

}  // namespace pellucid::inline v0_1

#include <pellucid/renderer/renderer-inl.hpp>
