// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Deferred lighting: every light of the scene at every covered pixel, by a loop, in a compute or a fragment shader.
#include <pellucid/gpu/interleaved.h>
#include <pellucid/gpu/lighting.h>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/shaders/full_screen.hpp>
#include <pellucid/shaders/lighting.hpp>

namespace pellucid::inline v0_1 {

/// Where lighting runs: a compute shader, or a full-screen triangle.
enum class ShadingStage : std::uint8_t { compute, fragment };
/// The reflection model (reference/brdf.hpp).
enum class Brdf : std::uint8_t {
    gltf,         ///< GGX (Lagrange form), height-correlated Smith, Schlick, diffuse (1 - F)(1 - metallic) base / pi
    seed,         ///< the terms of the document the project grew from, kept to be measured
    blinn_phong,  ///< likewise
    conserving    ///< gltf's lobe, what it scatters more than once, and a diffuse part with exactly the rest
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(ShadingStage s) noexcept {
    return s == ShadingStage::compute ? "compute" : "fragment";
}
/// As programs spell it.
[[nodiscard]] constexpr const char* name(Brdf b) noexcept {
    constexpr const char* names[] = {"gltf", "seed", "blinn-phong", "conserving"};
    return names[static_cast<std::size_t>(b)];
}

/// What is lit, where and by which model.
struct LightingDesc {
    GBufferLayout layout = GBufferLayout::compact;
    bool emissive = false;  ///< the G-buffer has a target for emitted radiance
    ShadingStage stage = ShadingStage::compute;
    Brdf brdf = Brdf::gltf;
    std::uint32_t needs = PELLUCID_NEED_ALL;
    bool exact = false;
};

/// One translucent surface a pixel, to be lit beside the opaque one (passes/interleaved.hpp).  `[h, w]` each.
struct LayerLight {
    rhi::Texture nodes = {}, looks = {};  ///< rgba32_uint, sampled; null: none is lit
    rhi::Texture output = {};             ///< rgba16_float, with the usage that `hdr` has; what light adds to them
};

/// `hdr = emitted + ambient · occlusion · base + Σ f(v, l) N·L E(light)` where depth is not 0, else the background.
/// Linear radiance, alpha 1.  Formulae and sources: reference/brdf.hpp, reference/lighting.hpp.  Shaders:
/// shaders/lighting.
template <rhi::Backend B>
class LightingPass {
public:
    /// `hdr`: rgba16_float, `[h, w]` like the G-buffer; storage usage for the compute stage, attachment for the other.
    /// Errors: those of pipeline and group creation.
    [[nodiscard]] static Result<LightingPass> create(typename B::Device& device, const LightingDesc& desc,
                                                     const GBufferTargets& gbuffer, rhi::Texture hdr,
                                                     const LayerLight& layers = {});
    /// Records one pass that writes every pixel of `hdr`, and of the layers' light.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const SceneBinding& scene) const;

private:
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
    rhi::Uses uses_ = {};
    rhi::Texture hdr_ = {}, layer_light_ = {};
    Extent2D size_ = {};
    ShadingStage stage_ = ShadingStage::compute;
};

// ------------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// Group 1 of a pass that reads a G-buffer: its textures, and `output` as a storage image if there is one.
inline rhi::GroupDesc gbuffer_group(const GBufferTargets& gbuffer, bool emissive, rhi::Sampler sampler,
                                    rhi::Texture output, const char* debug_name) {
    rhi::GroupDesc group{.slot = rhi::GroupSlot::pass, .debug_name = debug_name};
    auto add = [&](std::uint32_t binding, rhi::Texture texture) {
        group.layout.bindings.push_back({binding, rhi::BindingKind::sampled_texture});
        group.bindings.push_back({.binding = binding, .texture = texture, .sampler = sampler});
    };
    const std::size_t surfaces = gbuffer.colors.size() - (emissive ? 1 : 0);
    for (std::size_t i = 0; i < surfaces; ++i)
        add(PELLUCID_GBUFFER_0 + static_cast<std::uint32_t>(i), gbuffer.colors[i]);
    // A binding that no branch reads still wants a texture of its type.
    add(PELLUCID_GBUFFER_EMISSIVE, emissive ? gbuffer.colors[surfaces] : gbuffer.colors[1]);
    add(PELLUCID_GBUFFER_DEPTH, gbuffer.depth);
    if (output) {
        group.layout.bindings.push_back({PELLUCID_LIGHTING_OUTPUT, rhi::BindingKind::storage_texture});
        group.bindings.push_back({.binding = PELLUCID_LIGHTING_OUTPUT, .texture = output});
    }
    return group;
}

/// Adds the layers to the group of a lighting pass.
inline void add_layers(rhi::GroupDesc& group, rhi::Sampler sampler, const LayerLight& layers, bool compute) {
    const auto add = [&](std::uint32_t binding, rhi::BindingKind kind, const rhi::Binding& bound) {
        group.layout.bindings.push_back({binding, kind});
        group.bindings.push_back(bound);
    };
    using enum rhi::BindingKind;
    constexpr std::uint32_t nodes = PELLUCID_INTERLEAVED_NODES, looks = PELLUCID_INTERLEAVED_LOOKS;
    add(nodes, sampled_texture, {.binding = nodes, .texture = layers.nodes, .sampler = sampler});
    add(looks, sampled_texture, {.binding = looks, .texture = layers.looks, .sampler = sampler});
    if (compute)
        add(PELLUCID_INTERLEAVED_OUTPUT, storage_texture,
            {.binding = PELLUCID_INTERLEAVED_OUTPUT, .texture = layers.output});
}

}  // namespace detail

template <rhi::Backend B>
Result<LightingPass<B>> LightingPass<B>::create(typename B::Device& device, const LightingDesc& desc,
                                                const GBufferTargets& gbuffer, rhi::Texture hdr,
                                                const LayerLight& layers) {
    LightingPass pass;
    pass.hdr_ = hdr;
    pass.layer_light_ = layers.output;
    pass.size_ = gbuffer.size;
    pass.stage_ = desc.stage;
    const bool compute = desc.stage == ShadingStage::compute;
    const bool compact = desc.layout == GBufferLayout::compact;
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("lighting.gbuffer")));
    rhi::GroupDesc group =
        detail::gbuffer_group(gbuffer, desc.emissive, pass.sampler_, compute ? hdr : rhi::Texture{}, "lighting");
    if (layers.output) {
        detail::add_layers(group, pass.sampler_, layers, compute);
        for (const rhi::Texture t : {layers.nodes, layers.looks})
            pass.uses_.push_back(rhi::use(t, rhi::Access::sampled));
        if (compute) pass.uses_.push_back(rhi::use(layers.output, rhi::Access::storage_write));
    }
    PELLUCID_OWN(pass.group_, device, device.make_group(group));
    for (const rhi::Texture texture : gbuffer.colors) pass.uses_.push_back(rhi::use(texture, rhi::Access::sampled));
    pass.uses_.push_back(rhi::use(gbuffer.depth, rhi::Access::sampled));
    if (compute) pass.uses_.push_back(rhi::use(hdr, rhi::Access::storage_write));

    // Translucent surfaces alone may emit: without a target there is no emitted radiance to read.
    const std::uint32_t needs = desc.emissive ? desc.needs : desc.needs & ~PELLUCID_NEED_EMISSIVE;
    const rhi::SpecConstant constants[] = {{0, needs}, {1, static_cast<std::uint32_t>(desc.brdf)}};
    using namespace shaders;
    const rhi::Shader* const all[2][2][2][2] = {
        {{{&lighting_comp, &lighting_comp_exact}, {&lighting_frag, &lighting_frag_exact}},
         {{&lighting_classic_comp, &lighting_classic_comp_exact},
          {&lighting_classic_frag, &lighting_classic_frag_exact}}},
        {{{&lighting_layers_comp, &lighting_layers_comp_exact}, {&lighting_layers_frag, &lighting_layers_frag_exact}},
         {{&lighting_classic_layers_comp, &lighting_classic_layers_comp_exact},
          {&lighting_classic_layers_frag, &lighting_classic_layers_frag_exact}}}};
    const rhi::Shader* const shader = all[layers.output ? 1 : 0][compact ? 0 : 1][compute ? 0 : 1][desc.exact ? 1 : 0];
    SmallVector<rhi::ColorTarget, rhi::max_color_attachments> colors{{.format = rhi::Format::rgba16_float}};
    if (layers.output) colors.push_back({.format = rhi::Format::rgba16_float});
    if (compute) {
        PELLUCID_OWN(pass.pipeline_, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = shader,
                                                                   .constants = constants,
                                                                   .pass_group = group.layout,
                                                                   .scene_group = scene_group_layout(),
                                                                   .debug_name = "lighting"}));
    } else {
        PELLUCID_OWN(pass.pipeline_, device,
                     device.make_pipeline(rhi::GraphicsPipelineDesc{.vertex = &full_screen_vert,
                                                                    .fragment = shader,
                                                                    .constants = constants,
                                                                    .pass_group = group.layout,
                                                                    .scene_group = scene_group_layout(),
                                                                    .colors = colors,
                                                                    .cull = rhi::Cull::none,
                                                                    .debug_name = "lighting"}));
    }
    return pass;
}

