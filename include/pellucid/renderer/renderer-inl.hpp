// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Renderer<B>, and the parts that it is made of.
#include <pellucid/core/half.hpp>
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/renderer/opaque.hpp>
#include <pellucid/renderer/render_frame.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/renderer/translucent.hpp>
#include <algorithm>
#include <optional>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
struct Renderer<B>::Parts {
    Parts(typename B::Device& device_, const RenderSettings& settings_) : device(device_), settings(settings_) {}
    Parts(const Parts&) = delete;  // the graph's passes hold its address
    Parts& operator=(const Parts&) = delete;
    [[nodiscard]] Result<void> build(const Scene& source);
    void declare_tonemap();

    typename B::Device& device;
    RenderSettings settings;
    SceneNeeds needs;
    Camera camera;  ///< of the last frame
    std::optional<GpuScene<B>> scene;
    Graph<B> graph;
    FrameTargets targets;
    GraphTexture display;
    Opaque<B> opaque;
    Translucent<B> translucent;
    std::optional<TonemapPass<B>> tonemap;
    std::optional<FrameClock<B>> clock;
    std::vector<std::string> warnings;
    std::uint32_t pipelines = 0;  ///< of the tone map and the environment
};

template <rhi::Backend B>
Renderer<B>::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

template <rhi::Backend B>
Renderer<B>::~Renderer() = default;

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
    auto parts = std::make_unique<Parts>(device, settings);
    PELLUCID_CHECK(parts->build(scene));
    return std::unique_ptr<Renderer>(new Renderer(std::move(parts)));
}

template <rhi::Backend B>
Result<void> Renderer<B>::Parts::build(const Scene& source) {
    needs = scene_needs(source, settings);
    warnings = source.warnings;
    PELLUCID_TRY(scene, GpuScene<B>::create(device, source, settings));
    pipelines += scene->environment().pipelines();
    PELLUCID_TRY(clock, FrameClock<B>::create(device));

    using enum rhi::TextureUsage;
    auto target = [&](rhi::Format format, rhi::TextureUsage usage, const char* debug_name) {
        return graph.texture({.size = settings.size, .format = format, .usage = usage, .debug_name = debug_name});
    };
    const bool fragment = settings.shading == ShadingStage::fragment;
    rhi::TextureUsage hdr_usage = sampled | copy_source | (fragment ? attachment : storage);
    if (needs.translucent || !needs.lighting) hdr_usage |= attachment | storage;
    if (needs.assignment == LightAssignment::volumes) hdr_usage |= storage;
    targets.hdr = target(rhi::Format::rgba16_float, hdr_usage, "hdr");
    display = target(rhi::Format::rgba8_unorm, storage | sampled | copy_source, "display");
    if (needs.opaque || needs.translucent)
        targets.depth = target(rhi::Format::d32_float, attachment | sampled | copy_source, "depth");

    opaque.start(graph, *scene, needs, settings, camera, targets);
    translucent.start(graph, *scene, needs, settings, targets);
    opaque.declare_shadows();
    if (needs.lighting) {
        opaque.declare_gbuffer();
        opaque.declare_lighting(translucent.declare_before_lighting(opaque.colors(), opaque.gbuffer()));
    } else {
        opaque.declare_unlit();
    }
    translucent.declare_after_lighting();
    declare_tonemap();
    graph.keep(targets.hdr);
    graph.keep(display);
    if (needs.translucent) graph.keep(targets.depth);
    if (settings.keep_gbuffer && needs.opaque) {
        for (const GraphTexture t : opaque.colors()) graph.keep(t);
        graph.keep(targets.depth);
    }
    return graph.compile(device);
}

template <rhi::Backend B>
void Renderer<B>::Parts::declare_tonemap() {
    graph.add(
        {.name = "tonemap", .reads = {targets.hdr}, .writes = {display}},
        [this](typename B::Device& on) -> Result<void> {
            PELLUCID_TRY(tonemap, TonemapPass<B>::create(on, settings.tonemap, graph[targets.hdr], graph[display],
                                                         settings.size));
            ++pipelines;
            return {};
        },
        [this](typename B::Commands& cmd) { tonemap->record(cmd, scene->binding().frame); });
}

template <rhi::Backend B>
Result<void> Renderer<B>::set_lights(std::span<const Light> lights) {
    PELLUCID_CHECK(parts_->scene->set_lights(lights));
    parts_->opaque.update_lights();
    return {};
}

template <rhi::Backend B>
void Renderer<B>::set_exposure(float ev) noexcept {
    parts_->settings.exposure_ev = ev;
}

