// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Counts translucent fragments: how many lie over each pixel, in front of what is opaque.
#include <pellucid/gpu/layer_count.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/shaders/layer_count.hpp>

namespace pellucid::inline v0_1 {

/// What the strips of a count add up to.
struct LayerTotals {
    std::uint64_t fragments = 0;
    std::uint64_t pixels = 0;   ///< with at least one fragment
    std::uint32_t deepest = 0;  ///< fragments of one pixel
};

/// Exact counts, by additive blending, of everything that passes the depth test (greater-or-equal against the opaque
/// surfaces), whatever its colour and alpha.  Coverage and depth are those of every other pass.  (An atomic addition a
/// fragment is faster where the GPU has many units for it, and several times slower on software drivers.)
/// Shaders: shaders/layer_count.
template <rhi::Backend B>
class LayerCountPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<LayerCountPass> create(typename B::Device& device, const FragmentDesc& desc);

    /// Records the passes that count and bring the sums to the CPU.  `depth`: d32_float `[h, w]`, read only.
    /// Precondition: no pass is open.
    void record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                std::span<const DrawItem> items) const;

    /// Sums of strips of PELLUCID_LAYERS_TILE rows, from the top.  Precondition: what was recorded is done.
    [[nodiscard]] std::span<const gpu::LayerStrip> strips() const { return strips_; }
    /// Fragments of the deepest pixel of each tile of PELLUCID_LAYERS_TILE² pixels, row by row from the top.
    [[nodiscard]] std::span<const std::uint32_t> tile_depths() const { return tile_depths_; }
    [[nodiscard]] LayerTotals totals() const;
    /// r32_float `[h, w]`: the fragments of each pixel; storage and copy_source.
    [[nodiscard]] rhi::Texture counts() const { return counts_; }
    /// Calls `visit(name, bytes)` for each buffer and texture that the pass owns.
    template <class F>
    void each_resource(F&& visit) const {
        visit("layer_count.counts", std::uint64_t{4} * desc_.size.width * desc_.size.height);
        visit("layer_count.strips", strips_.size_bytes());
        visit("layer_count.tiles", tile_depths_.size_bytes());
        visit("layer_count.readback", strips_.size_bytes() + tile_depths_.size_bytes());
    }

private:
    rhi::Unique<typename B::Device, rhi::Texture> counts_;
    rhi::Unique<typename B::Device, rhi::Buffer> strip_buffer_, tile_buffer_, strip_readback_, tile_readback_;
    rhi::Unique<typename B::Device, rhi::Group> strip_group_;
    CullVariants<B> count_;
    rhi::Unique<typename B::Device, rhi::Pipeline> sum_;
    std::span<const gpu::LayerStrip> strips_;
    std::span<const std::uint32_t> tile_depths_;
    FragmentDesc desc_;
};

// ------------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// `count` numbers that a shader writes, and the same on the CPU once they are copied.
template <rhi::Backend B, class T>
Result<void> make_numbers(typename B::Device& device, rhi::Unique<typename B::Device, rhi::Buffer>& written,
                          rhi::Unique<typename B::Device, rhi::Buffer>& readback, std::span<const T>& numbers,
                          std::size_t count, const char* debug_name) {
    PELLUCID_OWN(written, device,
                 device.make_buffer({.size = count * sizeof(T),
                                     .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_source,
                                     .debug_name = debug_name}));
    PELLUCID_OWN(readback, device,
                 device.make_buffer({.size = count * sizeof(T),
                                     .usage = rhi::BufferUsage::copy_destination,
                                     .memory = rhi::Memory::readback,
                                     .debug_name = debug_name}));
    numbers = {reinterpret_cast<const T*>(device.mapped(readback).data()), count};
    return {};
}

}  // namespace detail

