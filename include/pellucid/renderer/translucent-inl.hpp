// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Translucent<B>: one function a method.
#include <pellucid/renderer/translucent.hpp>

namespace pellucid {

template <rhi::Backend B>
void Translucent<B>::start(Graph<B>& graph, const GpuScene<B>& scene, const SceneNeeds& needs,
                           const RenderSettings& settings, const Targets& targets) {
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
    return target(rhi::Format::rgba16_float, sampled | (fragment ? attachment : storage), debug_name);
}

template <rhi::Backend B>
void Translucent<B>::declare_sorted() {
    graph_->add(
        {.name = "sorted_forward", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr}},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(sorted_, SortedForwardPass<B>::create(device, {.brdf = settings_->brdf,
                                                                        .needs = needs_.mask,
                                                                        .culls = scene_->translucent_culls(),
                                                                        .exact = settings_->exact}));
            pipelines_ += culls();
            return {};
        },
        [this](typename B::Commands& cmd) {
            sorted_->record(cmd, (*this)[targets_.hdr], (*this)[targets_.depth], settings_->size, scene_->binding(),
                            scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_peel() {
    using enum rhi::TextureUsage;
    declare_layer_count();
    const GraphTexture next = target(rhi::Format::r32_float, attachment | sampled | copy_source, "peel.next");
    const GraphTexture layer = target(rhi::Format::d32_float, attachment, "peel.layer");
    const GraphTexture sum = target(rhi::Format::rgba32_float, attachment | sampled | copy_source, "peel.sum");
    graph_->keep(peel_next_ = next);
    graph_->keep(peel_sum_ = sum);
    GraphPassDesc pass{
        .name = "peel", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr, next, layer, sum}};
    GraphTexture count;
    if (settings_->audit) {
        count = target(rhi::Format::r32_float, attachment | copy_source, "peel.count");
        pass.writes.push_back(count);
    }
    graph_->add(
        pass,
        [this, next, layer, sum, count](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(peel_, PeelPass<B>::create(device,
                                                    {.fragments = fragments(),
                                                     .max_layers = settings_->max_layers,
                                                     .min_transmittance = settings_->min_transmittance,
                                                     .audit = settings_->audit},
                                                    {.hdr = (*this)[targets_.hdr],
                                                     .opaque = (*this)[targets_.depth],
                                                     .next = (*this)[next],
                                                     .layer = (*this)[layer],
                                                     .sum = (*this)[sum],
                                                     .count = count ? (*this)[count] : rhi::Texture{}}));
            pipelines_ += 3 * culls() + 2;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            std::vector<rhi::Rect> areas = layer_areas(count_->tile_depths(), settings_->size);
            bool more = !areas.empty();
            peel_->begin(frame.commands(), std::move(areas));
            while (more) {
                peel_->record_layers(frame.commands(), scene_->binding(), scene_->translucent(),
                                     scene_->translucent_reversed());
                PELLUCID_CHECK(frame.flush());
                PELLUCID_TRY(more, peel_->more(*device_));
            }
            peel_->composite(frame.commands());
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_peel_seed() {
    using enum rhi::TextureUsage;
    const GraphTexture layer = target(rhi::Format::rgba8_unorm, attachment | sampled, "peel_seed.layer");
    const GraphTexture sum = target(rhi::Format::rgba8_unorm, attachment | sampled, "peel_seed.sum");
    const GraphTexture depths[] = {target(rhi::Format::d32_float, attachment | sampled, "peel_seed.depth"),
                                   target(rhi::Format::d32_float, attachment | sampled, "peel_seed.depth")};
    graph_->add(
        {.name = "peel_seed",
         .reads = {targets_.hdr, targets_.depth},
         .writes = {targets_.hdr, layer, sum, depths[0], depths[1]}},
        [this, layer, sum, depth0 = depths[0], depth1 = depths[1]](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(peel_seed_,
                         PeelSeedPass<B>::create(
                             device,
                             {.fragments = fragments(),
                              .layers = settings_->max_layers ? settings_->max_layers : PELLUCID_PEEL_SEED_LAYERS,
                              .composite_as_written = settings_->seed_composite},
                             {.hdr = (*this)[targets_.hdr],
                              .opaque = (*this)[targets_.depth],
                              .depth = {(*this)[depth0], (*this)[depth1]},
                              .layer = (*this)[layer],
                              .sum = (*this)[sum]}));
            pipelines_ += culls() + 2;
            return {};
        },
        [this](typename B::Commands& cmd) { peel_seed_->record(cmd, scene_->binding(), scene_->translucent()); });
}

template <rhi::Backend B>
void Translucent<B>::declare_dual_peel() {
    using enum rhi::TextureUsage;
    using enum rhi::Format;
    declare_layer_count();
    struct Own {
        GraphTexture range[2], front[2], layer, back;
    } own;
    for (GraphTexture& t : own.range) t = target(rg32_float, attachment | sampled, "dual_peel.range");
    for (GraphTexture& t : own.front) t = target(rgba32_float, attachment | sampled, "dual_peel.front");
    own.layer = target(rgba32_float, attachment | sampled, "dual_peel.layer");
    own.back = target(rgba32_float, attachment | sampled, "dual_peel.back");
    graph_->add(
        {.name = "dual_peel",
         .reads = {targets_.hdr, targets_.depth},
         .writes = {targets_.hdr, own.range[0], own.range[1], own.front[0], own.front[1], own.layer, own.back}},
        [this, own](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(dual_peel_, DualPeelPass<B>::create(
                                         device, {.fragments = fragments(), .max_passes = settings_->max_layers},
                                         {.hdr = (*this)[targets_.hdr],
                                          .opaque = (*this)[targets_.depth],
                                          .range = {(*this)[own.range[0]], (*this)[own.range[1]]},
                                          .front = {(*this)[own.front[0]], (*this)[own.front[1]]},
                                          .layer = (*this)[own.layer],
                                          .back = (*this)[own.back]}));
            pipelines_ += 2 * culls() + 3;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            dual_peel_->record(frame.commands(), scene_->binding(), scene_->translucent(), count_->totals().deepest);
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_layer_count() {
    graph_->add(
        {.name = "layer_count", .reads = {targets_.depth}, .live = true},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(count_, LayerCountPass<B>::create(device, fragments()));
            pipelines_ += culls() + 1;
            return {};
        },
        [this](typename B::Commands& cmd) {
            count_->record(cmd, (*this)[targets_.depth], scene_->binding(), scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_abuffer() {
    declare_layer_count();
    graph_->add(
        {.name = "abuffer", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr}},
        [this](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(abuffer_, AbufferPass<B>::create(device,
                                                          {.fragments = fragments(),
                                                           .content = fragment_content(),
                                                           .memory_budget = settings_->memory_budget,
                                                           .min_transmittance = settings_->min_transmittance,
                                                           .audit = settings_->audit},
                                                          (*this)[targets_.hdr], count_->counts()));
            pipelines_ += culls() + 1 + (fragment_content() == FragmentContent::surfaces ? 2 : 4);
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            PELLUCID_CHECK(abuffer_->prepare(*device_, count_->strips()));
            abuffer_->record(frame.commands(), (*this)[targets_.depth], scene_->binding(), scene_->translucent());
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_skyx_layers(std::span<const GraphTexture> colors,
                                                     const GBufferTargets& gbuffer) {
    using enum rhi::TextureUsage;
    const GraphTexture marks = target(rhi::Format::d32_float_s8_uint, attachment, "interleaved_skyx.marks");
    lighting_.depth = target(rhi::Format::r32_float, attachment | sampled, "interleaved_skyx.depth");
    lighting_.output = lit_target("interleaved_skyx.light");
    skyx_info_ = target(rhi::Format::r32_uint, attachment | sampled, "interleaved_skyx.info");
    GraphPassDesc layers{
        .name = "interleaved_skyx.layers", .reads = {targets_.depth}, .writes = {marks, lighting_.depth, skyx_info_}};
    for (const GraphTexture color : colors) {
        layers.reads.push_back(color);
        layers.writes.push_back(color);
    }
    graph_->add(
        layers,
        [this, marks, &gbuffer](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(interleaved_skyx_,
                         InterleavedSkyxPass<B>::create(device,
                                                        {.gbuffer = {.layout = settings_->gbuffer,
                                                                     .emissive = needs_.emissive_target,
                                                                     .needs = needs_.mask,
                                                                     .culls = scene_->translucent_culls()},
                                                         .alpha_gain = settings_->skyx_alpha_gain},
                                                        {.hdr = (*this)[targets_.hdr],
                                                         .gbuffer = gbuffer,
                                                         .marks = (*this)[marks],
                                                         .depth = (*this)[lighting_.depth],
                                                         .info = (*this)[skyx_info_],
                                                         .light = (*this)[lighting_.output]}));
            pipelines_ += culls() + 2;
            return {};
        },
        [this](typename B::Commands& cmd) {
            interleaved_skyx_->record_layers(cmd, scene_->binding(), scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_skyx_merge() {
    graph_->add(
        {.name = "interleaved_skyx",
         .reads = {lighting_.output, lighting_.depth, skyx_info_},
         .writes = {targets_.hdr}},
        [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) { interleaved_skyx_->record_merge(cmd); });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_select() {
    using enum rhi::TextureUsage;
    declare_layer_count();
    lighting_.nodes = target(rhi::Format::rgba32_uint, storage | sampled | attachment, "interleaved.nodes");
    lighting_.looks = target(rhi::Format::rgba32_uint, storage | sampled | attachment, "interleaved.looks");
    lighting_.layer_light = lit_target("interleaved.light");
    graph_->add(
        {.name = "interleaved.select",
         .reads = {targets_.depth},
         .writes = {lighting_.nodes, lighting_.looks},
         .live = true},
        [this](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(interleaved_, InterleavedPass<B>::create(device,
                                                                  {.fragments = fragments(),
                                                                   .memory_budget = settings_->memory_budget,
                                                                   .min_transmittance = settings_->min_transmittance,
                                                                   .audit = settings_->audit},
                                                                  {.hdr = (*this)[targets_.hdr],
                                                                   .nodes = (*this)[lighting_.nodes],
                                                                   .looks = (*this)[lighting_.looks],
                                                                   .light = (*this)[lighting_.layer_light]},
                                                                  count_->counts()));
            pipelines_ += culls() + 1 + 2 * 2;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            PELLUCID_CHECK(interleaved_->prepare(*device_, count_->strips()));
            interleaved_->record_select(frame.commands(), (*this)[targets_.depth], scene_->binding(),
                                        scene_->translucent());
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_merge() {
    graph_->add(
        {.name = "interleaved",
         .reads = {targets_.hdr, targets_.depth, lighting_.nodes, lighting_.looks, lighting_.layer_light},
         .writes = {targets_.hdr}},
        [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) {
            interleaved_->record_merge(cmd, (*this)[targets_.depth], scene_->binding(), scene_->translucent());
        });
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
    if (settings_->audit && abuffer_) return read_numbers(device, abuffer_->composited(), rhi::Format::r32_uint);
    if (settings_->audit && peel_) return read_numbers(device, peel_->count(), rhi::Format::r32_float);
    if (settings_->audit && interleaved_) return read_numbers(device, interleaved_->lit(), rhi::Format::r32_uint);
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
    if (abuffer_) {
        out.bands = static_cast<std::uint32_t>(abuffer_->bands());
        out.pool_bytes = abuffer_->pool_bytes();
    }
    if (interleaved_) {
        out.bands = static_cast<std::uint32_t>(interleaved_->bands());
        out.pool_bytes = interleaved_->pool_bytes();
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
    if (abuffer_) abuffer_->each_resource(add);
    if (interleaved_) interleaved_->each_resource(add);
}

}  // namespace pellucid
