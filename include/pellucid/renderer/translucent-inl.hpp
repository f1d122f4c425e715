// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Translucent<B>: which method runs, and what can be read of its last frame.
#include <pellucid/renderer/translucent.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
void Translucent<B>::start(Graph<B>& graph, const GpuScene<B>& scene, const SceneNeeds& needs,
                           const RenderSettings& settings, const FrameTargets& targets) {
    graph_ = &graph;
    scene_ = &scene;
    settings_ = &settings;
    needs_ = needs;
    targets_ = targets;
}

template <rhi::Backend B>
LightingChanges Translucent<B>::declare_before_lighting(std::span<const GraphTexture> colors,
                                                        const GBufferTargets& gbuffer) {
    if (!needs_.translucent) return {};
    if (settings_->transparency == Transparency::interleaved) declare_interleaved_select();
    if (settings_->transparency == Transparency::interleaved_skyx) declare_interleaved_skyx_layers(colors, gbuffer);
    return lighting_;
}

template <rhi::Backend B>
void Translucent<B>::declare_after_lighting() {
    if (!needs_.translucent) {
        const bool off = settings_->transparency == Transparency::none;
        graph_->leave_out("transparency",
                          off ? "transparency is switched off" : "the scene has no translucent surface");
        return;
    }
    switch (settings_->transparency) {
        case Transparency::none:
            break;
        case Transparency::sorted:
            return declare_sorted();
        case Transparency::peel:
            return declare_peel();
        case Transparency::peel_seed:
            return declare_peel_seed();
        case Transparency::dual_peel:
            return declare_dual_peel();
        case Transparency::interleaved_skyx:
            return declare_interleaved_skyx_merge();
        case Transparency::interleaved:
            return declare_interleaved_merge();
        case Transparency::abuffer:
            return declare_abuffer();
    }
}

template <rhi::Backend B>
GraphTexture Translucent<B>::target(rhi::Format format, rhi::TextureUsage usage, const char* debug_name) {
    own_targets_.push_back(debug_name);
    return graph_->texture({.size = settings_->size, .format = format, .usage = usage, .debug_name = debug_name});
}

template <rhi::Backend B>
GraphTexture Translucent<B>::lit_target(const char* debug_name) {
    using enum rhi::TextureUsage;
    const bool fragment = settings_->shading == ShadingStage::fragment;
    rhi::TextureUsage usage = sampled | (fragment ? attachment : storage);
    if (needs_.assignment == LightAssignment::volumes) usage |= storage;
    return target(rhi::Format::rgba16_float, usage, debug_name);
}

template <rhi::Backend B>
Result<Image<std::uint32_t>> Translucent<B>::read_numbers(typename B::Device& device, rhi::Texture texture,
                                                          rhi::Format format) const {
    rhi::Texels texels;
    PELLUCID_TRY(texels, rhi::download<B>(device, texture, {.size = settings_->size, .format = format}));
    Image<std::uint32_t> out(settings_->size.width, settings_->size.height, 1);
    for (std::uint32_t y = 0; y < out.height; ++y)
        for (std::uint32_t x = 0; x < out.width; ++x)
            *out.texel(x, y) = format == rhi::Format::r32_uint ? texels.at<std::uint32_t>(x, y)
                                                               : static_cast<std::uint32_t>(texels.at<float>(x, y));
    return out;
}

template <rhi::Backend B>
Result<Image<std::uint32_t>> Translucent<B>::count_layers(typename B::Device& device, Frame<B>& frame) {
    if (scene_->translucent().empty()) return Image<std::uint32_t>(settings_->size.width, settings_->size.height, 1);
    if (!device.info().float32_blending)
        return Error{Errc::unsupported, "layers are counted by blending into a 32-bit float target, and " +
                                            device.info().name + " cannot: there are no counts on this device"};
    if (!count_) {
        PELLUCID_TRY(count_, LayerCountPass<B>::create(device, fragments()));
    }
    PELLUCID_CHECK(frame.open());
    count_->record(frame.commands(), (*this)[targets_.depth], scene_->binding(), scene_->translucent());
    rhi::Ticket ticket{};
    PELLUCID_TRY(ticket, frame.close());
    PELLUCID_CHECK(device.wait(ticket));
    return read_numbers(device, count_->counts(), rhi::Format::r32_float);
}

