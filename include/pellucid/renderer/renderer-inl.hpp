// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Renderer<B>.
#include <pellucid/renderer/renderer.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
Result<std::unique_ptr<Renderer<B>>> Renderer<B>::create(typename B::Device& device, const Scene& scene,
                                                         const RenderSettings& settings) {
    const std::uint32_t limit = device.info().max_texture_size;
    if (settings.size.width == 0 || settings.size.height == 0 || settings.size.width > limit ||
        settings.size.height > limit)
        return Error{Errc::invalid_argument, "the picture's size is " + std::to_string(settings.size.width) + "x" +
                                                 std::to_string(settings.size.height) + "; each side must be 1 to " +
                                                 std::to_string(limit) + " on " + device.info().name};
    PELLUCID_CHECK(check_device(settings.transparency, device.info()));
    PELLUCID_CHECK(check_lights(scene.lights));
    PELLUCID_CHECK(check_environment(settings.environment));
    PELLUCID_CHECK(check_shadows(scene_needs(scene, settings), settings, device.info()));
    std::unique_ptr<Renderer> renderer(new Renderer(device));
    renderer->settings_ = settings;
    PELLUCID_CHECK(renderer->build(scene));
    return renderer;
}

template <rhi::Backend B>
Result<void> Renderer<B>::build(const Scene& scene) {
    needs_ = scene_needs(scene, settings_);
    warnings_ = scene.warnings;
    PELLUCID_TRY(scene_, GpuScene<B>::create(*device_, scene, settings_));
    pipelines_ += scene_->environment().pipelines();
    PELLUCID_TRY(clock_, FrameClock<B>::create(*device_));

    using enum rhi::TextureUsage;
    auto target = [&](rhi::Format format, rhi::TextureUsage usage, const char* debug_name) {
        return graph_.texture({.size = settings_.size, .format = format, .usage = usage, .debug_name = debug_name});
    };
    const bool fragment = settings_.shading == ShadingStage::fragment;
    rhi::TextureUsage hdr_usage = sampled | copy_source | (fragment ? attachment : storage);
    if (needs_.translucent || !needs_.lighting) hdr_usage |= attachment | storage;
    if (needs_.assignment == LightAssignment::volumes) hdr_usage |= storage;
    hdr_ = target(rhi::Format::rgba16_float, hdr_usage, "hdr");
    display_ = target(rhi::Format::rgba8_unorm, storage | sampled | copy_source, "display");
    if (needs_.opaque || needs_.translucent)
        depth_ = target(rhi::Format::d32_float, attachment | sampled | copy_source, "depth");

    translucent_.start(graph_, *scene_, needs_, settings_, {.hdr = hdr_, .depth = depth_});
    declare_shadows();
    if (needs_.lighting) {
        declare_gbuffer();
        const LightingChanges changes = translucent_.declare_before_lighting(colors_, gbuffer_);
        declare_light_lists(changes.depth ? changes.depth : depth_);
        declare_lighting(changes);
        declare_light_volumes(changes);
    } else if (needs_.opaque) {
        declare_emitted();
        declare_light_lists(depth_);
    } else {
        declare_background();
        declare_light_lists(depth_);
    }
    translucent_.declare_after_lighting();
    declare_tonemap();
    graph_.keep(hdr_);
    graph_.keep(display_);
    if (needs_.translucent) graph_.keep(depth_);
    if (settings_.keep_gbuffer && needs_.opaque) {
        for (const GraphTexture t : colors_) graph_.keep(t);
        graph_.keep(depth_);
    }
    return graph_.compile(*device_);
}

template <rhi::Backend B>
void Renderer<B>::declare_shadows() {
    if (settings_.shadows == Shadows::none) return;
    if (needs_.shadows == Shadows::none) return graph_.leave_out("shadow_map", needs_.shadows_why);
    graph_.add(
        {.name = "shadow_map", .live = true},
        [this](typename B::Device& device) -> Result<void> {
            const GpuShadows<B>& shadows = *scene_->shadows();
            PELLUCID_TRY(shadow_map_pass_, ShadowMapPass<B>::create(device, {.needs = needs_.mask,
                                                                             .opaque_culls = shadows.culls(false),
                                                                             .masked_culls = shadows.culls(true)}));
            pipelines_ += shadow_map_pass_->pipelines();
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            return scene_->draw_shadows(frame.commands(), *shadow_map_pass_, camera_, settings_);
        });
}