template <rhi::Backend B>
Result<rhi::Ticket> Renderer<B>::render(const Camera& camera) {
    parts_->camera = camera;
    RenderFrame<B> frame(parts_->device, *parts_->scene, *parts_->clock, parts_->camera, parts_->settings);
    Result<void> done = frame.open();
    if (done)
        done = parts_->graph.execute(frame, [&](const char* name, auto&& record) {
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
    RenderFrame<B> frame(parts_->device, *parts_->scene, *parts_->clock, parts_->camera, parts_->settings);
    auto counts = parts_->translucent.count_layers(parts_->device, frame);
    if (!counts) frame.abandon();
    return counts;
}

template <rhi::Backend B>
Result<ImageF> Renderer<B>::read_hdr() {
    PELLUCID_TRY(const auto halves,
                 rhi::download_image<B, std::uint16_t>(parts_->device, parts_->graph[parts_->targets.hdr],
                                                       parts_->settings.size, rhi::Format::rgba16_float));
    ImageF image(halves.width, halves.height, halves.channels);
    std::transform(halves.data.begin(), halves.data.end(), image.data.begin(), half_to_float);
    return image;
}

template <rhi::Backend B>
Result<Image8> Renderer<B>::read_display() {
    return rhi::download_image<B, std::uint8_t>(parts_->device, display(), parts_->settings.size,
                                                rhi::Format::rgba8_unorm);
}

template <rhi::Backend B>
Result<rhi::Texels> Renderer<B>::read_gbuffer(std::size_t index) {
    const RenderSettings& settings = parts_->settings;
    if (!settings.keep_gbuffer || !parts_->needs.opaque)
        return Error{Errc::invalid_argument,
                     "there is no G-buffer to read: set keep_gbuffer, and draw an opaque surface"};
    const auto read = [&](rhi::Texture texture, rhi::Format format) {
        return rhi::download<B>(parts_->device, texture, {.size = settings.size, .format = format});
    };
    if (index == depth_index) return read(gbuffer().depth, rhi::Format::d32_float);
    const auto formats = gbuffer_formats(settings.gbuffer, parts_->needs.emissive_target);
    if (index >= formats.size())
        return Error{Errc::invalid_argument, "the G-buffer has " + std::to_string(formats.size()) +
                                                 " targets; number " + std::to_string(index) + " was asked for"};
    return read(gbuffer().colors[index], formats[index]);
}

template <rhi::Backend B>
Result<std::vector<std::uint32_t>> Renderer<B>::read_light_lists() {
    return rhi::download<B, std::uint32_t>(parts_->device, parts_->scene->lights().lists(),
                                           parts_->needs.grid.bytes() / 4);
}

template <rhi::Backend B>
Result<rhi::Texels> Renderer<B>::read_shadow_map(std::uint32_t layer) {
    const std::uint32_t layers = parts_->needs.shadow_maps;
    if (layer >= layers)
        return Error{Errc::invalid_argument, "layer " + std::to_string(layer) + " of the shadow maps was asked for; " +
                                                 "there are " + std::to_string(layers)};
    const std::uint32_t side = shadows()->size();
    return rhi::download<B>(parts_->device, shadows()->maps(), {.size = {side, side}, .format = rhi::Format::d32_float},
                            0, layer);
}

template <rhi::Backend B>
Result<Image<std::uint32_t>> Renderer<B>::read_composited() {
    return parts_->translucent.read_composited(parts_->device);
}

template <rhi::Backend B>
Result<double> Renderer<B>::read_transmittance_left() {
    return parts_->translucent.read_transmittance_left(parts_->device);
}

template <rhi::Backend B>
const GpuShadows<B>* Renderer<B>::shadows() const noexcept {
    return parts_->scene->shadows();
}

template <rhi::Backend B>
rhi::Texture Renderer<B>::display() const noexcept {
    return parts_->graph[parts_->display];
}

template <rhi::Backend B>
const SceneNeeds& Renderer<B>::needs() const noexcept {
    return parts_->needs;
}

template <rhi::Backend B>
const RenderSettings& Renderer<B>::settings() const noexcept {
    return parts_->settings;
}

template <rhi::Backend B>
Result<std::span<const measure::GpuSpan>> Renderer<B>::gpu_times() {
    return parts_->clock->collect();
}

template <rhi::Backend B>
const GBufferTargets& Renderer<B>::gbuffer() const noexcept {
    return parts_->opaque.gbuffer();
}

template <rhi::Backend B>
const SceneBinding& Renderer<B>::scene_binding() const noexcept {
    return parts_->scene->binding();
}

template <rhi::Backend B>
RenderStats Renderer<B>::stats() const {
    const Parts& p = *parts_;
    RenderStats stats{.passes = p.graph.passes(),
                      .resources = p.graph.textures(),
                      .pipelines = p.pipelines + p.opaque.pipelines() + p.translucent.pipelines(),
                      .draws = static_cast<std::uint32_t>(p.scene->opaque().size() + p.scene->translucent().size()),
                      .triangles = p.scene->triangles(),
                      .lights = p.scene->lights().size(),
                      .lighting = p.needs.assignment,
                      .lighting_why = p.needs.assignment_why,
                      .shadows = p.needs.shadows,
                      .shadows_why = p.needs.shadows_why,
                      .shadow_lights = p.needs.shadow_lights,
                      .shadow_maps = p.needs.shadow_maps,
                      .shadows_drawn = shadows() ? shadows()->drawn() : 0,
                      .translucency = p.translucent.stats(),
                      .warnings = p.warnings};
    p.translucent.add_resources(stats.resources);
    p.opaque.add_resources(stats.resources);
    stats.resources.insert(stats.resources.end(), p.scene->resources().begin(), p.scene->resources().end());
    stats.warnings.insert(stats.warnings.end(), p.scene->warnings().begin(), p.scene->warnings().end());
    for (const TextureReport& r : stats.resources) stats.bytes += r.bytes;
    return stats;
}

}  // namespace pellucid::inline v0_1