template <rhi::Backend B>
Result<LayerCountPass<B>> LayerCountPass<B>::create(typename B::Device& device, const FragmentDesc& desc) {
    using enum rhi::BindingKind;
    LayerCountPass pass;
    pass.desc_ = desc;
    const Extent2D size = desc.size;
    PELLUCID_OWN(pass.counts_, device,
                 device.make_texture({.size = size,
                                      .format = rhi::Format::r32_float,
                                      .usage = rhi::TextureUsage::storage | rhi::TextureUsage::attachment |
                                               rhi::TextureUsage::copy_source,
                                      .debug_name = "layer_count.counts"}));
    const auto tiles = [](std::uint32_t side) { return (side + PELLUCID_LAYERS_TILE - 1) / PELLUCID_LAYERS_TILE; };
    PELLUCID_CHECK(detail::make_numbers<B>(device, pass.strip_buffer_, pass.strip_readback_, pass.strips_,
                                           tiles(size.height), "layer_count.strips"));
    PELLUCID_CHECK(detail::make_numbers<B>(device, pass.tile_buffer_, pass.tile_readback_, pass.tile_depths_,
                                           tiles(size.height) * tiles(size.width), "layer_count.tiles"));
    const rhi::GroupLayout layout{{{PELLUCID_LAYERS_COUNTS, storage_texture},
                                   {PELLUCID_LAYERS_STRIPS, storage_buffer},
                                   {PELLUCID_LAYERS_TILES, storage_buffer}}};
    PELLUCID_OWN(pass.strip_group_, device,
                 device.make_group({.layout = layout,
                                    .bindings = {{.binding = PELLUCID_LAYERS_COUNTS, .texture = pass.counts_},
                                                 {.binding = PELLUCID_LAYERS_STRIPS, .buffer = pass.strip_buffer_},
                                                 {.binding = PELLUCID_LAYERS_TILES, .buffer = pass.tile_buffer_}},
                                    .debug_name = "layer_count.strips"}));
    constexpr rhi::Blend add{.enabled = true, .dst_color = rhi::BlendFactor::one, .dst_alpha = rhi::BlendFactor::one};
    PELLUCID_CHECK(pass.count_.create(device,
                                      {.vertex = &shaders::scene_position_vert,
                                       .fragment = &shaders::layer_count_frag,
                                       .scene_group = scene_group_layout(),
                                       .colors = {{.format = rhi::Format::r32_float, .blend = add}},
                                       .depth = FragmentDesc::depth_test(),
                                       .debug_name = "layer_count"},
                                      desc.culls));
    PELLUCID_OWN(
        pass.sum_, device,
        device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shaders::layer_count_strips_comp, .pass_group = layout, .debug_name = "layer_count.strips"}));
    return pass;
}

template <rhi::Backend B>
void LayerCountPass<B>::record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                               std::span<const DrawItem> items) const {
    using enum rhi::Access;
    rhi::RenderPassDesc count = desc_.render_pass(depth, scene, "layer_count");
    count.colors.push_back({.texture = counts_});
    cmd.begin_render(count);
    draw_items<B>(cmd, count_, scene, items);
    cmd.end_render();

    cmd.begin_compute({.uses = {rhi::use(counts_, storage_read), rhi::use(strip_buffer_, storage_write),
                                rhi::use(tile_buffer_, storage_write)},
                       .name = "layer_count.strips"});
    cmd.bind_pipeline(sum_);
    cmd.bind_group(strip_group_);
    cmd.dispatch(static_cast<std::uint32_t>(strips_.size()), 1, 1);
    cmd.end_compute();

    cmd.begin_copy({.uses = {rhi::use(strip_buffer_, copy_read), rhi::use(strip_readback_, copy_write),
                             rhi::use(tile_buffer_, copy_read), rhi::use(tile_readback_, copy_write)},
                    .name = "layer_count.readback"});
    cmd.copy(strip_buffer_, strip_readback_, {.size = strips_.size_bytes()});
    cmd.copy(tile_buffer_, tile_readback_, {.size = tile_depths_.size_bytes()});
    cmd.end_copy();
}

template <rhi::Backend B>
LayerTotals LayerCountPass<B>::totals() const {
    LayerTotals t;
    for (const gpu::LayerStrip& strip : strips_) {
        t.fragments += strip.fragments;
        t.pixels += strip.covered;
        t.deepest = std::max(t.deepest, strip.deepest);
    }
    return t;
}

}  // namespace pellucid::inline v0_1
