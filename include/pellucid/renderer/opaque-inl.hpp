// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Opaque<B>.
#include <pellucid/renderer/opaque.hpp>
#include <bit>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
void Opaque<B>::start(Graph<B>& graph, GpuScene<B>& scene, const SceneNeeds& needs, const RenderSettings& settings,
                      const Camera& camera, const FrameTargets& targets) {
    graph_ = &graph;
    scene_ = &scene;
    needs_ = &needs;
    settings_ = &settings;
    camera_ = &camera;
    targets_ = targets;
}

template <rhi::Backend B>
void Opaque<B>::declare_shadows() {
    if (settings_->shadows == Shadows::none) return;
    if (needs_->shadows == Shadows::none) return graph_->leave_out("shadow_map", needs_->shadows_why);
    graph_->add(
        {.name = "shadow_map", .live = true},
        [this](typename B::Device& device) -> Result<void> {
            const GpuShadows<B>& shadows = *scene_->shadows();
            PELLUCID_TRY(shadow_map_pass_, ShadowMapPass<B>::create(device, {.needs = needs_->mask,
                                                                             .opaque_culls = shadows.culls(false),
                                                                             .masked_culls = shadows.culls(true)}));
            pipelines_ += shadow_map_pass_->pipelines();
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            return scene_->draw_shadows(frame.commands(), *shadow_map_pass_, *camera_, *settings_);
        });
}

template <rhi::Backend B>
Result<void> Opaque<B>::create_fill(typename B::Device& device, const GBufferDesc& desc) {
    PELLUCID_TRY(gbuffer_pass_, GBufferPass<B>::create(device, desc));
    pipelines_ += static_cast<std::uint32_t>(std::popcount(desc.culls));
    return {};
}

template <rhi::Backend B>
void Opaque<B>::declare_gbuffer() {
    constexpr const char* compact_names[] = {"gbuffer.normal", "gbuffer.base", "gbuffer.material", "gbuffer.emissive"};
    constexpr const char* classic_names[] = {"gbuffer.position", "gbuffer.normal", "gbuffer.base", "gbuffer.material",
                                             "gbuffer.emissive"};
    using enum rhi::TextureUsage;
    const auto formats = gbuffer_formats(settings_->gbuffer, needs_->emissive_target);
    for (std::size_t i = 0; i < formats.size(); ++i)
        colors_.push_back(graph_->texture(
            {.size = settings_->size,
             .format = formats[i],
             .usage = attachment | sampled | copy_source,
             .debug_name = settings_->gbuffer == GBufferLayout::compact ? compact_names[i] : classic_names[i]}));
    GraphPassDesc fill{.name = "gbuffer", .writes = {targets_.depth}};
    for (const GraphTexture t : colors_) fill.writes.push_back(t);
    graph_->add(
        fill,
        [this](typename B::Device& device) -> Result<void> {
            gbuffer_ = {.depth = (*graph_)[targets_.depth], .size = settings_->size};
            for (const GraphTexture t : colors_) gbuffer_.colors.push_back((*graph_)[t]);
            return create_fill(device, {.layout = settings_->gbuffer,
                                        .emissive = needs_->emissive_target,
                                        .needs = needs_->mask,
                                        .culls = scene_->opaque_culls()});
        },
        [this](typename B::Commands& cmd) { record_fill(cmd); });
}

template <rhi::Backend B>
void Opaque<B>::declare_light_lists(GraphTexture depth) {
    if (needs_->grid.empty()) return;
    GraphPassDesc fill{.name = "light_lists", .live = true};
    if (needs_->grid.slices == 0) fill.reads.push_back(depth);
    graph_->add(
        fill,
        [this, depth](typename B::Device& device) -> Result<void> {
            const GpuLights<B>& lights = scene_->lights();
            PELLUCID_TRY(light_lists_pass_, LightListsPass<B>::create(device, needs_->grid, lights.bounds(),
                                                                      lights.lists(), (*graph_)[depth]));
            pipelines_ += light_lists_pass_->pipelines();
            return {};
        },
        [this](typename B::Commands& cmd) { light_lists_pass_->record(cmd, scene_->binding()); });
}