template <rhi::Backend B>
void Renderer<B>::declare_gbuffer() {
    constexpr const char* compact_names[] = {"gbuffer.normal", "gbuffer.base", "gbuffer.material", "gbuffer.emissive"};
    constexpr const char* classic_names[] = {"gbuffer.position", "gbuffer.normal", "gbuffer.base", "gbuffer.material",
                                             "gbuffer.emissive"};
    using enum rhi::TextureUsage;
    const auto formats = gbuffer_formats(settings_.gbuffer, needs_.emissive_target);
    for (std::size_t i = 0; i < formats.size(); ++i)
        colors_.push_back(graph_.texture(
            {.size = settings_.size,
             .format = formats[i],
             .usage = attachment | sampled | copy_source,
             .debug_name = settings_.gbuffer == GBufferLayout::compact ? compact_names[i] : classic_names[i]}));
    GraphPassDesc fill{.name = "gbuffer", .writes = {depth_}};
    for (const GraphTexture t : colors_) fill.writes.push_back(t);
    graph_.add(
        fill,
        [this](typename B::Device& device) -> Result<void> {
            gbuffer_ = {.depth = graph_[depth_], .size = settings_.size};
            for (const GraphTexture t : colors_) gbuffer_.colors.push_back(graph_[t]);
            PELLUCID_TRY(gbuffer_pass_, GBufferPass<B>::create(device, {.layout = settings_.gbuffer,
                                                                        .emissive = needs_.emissive_target,
                                                                        .needs = needs_.mask,
                                                                        .culls = scene_->opaque_culls()}));
            pipelines_ += static_cast<std::uint32_t>(std::popcount(scene_->opaque_culls()));
            return {};
        },
        [this](typename B::Commands& cmd) {
            gbuffer_pass_->record(cmd, gbuffer_, scene_->binding(), scene_->opaque());
        });
}

template <rhi::Backend B>
void Renderer<B>::declare_light_lists(GraphTexture depth) {
    if (needs_.grid.empty()) return;
    GraphPassDesc fill{.name = "light_lists", .live = true};
    if (needs_.grid.slices == 0) fill.reads.push_back(depth);
    graph_.add(
        fill,
        [this, depth](typename B::Device& device) -> Result<void> {
            const GpuLights<B>& lights = scene_->lights();
            PELLUCID_TRY(light_lists_pass_, LightListsPass<B>::create(device, needs_.grid, lights.bounds(),
                                                                      lights.lists(), graph_[depth]));
            pipelines_ += light_lists_pass_->pipelines();
            return {};
        },
        [this](typename B::Commands& cmd) { light_lists_pass_->record(cmd, scene_->binding()); });
}

template <rhi::Backend B>
void Renderer<B>::declare_lighting(const LightingChanges& changes) {
    const GraphTexture depth = changes.depth ? changes.depth : depth_;
    const GraphTexture output = changes.output ? changes.output : hdr_;
    GraphPassDesc light{.name = "lighting", .reads = {depth}, .writes = {output}};
    for (const GraphTexture t : colors_) light.reads.push_back(t);
    if (changes.layer_light) {
        light.reads.push_back(changes.nodes);
        light.reads.push_back(changes.looks);
        light.writes.push_back(changes.layer_light);
    }
    graph_.add(
        light,
        [this, changes, depth, output](typename B::Device& device) -> Result<void> {
            GBufferTargets surfaces = gbuffer_;
            surfaces.depth = graph_[depth];
            LayerLight layers;
            if (changes.layer_light)
                layers = {.nodes = graph_[changes.nodes],
                          .looks = graph_[changes.looks],
                          .output = graph_[changes.layer_light]};
            PELLUCID_TRY(lighting_pass_,
                         LightingPass<B>::create(device, lighting_desc(), surfaces, graph_[output], layers));
            ++pipelines_;
            return {};
        },
        [this](typename B::Commands& cmd) { lighting_pass_->record(cmd, scene_->binding()); });
}