template <rhi::Backend B>
void LightingPass<B>::record(typename B::Commands& cmd, const SceneBinding& scene) const {
    rhi::Uses uses = scene.uses;
    for (const rhi::ResourceUse& u : uses_) uses.push_back(u);
    const bool compute = stage_ == ShadingStage::compute;
    if (compute) {
        cmd.begin_compute({.uses = uses, .name = "lighting"});
    } else {
        rhi::RenderPassDesc pass{
            .colors = {{.texture = hdr_, .load = rhi::Load::discard}}, .uses = uses, .size = size_, .name = "lighting"};
        if (layer_light_) pass.colors.push_back({.texture = layer_light_, .load = rhi::Load::discard});
        cmd.begin_render(pass);
    }
    cmd.bind_pipeline(pipeline_);
    cmd.bind_frame(scene.frame, scene.records);
    cmd.bind_group(group_);
    cmd.bind_group(scene.group);
    if (compute) {
        constexpr std::uint32_t width = PELLUCID_LIGHTING_GROUP_SIZE, height = width * PELLUCID_LIGHTING_PIXELS;
        cmd.dispatch((size_.width + width - 1) / width, (size_.height + height - 1) / height, 1);
        cmd.end_compute();
    } else {
        cmd.draw({.vertex_count = 3});
        cmd.end_render();
    }
}

}  // namespace pellucid::inline v0_1
