// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The last pass: exposure, tone curve, sRGB encoding to 8 bits.
#include <pellucid/gpu/bindings.h>
#include <pellucid/gpu/tonemap.h>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/tonemap.hpp>

namespace pellucid::inline v0_1 {

/// From linear radiance to display-referred colour (reference/tonemap.hpp has the formulae).
enum class ToneCurve : std::uint8_t {
    none = PELLUCID_TONEMAP_NONE,          ///< clamp to [0,1]
    reinhard = PELLUCID_TONEMAP_REINHARD,  ///< c / (1 + c), per channel
    neutral = PELLUCID_TONEMAP_NEUTRAL,    ///< Khronos PBR Neutral: base colours below 0.76 come out as they went in
    aces = PELLUCID_TONEMAP_ACES,          ///< Narkowicz 2015
    agx = PELLUCID_TONEMAP_AGX             ///< Sobotka's AgX, polynomial sigmoid
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(ToneCurve c) noexcept {
    constexpr const char* names[] = {"none", "reinhard", "neutral", "aces", "agx"};
    return names[static_cast<std::size_t>(c)];
}

/// `display = sRGB(curve(hdr · exposure))`; the exposure is in the frame's FrameParams.  NaN and negative values become
/// 0, infinities the largest value.  Reference: reference/tonemap.hpp.  Shader: shaders/tonemap.
template <rhi::Backend B>
class TonemapPass {
public:
    /// `hdr`: rgba16_float, sampled.  `display`: rgba8_unorm, storage, the same size; its bytes are sRGB codes.
    [[nodiscard]] static Result<TonemapPass> create(typename B::Device& device, ToneCurve curve, rhi::Texture hdr,
                                                    rhi::Texture display, Extent2D size);
    /// Records one compute pass that writes every pixel of `display`.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, rhi::UniformSlice frame) const;

private:
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
    rhi::Texture hdr_ = {}, display_ = {};
    Extent2D size_ = {};
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<TonemapPass<B>> TonemapPass<B>::create(typename B::Device& device, ToneCurve curve, rhi::Texture hdr,
                                              rhi::Texture display, Extent2D size) {
    TonemapPass pass;
    pass.hdr_ = hdr;
    pass.display_ = display;
    pass.size_ = size;
    const rhi::GroupLayout layout{{{PELLUCID_TONEMAP_OUTPUT, rhi::BindingKind::storage_texture},
                                   {PELLUCID_TONEMAP_INPUT, rhi::BindingKind::sampled_texture}}};
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("tonemap.input")));
    PELLUCID_OWN(
        pass.group_, device,
        device.make_group({.slot = rhi::GroupSlot::pass,
                           .layout = layout,
                           .bindings = {{.binding = PELLUCID_TONEMAP_OUTPUT, .texture = display},
                                        {.binding = PELLUCID_TONEMAP_INPUT, .texture = hdr, .sampler = pass.sampler_}},
                           .debug_name = "tonemap"}));
    const rhi::SpecConstant constants[] = {{2, static_cast<std::uint32_t>(curve)}};
    PELLUCID_OWN(
        pass.pipeline_, device,
        device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shaders::tonemap_comp, .constants = constants, .pass_group = layout, .debug_name = "tonemap"}));
    return pass;
}

template <rhi::Backend B>
void TonemapPass<B>::record(typename B::Commands& cmd, rhi::UniformSlice frame) const {
    cmd.begin_compute({.uses = {rhi::use(hdr_, rhi::Access::sampled), rhi::use(display_, rhi::Access::storage_write)},
                       .name = "tonemap"});
    cmd.bind_pipeline(pipeline_);
    cmd.bind_frame(frame, {});
    cmd.bind_group(group_);
    constexpr std::uint32_t tile = PELLUCID_TONEMAP_GROUP_SIZE;
    cmd.dispatch((size_.width + tile - 1) / tile, (size_.height + tile - 1) / tile, 1);
    cmd.end_compute();
}

}  // namespace pellucid::inline v0_1