/// Lights that are drawn as volumes add to what the lighting pass wrote.
template <rhi::Backend B>
void Renderer<B>::declare_light_volumes(const LightingChanges& changes) {
    if (needs_.assignment != LightAssignment::volumes) return;
    const GraphTexture depth = changes.depth ? changes.depth : depth_;
    const GraphTexture output = changes.output ? changes.output : hdr_;
    GraphPassDesc add{.name = "light_volumes", .reads = {depth, output}, .writes = {output}};
    for (const GraphTexture t : colors_) add.reads.push_back(t);
    graph_.add(
        add,
        [this, depth, output](typename B::Device& device) -> Result<void> {
            GBufferTargets surfaces = gbuffer_;
            surfaces.depth = graph_[depth];
            const GpuLights<B>& lights = scene_->lights();
            PELLUCID_TRY(light_volumes_pass_,
                         LightVolumesPass<B>::create(device, lighting_desc(), surfaces, graph_[output],
                                                     lights.sources(), lights.first_ranged()));
            pipelines_ += light_volumes_pass_->pipelines();
            return {};
        },
        [this](typename B::Commands& cmd) { light_volumes_pass_->record(cmd, scene_->binding()); });
}

/// No light falls on anything opaque: no G-buffer and no lighting pass; what is emitted is the picture.
template <rhi::Backend B>
void Renderer<B>::declare_emitted() {
    graph_.leave_out("gbuffer", "no light falls on an opaque surface");
    graph_.leave_out("lighting", "no light falls on an opaque surface");
    graph_.add(
        {.name = "emitted", .writes = {hdr_, depth_}},
        [this](typename B::Device& device) -> Result<void> {
            const glm::vec3 b = settings_.background;
            gbuffer_ = {.colors = {graph_[hdr_]},
                        .depth = graph_[depth_],
                        .size = settings_.size,
                        .background = {b.x, b.y, b.z}};
            PELLUCID_TRY(gbuffer_pass_,
                         GBufferPass<B>::create(
                             device, {.emitted_only = true, .needs = needs_.mask, .culls = scene_->opaque_culls()}));
            pipelines_ += static_cast<std::uint32_t>(std::popcount(scene_->opaque_culls()));
            return {};
        },
        [this](typename B::Commands& cmd) {
            gbuffer_pass_->record(cmd, gbuffer_, scene_->binding(), scene_->opaque());
        });
}

/// Nothing opaque: no G-buffer and no lighting pass; one clear stands for both.
template <rhi::Backend B>
void Renderer<B>::declare_background() {
    graph_.leave_out("gbuffer", "the scene has no opaque surface");
    graph_.leave_out("lighting", "the scene has no opaque surface");
    GraphPassDesc clear{.name = "background", .writes = {hdr_}};
    if (depth_) clear.writes.push_back(depth_);
    graph_.add(
        clear, [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) {
            const glm::vec3 b = settings_.background;
            rhi::RenderPassDesc pass{.colors = {{.texture = graph_[hdr_], .clear = {b.x, b.y, b.z, 1}}},
                                     .size = settings_.size,
                                     .name = "background"};
            if (depth_) pass.depth.texture = graph_[depth_];
            cmd.begin_render(pass);
            cmd.end_render();
        });
}

template <rhi::Backend B>
void Renderer<B>::declare_tonemap() {
    graph_.add(
        {.name = "tonemap", .reads = {hdr_}, .writes = {display_}},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(tonemap_pass_, TonemapPass<B>::create(device, settings_.tonemap, graph_[hdr_],
                                                               graph_[display_], settings_.size));
            ++pipelines_;
            return {};
        },
        [this](typename B::Commands& cmd) { tonemap_pass_->record(cmd, scene_->binding().frame); });
}

template <rhi::Backend B>
Result<void> Renderer<B>::set_lights(std::span<const Light> lights) {
    PELLUCID_CHECK(scene_->set_lights(lights));
    if (light_volumes_pass_)
        light_volumes_pass_->set_lights(scene_->lights().sources(), scene_->lights().first_ranged());
    return {};
}

template <rhi::Backend B>
Result<rhi::Ticket> Renderer<B>::render(const Camera& camera) {
    camera_ = camera;
    RenderFrame<B> frame(*device_, *scene_, *clock_, camera, settings_);
    Result<void> done = frame.open();
    if (done)
        done = graph_.execute(frame, [&](const char* name, auto&& record) {
            frame.begin_scope(name);
            record();
            frame.end_scope();
        });
    if (done) return frame.close();
    frame.abandon();
    return done.error();
}