template <rhi::Backend B>
Result<Image<std::uint32_t>> Translucent<B>::read_composited(typename B::Device& device) const {
    if (settings_->audit && compositor()) return read_numbers(device, compositor()->audit(), rhi::Format::r32_uint);
    if (settings_->audit && peel_) return read_numbers(device, peel_->count(), rhi::Format::r32_float);
    return Error{Errc::invalid_argument, std::string("nobody counts what the method '") +
                                             name(settings_->transparency) +
                                             "' composites: set audit, and use a method that heeds it"};
}

template <rhi::Backend B>
Result<double> Translucent<B>::read_transmittance_left(typename B::Device& device) const {
    const double least = settings_->audit ? 0 : settings_->min_transmittance;
    if (!traits(settings_->transparency).min_transmittance)
        return Error{Errc::invalid_argument, std::string("there is no bound of what the method '") +
                                                 name(settings_->transparency) +
                                                 "' leaves out; those that heed min_transmittance have one"};
    if (!needs_.translucent) return 0.0;
    if (!peel_ || (!peel_->truncated() && least == 0)) return least;
    rhi::Texels next, sum;
    PELLUCID_TRY(next, rhi::download<B>(device, (*this)[peel_next_],
                                        {.size = settings_->size, .format = rhi::Format::r32_float}));
    PELLUCID_TRY(sum, rhi::download<B>(device, (*this)[peel_sum_],
                                       {.size = settings_->size, .format = rhi::Format::rgba32_float}));
    double left = 0;
    for (std::uint32_t y = 0; y < settings_->size.height; ++y)
        for (std::uint32_t x = 0; x < settings_->size.width; ++x) {
            const double through = sum.at<std::array<float, 4>>(x, y)[3];
            // The search for one layer more found something, or the pixel was given up as dark.
            if ((peel_->truncated() && next.at<float>(x, y) >= 0) || through <= least) left = std::max(left, through);
        }
    return left;
}

template <rhi::Backend B>
TranslucencyStats Translucent<B>::stats() const {
    const TransparencyTraits& method = traits(settings_->transparency);
    TranslucencyStats out{.method = method.method, .ran = needs_.translucent, .loses = method.loses};
    const auto lose = [&](const std::string& what) { out.loses += (out.loses.empty() ? "" : "; ") + what; };
    if (method.min_transmittance && settings_->min_transmittance > 0 && !settings_->audit) {
        char share[32];
        std::snprintf(share, sizeof share, "%g", static_cast<double>(settings_->min_transmittance));
        lose(std::string("what is behind layers that let at most ") + share + " of the light through");
    }
    if (peel_) {
        out.layers = peel_->layers();
        out.truncated = peel_->truncated();
        if (out.truncated) lose("layers behind the first " + std::to_string(out.layers));
    }
    if (peel_seed_) out.layers = settings_->max_layers ? settings_->max_layers : PELLUCID_PEEL_SEED_LAYERS;
    if (dual_peel_) {
        out.passes = dual_peel_->passes();
        out.truncated = dual_peel_->truncated();
        if (out.truncated)
            lose("layers between the first " + std::to_string(out.passes) + " and the last " +
                 std::to_string(out.passes));
    }
    if (const ListCompositor<B>* const made = compositor()) {
        out.bands = static_cast<std::uint32_t>(made->lists().bands().size());
        out.pool_bytes = made->lists().bytes();
    }
    out.exact = out.loses.empty();
    std::vector<TextureReport> resources;
    add_resources(resources);
    for (const TextureReport& r : graph_->textures())
        if (std::find(own_targets_.begin(), own_targets_.end(), r.name) != own_targets_.end()) resources.push_back(r);
    for (const TextureReport& r : resources) out.bytes += r.bytes;
    return out;
}

template <rhi::Backend B>
void Translucent<B>::add_resources(std::vector<TextureReport>& out) const {
    const auto add = [&](const char* debug_name, std::uint64_t bytes) { out.push_back({debug_name, bytes, false}); };
    if (count_) count_->each_resource(add);
    if (compositor()) compositor()->each_resource(add);
}

}  // namespace pellucid::inline v0_1