template <rhi::Backend B>
void Opaque<B>::declare_lighting(const LightingChanges& changes) {
    const GraphTexture depth = changes.depth ? changes.depth : targets_.depth;
    const GraphTexture output = changes.output ? changes.output : targets_.hdr;
    declare_light_lists(depth);
    GraphPassDesc light{.name = "lighting", .reads = {depth}, .writes = {output}};
    for (const GraphTexture t : colors_) light.reads.push_back(t);
    if (changes.layer_light) {
        light.reads.push_back(changes.nodes);
        light.reads.push_back(changes.looks);
        light.writes.push_back(changes.layer_light);
    }
    graph_->add(
        light,
        [this, changes, depth, output](typename B::Device& device) -> Result<void> {
            LayerLight layers;
            if (changes.layer_light)
                layers = {.nodes = (*graph_)[changes.nodes],
                          .looks = (*graph_)[changes.looks],
                          .output = (*graph_)[changes.layer_light]};
            PELLUCID_TRY(lighting_pass_,
                         LightingPass<B>::create(device, lighting_desc(), surfaces(depth), (*graph_)[output], layers));
            ++pipelines_;
            return {};
        },
        [this](typename B::Commands& cmd) { lighting_pass_->record(cmd, scene_->binding()); });
    declare_light_volumes(depth, output);
}

/// Lights that are drawn as volumes add to what the lighting pass wrote.
template <rhi::Backend B>
void Opaque<B>::declare_light_volumes(GraphTexture depth, GraphTexture output) {
    if (needs_->assignment != LightAssignment::volumes) return;
    GraphPassDesc add{.name = "light_volumes", .reads = {depth, output}, .writes = {output}};
    for (const GraphTexture t : colors_) add.reads.push_back(t);
    graph_->add(
        add,
        [this, depth, output](typename B::Device& device) -> Result<void> {
            const GpuLights<B>& lights = scene_->lights();
            PELLUCID_TRY(light_volumes_pass_,
                         LightVolumesPass<B>::create(device, lighting_desc(), surfaces(depth), (*graph_)[output],
                                                     lights.sources(), lights.first_ranged()));
            pipelines_ += light_volumes_pass_->pipelines();
            return {};
        },
        [this](typename B::Commands& cmd) { light_volumes_pass_->record(cmd, scene_->binding()); });
}

template <rhi::Backend B>
void Opaque<B>::declare_unlit() {
    if (needs_->opaque)
        declare_emitted();
    else
        declare_background();
    declare_light_lists(targets_.depth);
}

/// No light falls on anything opaque: no G-buffer and no lighting pass; what is emitted is the picture.
template <rhi::Backend B>
void Opaque<B>::declare_emitted() {
    graph_->leave_out("gbuffer", "no light falls on an opaque surface");
    graph_->leave_out("lighting", "no light falls on an opaque surface");
    graph_->add(
        {.name = "emitted", .writes = {targets_.hdr, targets_.depth}},
        [this](typename B::Device& device) -> Result<void> {
            const glm::vec3 b = settings_->background;
            gbuffer_ = {.colors = {(*graph_)[targets_.hdr]},
                        .depth = (*graph_)[targets_.depth],
                        .size = settings_->size,
                        .background = {b.x, b.y, b.z}};
            return create_fill(device, {.emitted_only = true, .needs = needs_->mask, .culls = scene_->opaque_culls()});
        },
        [this](typename B::Commands& cmd) { record_fill(cmd); });
}

/// Nothing opaque: no G-buffer and no lighting pass; one clear stands for both.
template <rhi::Backend B>
void Opaque<B>::declare_background() {
    graph_->leave_out("gbuffer", "the scene has no opaque surface");
    graph_->leave_out("lighting", "the scene has no opaque surface");
    GraphPassDesc clear{.name = "background", .writes = {targets_.hdr}};
    if (targets_.depth) clear.writes.push_back(targets_.depth);
    graph_->add(
        clear, [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) {
            const glm::vec3 b = settings_->background;
            rhi::RenderPassDesc pass{.colors = {{.texture = (*graph_)[targets_.hdr], .clear = {b.x, b.y, b.z, 1}}},
                                     .size = settings_->size,
                                     .name = "background"};
            if (targets_.depth) pass.depth.texture = (*graph_)[targets_.depth];
            cmd.begin_render(pass);
            cmd.end_render();
        });
}

template <rhi::Backend B>
void Opaque<B>::update_lights() {
    if (light_volumes_pass_)
        light_volumes_pass_->set_lights(scene_->lights().sources(), scene_->lights().first_ranged());
}

template <rhi::Backend B>
void Opaque<B>::add_resources(std::vector<TextureReport>& out) const {
    if (light_volumes_pass_)
        light_volumes_pass_->each_resource([&](const char* debug_name, std::uint64_t bytes) {
            out.push_back({debug_name, bytes, false});
        });
}

}  // namespace pellucid::inline v0_1