template <rhi::Backend B>
Result<Image<std::uint32_t>> Renderer<B>::count_layers() {
    RenderFrame<B> frame(*device_, *scene_, *clock_, camera_, settings_);
    auto counts = translucent_.count_layers(*device_, frame);
    if (!counts) frame.abandon();
    return counts;
}

template <rhi::Backend B>
Result<ImageF> Renderer<B>::read_float(rhi::Texture texture) {
    rhi::Texels texels;
    PELLUCID_TRY(texels,
                 rhi::download<B>(*device_, texture, {.size = settings_.size, .format = rhi::Format::rgba16_float}));
    ImageF image(settings_.size.width, settings_.size.height, 4);
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        std::uint16_t half;
        std::memcpy(&half, texels.bytes.data() + 2 * i, 2);
        image.data[i] = half_to_float(half);
    }
    return image;
}

template <rhi::Backend B>
Result<Image8> Renderer<B>::read_display() {
    rhi::Texels texels;
    PELLUCID_TRY(texels, rhi::download<B>(*device_, graph_[display_], {.size = settings_.size}));
    Image8 image(settings_.size.width, settings_.size.height, 4);
    std::memcpy(image.data.data(), texels.bytes.data(), image.data.size());
    return image;
}

template <rhi::Backend B>
Result<rhi::Texels> Renderer<B>::read_gbuffer(std::size_t index) {
    if (!settings_.keep_gbuffer || !needs_.opaque)
        return Error{Errc::invalid_argument,
                     "there is no G-buffer to read: set keep_gbuffer, and draw an opaque surface"};
    if (index == depth_index)
        return rhi::download<B>(*device_, gbuffer_.depth, {.size = settings_.size, .format = rhi::Format::d32_float});
    const auto formats = gbuffer_formats(settings_.gbuffer, needs_.emissive_target);
    if (index >= formats.size())
        return Error{Errc::invalid_argument, "the G-buffer has " + std::to_string(formats.size()) +
                                                 " targets; number " + std::to_string(index) + " was asked for"};
    return rhi::download<B>(*device_, gbuffer_.colors[index], {.size = settings_.size, .format = formats[index]});
}

template <rhi::Backend B>
Result<rhi::Texels> Renderer<B>::read_shadow_map(std::uint32_t layer) {
    if (layer >= needs_.shadow_maps)
        return Error{Errc::invalid_argument, "layer " + std::to_string(layer) + " of the shadow maps was asked for; " +
                                                 "there are " + std::to_string(needs_.shadow_maps)};
    const std::uint32_t side = scene_->shadows()->size();
    return rhi::download<B>(*device_, scene_->shadows()->maps(),
                            {.size = {side, side}, .format = rhi::Format::d32_float}, 0, layer);
}

template <rhi::Backend B>
RenderStats Renderer<B>::stats() const {
    RenderStats stats{.passes = graph_.passes(),
                      .resources = graph_.textures(),
                      .pipelines = pipelines_ + translucent_.pipelines(),
                      .draws = static_cast<std::uint32_t>(scene_->opaque().size() + scene_->translucent().size()),
                      .triangles = scene_->triangles(),
                      .lights = scene_->lights().size(),
                      .lighting = needs_.assignment,
                      .lighting_why = needs_.assignment_why,
                      .shadows = needs_.shadows,
                      .shadows_why = needs_.shadows_why,
                      .shadow_lights = needs_.shadow_lights,
                      .shadow_maps = needs_.shadow_maps,
                      .shadows_drawn = scene_->shadows() ? scene_->shadows()->drawn() : 0,
                      .translucency = translucent_.stats(),
                      .warnings = warnings_};
    translucent_.add_resources(stats.resources);
    if (light_volumes_pass_)
        light_volumes_pass_->each_resource([&](const char* debug_name, std::uint64_t bytes) {
            stats.resources.push_back({debug_name, bytes, false});
        });
    stats.resources.insert(stats.resources.end(), scene_->resources().begin(), scene_->resources().end());
    stats.warnings.insert(stats.warnings.end(), scene_->warnings().begin(), scene_->warnings().end());
    for (const TextureReport& r : stats.resources) stats.bytes += r.bytes;
    return stats;
}

}  // namespace pellucid::inline v0_1
