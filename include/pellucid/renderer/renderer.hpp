// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The one-call renderer: a scene, a camera and settings in; a picture and an account of what it took out.
///
/// No pass is seen here: the bodies are in renderer/renderer-inl.hpp, and the backends' libraries have them.  For a
/// backend without a library (a wrapper such as `Counted<B>`, or your own) one file of the program includes them and
/// instantiates the class.
#include <pellucid/measure/gpu_timer.hpp>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/stats.hpp>
#include <pellucid/rhi/readback.hpp>
#include <memory>
#include <span>
#include <vector>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
class GpuShadows;  // renderer/gpu_shadows.hpp

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
    ~Renderer();

    /// Records and submits one frame; returns at once, but for methods that must see on the CPU what the GPU counted
    /// (settings.transparency: abuffer waits once).  Errors: device loss, memory, a memory budget that is too small.
    [[nodiscard]] Result<rhi::Ticket> render(const Camera& camera);

    /// Lights that take the place of the scene's from the next frame on; nothing is built again, and the picture is
    /// that of a new renderer, bit for bit.  As many of them as the scene has, in its order, each of the same kind,
    /// with a range where that one has one and, where shadow maps are drawn, with as many maps (renderer/needs.hpp:
    /// spots wider than widest_shadow_spot take six).  Error: `invalid_argument`, and nothing changes.
    [[nodiscard]] Result<void> set_lights(std::span<const Light> lights);
    /// RenderSettings::exposure_ev from the next frame on.
    void set_exposure(float ev) noexcept;

    /// `[h, w, 4]` linear radiance before the tone curve, of the last frame; waits for it.
    [[nodiscard]] Result<ImageF> read_hdr();
    /// `[h, w, 4]` display-referred sRGB codes of the last frame; waits for it.
    [[nodiscard]] Result<Image8> read_display();
    /// The texels of a G-buffer target, in the order of gbuffer_formats, or depth for `depth_index`; waits.  Needs
    /// settings.keep_gbuffer and an opaque surface in the scene, else `invalid_argument`.
    [[nodiscard]] Result<rhi::Texels> read_gbuffer(std::size_t index);

    /// The words of needs().grid (gpu/light_lists.h) of the last frame; waits.  Empty for methods without lists.
    [[nodiscard]] Result<std::vector<std::uint32_t>> read_light_lists();

    /// `[size, size]` depths of a layer of the shadow maps of the last frame; waits.  `invalid_argument` where there is
    /// no such layer.
    [[nodiscard]] Result<rhi::Texels> read_shadow_map(std::uint32_t layer);
    /// What the layers of the shadow maps are views of; null where no light has one.
    [[nodiscard]] const GpuShadows<B>* shadows() const noexcept;

    /// `[h, w, 1]` translucent fragments in front of what is opaque, of the last frame; counts them in a frame of its
    /// own and waits.  `unsupported` on devices without float32_blending.
    [[nodiscard]] Result<Image<std::uint32_t>> count_layers();
    /// `[h, w, 1]` fragments that the last frame composited in each pixel (`interleaved`: surfaces that it lit), with
    /// settings.audit; waits.
    [[nodiscard]] Result<Image<std::uint32_t>> read_composited();
    /// In [0,1]: a bound of what fragments that the last frame left out are worth, as a share of the largest radiance
    /// behind; waits.  `invalid_argument` for methods without one: those that do not heed min_transmittance.
    [[nodiscard]] Result<double> read_transmittance_left();

    /// The texture of `read_display`, for windows and passes of the user's own (usages sampled and copy_source).
    [[nodiscard]] rhi::Texture display() const noexcept;
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] const SceneNeeds& needs() const noexcept;
    [[nodiscard]] const RenderSettings& settings() const noexcept;
    /// GPU time of each pass of the newest frame whose timestamps have arrived; empty on devices without timestamps.
    [[nodiscard]] Result<std::span<const measure::GpuSpan>> gpu_times();
    /// Targets of the G-buffer, for passes of the user's own; null handles where the scene has nothing opaque.
    [[nodiscard]] const GBufferTargets& gbuffer() const noexcept;
    [[nodiscard]] const SceneBinding& scene_binding() const noexcept;

private:
    struct Parts;  ///< the scene on the GPU, the graph and its passes
    explicit Renderer(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace pellucid::inline v0_1
