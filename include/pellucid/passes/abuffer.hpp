// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exact transparency of any order and depth: an A-buffer (Carpenter 1984) of exactly the size that the frame needs.
#include <pellucid/gpu/abuffer.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/passes/strip_bands.hpp>
#include <pellucid/shaders/abuffer.hpp>
#include <algorithm>
#include <vector>

namespace pellucid {

struct AbufferDesc {
    FragmentDesc fragments = {};
    std::uint64_t memory_budget = 0;  ///< [byte] for stored fragments; 0: what the device can bind
    float min_transmittance = 0;      ///< a pixel is done where less gets through; 0: only what nothing can change
    bool audit = false;               ///< keep how many fragments each pixel composited, and composite them all
};

/// `hdr = Σ T_i a_i L_i + T hdr` over all fragments of a pixel, front to back (Porter and Duff 1984), in linear HDR and
/// single precision; equal depth: the later primitive is in front.  Two geometry passes: LayerCountPass counts, this
/// one stores every fragment in a place of its own (16 bytes); a compute pass sorts and composites each pixel.
/// Nothing is ever dropped: where the fragments exceed the budget the picture is made in bands of rows, the same bits.
/// With `min_transmittance` t > 0 the error of a pixel is at most t times the largest radiance behind.
/// Colours are stored as binary16 (relative error 2^-12 each), alpha as unorm16.  Shaders: shaders/abuffer.
template <rhi::Backend B>
class AbufferPass {
public:
    /// `hdr`: rgba16_float `[h, w]`, storage.  `counts`: LayerCountPass::counts().  Errors: those of creation.
    [[nodiscard]] static Result<AbufferPass> create(typename B::Device& device, const AbufferDesc& desc,
                                                    rhi::Texture hdr, rhi::Texture counts);

    /// Once the counts are on the CPU: decides the bands and makes room.  Errors: those of `split_strips`, of memory.
    [[nodiscard]] Result<void> prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips);

    /// Records everything from the counts to the picture, in the bands of the last `prepare`.  The depth test is
    /// greater-or-equal against `depth`, which is read only.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                std::span<const DrawItem> items) const;

    [[nodiscard]] std::size_t bands() const { return bands_.size(); }
    [[nodiscard]] std::uint64_t pool_bytes() const {
        return (std::uint64_t{pool_rows_} << PELLUCID_ABUFFER_WIDTH_BITS) * PELLUCID_ABUFFER_NODE_BYTES;
    }
    /// r32_uint `[h, w]`: fragments composited in each pixel; 1 × 1 unless `audit`.
    [[nodiscard]] rhi::Texture composited() const { return audit_; }
    /// Calls `visit(name, bytes)` for each buffer and texture that the pass owns.
    template <class F>
    void each_resource(F&& visit) const {
        const std::uint64_t pixels = std::uint64_t{desc_.fragments.size.width} * desc_.fragments.size.height;
        visit("abuffer.bases", std::uint64_t{4} * strip_bases_.size());
        visit("abuffer.classes", PELLUCID_ABUFFER_CLASS_COUNT * sizeof(gpu::AbufferClass));
        visit("abuffer.tiles", std::uint64_t{4} * PELLUCID_ABUFFER_CLASS_COUNT * tiles());
        visit("abuffer.cursors", 4 * pixels);
        visit("abuffer.audit", desc_.audit ? 4 * pixels : 4);
        if (pool_rows_ > 0) visit("abuffer.nodes", pool_bytes());
    }

private:
    [[nodiscard]] Result<void> make_buffers(typename B::Device& device);
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device);
    [[nodiscard]] Result<void> make_groups(typename B::Device& device);
    void place(typename B::Commands& cmd, const StripBand& band) const;
    void fill(typename B::Commands& cmd, const StripBand& band, rhi::Texture depth, const SceneBinding& scene,
              std::span<const DrawItem> items) const;
    void resolve(typename B::Commands& cmd, const StripBand& band) const;
    [[nodiscard]] std::uint32_t tiles() const;
    [[nodiscard]] gpu::AbufferResolve push(const StripBand& band) const;

    AbufferDesc desc_;
    rhi::Texture hdr_ = {}, counts_ = {};
    rhi::Unique<typename B::Device, rhi::Buffer> bases_, classes_, tiles_;
    rhi::Unique<typename B::Device, rhi::Texture> cursors_, nodes_, audit_;
    rhi::Unique<typename B::Device, rhi::Group> place_group_, fill_group_, resolve_group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> place_, resolve_[PELLUCID_ABUFFER_CLASS_COUNT];
    CullVariants<B> fill_;
    std::vector<StripBand> bands_;
    std::vector<std::uint32_t> strip_bases_;
    std::uint32_t pool_rows_ = 0;  ///< rows of `nodes_`
};

// ------------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// The bindings of a stage of the A-buffer, by number: images below PELLUCID_PASS_0, buffers from there on.
inline rhi::GroupLayout abuffer_layout(std::initializer_list<std::uint32_t> bindings) {
    rhi::GroupLayout layout;
    for (const std::uint32_t b : bindings)
        layout.bindings.push_back(
            {b, b < PELLUCID_PASS_0 ? rhi::BindingKind::storage_texture : rhi::BindingKind::storage_buffer});
    return layout;
}
inline rhi::GroupLayout abuffer_place_layout() {
    return abuffer_layout({PELLUCID_LAYERS_COUNTS, PELLUCID_ABUFFER_CURSORS, PELLUCID_ABUFFER_BASES,
                           PELLUCID_ABUFFER_CLASSES, PELLUCID_ABUFFER_TILES});
}
inline rhi::GroupLayout abuffer_fill_layout() {
    return abuffer_layout({PELLUCID_ABUFFER_CURSORS, PELLUCID_ABUFFER_NODES});
}
inline rhi::GroupLayout abuffer_resolve_layout() {
    return abuffer_layout({PELLUCID_ABUFFER_TARGET, PELLUCID_LAYERS_COUNTS, PELLUCID_ABUFFER_CURSORS,
                           PELLUCID_ABUFFER_NODES, PELLUCID_ABUFFER_AUDIT, PELLUCID_ABUFFER_CLASSES,
                           PELLUCID_ABUFFER_TILES});
}

}  // namespace detail

template <rhi::Backend B>
Result<AbufferPass<B>> AbufferPass<B>::create(typename B::Device& device, const AbufferDesc& desc, rhi::Texture hdr,
                                              rhi::Texture counts) {
    AbufferPass pass;
    pass.desc_ = desc;
    pass.hdr_ = hdr;
    pass.counts_ = counts;
    PELLUCID_CHECK(pass.make_buffers(device));
    PELLUCID_CHECK(pass.make_pipelines(device));
    return pass;
}

template <rhi::Backend B>
std::uint32_t AbufferPass<B>::tiles() const {
    return (desc_.fragments.size.width + PELLUCID_LAYERS_TILE - 1) / PELLUCID_LAYERS_TILE *
           static_cast<std::uint32_t>(strip_bases_.size());
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::make_buffers(typename B::Device& device) {
    using enum rhi::BufferUsage;
    strip_bases_.resize((desc_.fragments.size.height + PELLUCID_LAYERS_TILE - 1) / PELLUCID_LAYERS_TILE);
    PELLUCID_OWN(
        bases_, device,
        device.make_buffer(
            {.size = strip_bases_.size() * 4, .usage = storage | copy_destination, .debug_name = "abuffer.bases"}));
    PELLUCID_OWN(classes_, device,
                 device.make_buffer({.size = PELLUCID_ABUFFER_CLASS_COUNT * sizeof(gpu::AbufferClass),
                                     .usage = storage | indirect | copy_destination,
                                     .debug_name = "abuffer.classes"}));
    PELLUCID_OWN(tiles_, device,
                 device.make_buffer({.size = std::uint64_t{4} * PELLUCID_ABUFFER_CLASS_COUNT * tiles(),
                                     .usage = storage,
                                     .debug_name = "abuffer.tiles"}));
    rhi::TextureDesc a_pixel{.size = desc_.fragments.size,
                             .format = rhi::Format::r32_uint,
                             .usage = rhi::TextureUsage::storage,
                             .debug_name = "abuffer.cursors"};
    PELLUCID_OWN(cursors_, device, device.make_texture(a_pixel));
    if (!desc_.audit) a_pixel.size = {1, 1};  // a binding that is not used still wants an image
    a_pixel.usage |= rhi::TextureUsage::copy_source | rhi::TextureUsage::attachment;
    a_pixel.debug_name = "abuffer.audit";
    PELLUCID_OWN(audit_, device, device.make_texture(a_pixel));
    return {};
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::make_pipelines(typename B::Device& device) {
    PELLUCID_OWN(place_, device,
                 device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::abuffer_place_comp,
                                                               .pass_group = detail::abuffer_place_layout(),
                                                               .push_bytes = sizeof(gpu::AbufferResolve),
                                                               .debug_name = "abuffer.place"}));
    const auto constants = desc_.fragments.constants();
    PELLUCID_CHECK(fill_.create(
        device,
        {.vertex = &shaders::scene_vert,
         .fragment = desc_.fragments.exact ? &shaders::abuffer_fill_frag_exact : &shaders::abuffer_fill_frag,
         .constants = constants,
         .pass_group = detail::abuffer_fill_layout(),
         .scene_group = scene_group_layout(),
         .depth = FragmentDesc::depth_test(),
         .debug_name = "abuffer.fill"},
        desc_.fragments.culls));
    const rhi::Shader* const shaders[] = {&shaders::abuffer_resolve_4_comp, &shaders::abuffer_resolve_8_comp,
                                          &shaders::abuffer_resolve_16_comp, &shaders::abuffer_resolve_32_comp};
    for (std::uint32_t c = 0; c < PELLUCID_ABUFFER_CLASS_COUNT; ++c) {
        const rhi::SpecConstant resolve[] = {{2, desc_.audit ? 1u : 0u}, {3, c}};
        PELLUCID_OWN(resolve_[c], device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = shaders[c],
                                                                   .constants = resolve,
                                                                   .pass_group = detail::abuffer_resolve_layout(),
                                                                   .push_bytes = sizeof(gpu::AbufferResolve),
                                                                   .debug_name = "abuffer.resolve"}));
    }
    return {};
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::make_groups(typename B::Device& device) {
    const rhi::Texture images[] = {hdr_, counts_, cursors_, nodes_, audit_};
    const rhi::Buffer buffers[] = {bases_, classes_, tiles_};
    const auto group = [&](const rhi::GroupLayout& layout, const char* debug_name) {
        rhi::GroupDesc desc{.layout = layout, .debug_name = debug_name};
        for (const rhi::BindingLayout& b : layout.bindings) {
            if (b.kind == rhi::BindingKind::storage_buffer)
                desc.bindings.push_back({.binding = b.binding, .buffer = buffers[b.binding - PELLUCID_ABUFFER_BASES]});
            else
                desc.bindings.push_back({.binding = b.binding, .texture = images[b.binding]});
        }
        return device.make_group(desc);
    };
    PELLUCID_OWN(place_group_, device, group(detail::abuffer_place_layout(), "abuffer.place"));
    PELLUCID_OWN(fill_group_, device, group(detail::abuffer_fill_layout(), "abuffer.fill"));
    PELLUCID_OWN(resolve_group_, device, group(detail::abuffer_resolve_layout(), "abuffer.resolve"));
    return {};
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips) {
    constexpr std::uint32_t width = 1u << PELLUCID_ABUFFER_WIDTH_BITS;
    std::uint64_t most = std::uint64_t{device.info().max_texture_size} * width;
    if (desc_.memory_budget != 0) most = std::min(most, desc_.memory_budget / PELLUCID_ABUFFER_NODE_BYTES);
    PELLUCID_TRY(bands_, split_strips(strips, most, PELLUCID_ABUFFER_NODE_BYTES));
    std::uint32_t needed = 0;
    for (const StripBand& band : bands_) {
        std::uint32_t base = 0;
        for (std::uint32_t i = band.first; i < band.first + band.count; ++i) {
            strip_bases_[i] = base;
            base += strips[i].slots;
        }
        needed = std::max(needed, band.slots);
    }
    const std::uint32_t pool_rows = (needed + width - 1) / width;
    if (pool_rows <= pool_rows_) return {};
    pool_rows_ = pool_rows;
    nodes_.reset();
    PELLUCID_OWN(nodes_, device,
                 device.make_texture({.size = {width, pool_rows},
                                      .format = rhi::Format::rgba32_uint,
                                      .usage = rhi::TextureUsage::storage,
                                      .debug_name = "abuffer.nodes"}));
    return make_groups(device);
}

template <rhi::Backend B>
gpu::AbufferResolve AbufferPass<B>::push(const StripBand& band) const {
    return {.first_strip = band.first,
            .tile_stride = tiles(),
            .min_transmittance = desc_.audit ? -1.0f : desc_.min_transmittance};
}

template <rhi::Backend B>
void AbufferPass<B>::place(typename B::Commands& cmd, const StripBand& band) const {
    using enum rhi::Access;
    gpu::AbufferClass empty[PELLUCID_ABUFFER_CLASS_COUNT];
    for (gpu::AbufferClass& c : empty) c = {.columns = PELLUCID_ABUFFER_CLASS_COLUMNS, .depth = 1};
    cmd.begin_copy({.uses = {rhi::use(bases_, copy_write), rhi::use(classes_, copy_write)}, .name = "abuffer.bases"});
    cmd.update(bases_, 0, rhi::bytes_of(std::span<const std::uint32_t>(strip_bases_)));
    cmd.update(classes_, 0, rhi::bytes_of(std::span<const gpu::AbufferClass>(empty)));
    cmd.end_copy();
    cmd.begin_compute(
        {.uses = {rhi::use(counts_, storage_read), rhi::use(bases_, storage_read), rhi::use(cursors_, storage_write),
                  rhi::use(classes_, storage_read_write), rhi::use(tiles_, storage_write)},
         .name = "abuffer.place"});
    cmd.bind_pipeline(place_);
    cmd.bind_group(place_group_);
    cmd.push(rhi::bytes_of(push(band)));
    cmd.dispatch(band.count, 1, 1);
    cmd.end_compute();
}

template <rhi::Backend B>
void AbufferPass<B>::fill(typename B::Commands& cmd, const StripBand& band, rhi::Texture depth,
                          const SceneBinding& scene, std::span<const DrawItem> items) const {
    using enum rhi::Access;
    rhi::RenderPassDesc pass = desc_.fragments.render_pass(depth, scene, "abuffer.fill");
    pass.uses.push_back(rhi::use(cursors_, storage_read_write));
    pass.uses.push_back(rhi::use(nodes_, storage_write));
    cmd.begin_render(pass);
    const std::uint32_t top = band.first * PELLUCID_LAYERS_TILE;
    const std::uint32_t height = std::min(band.count * PELLUCID_LAYERS_TILE, desc_.fragments.size.height - top);
    cmd.set_scissor({.y = top, .width = desc_.fragments.size.width, .height = height});
    draw_items<B>(cmd, fill_, scene, items, fill_group_);
    cmd.end_render();
}

template <rhi::Backend B>
void AbufferPass<B>::resolve(typename B::Commands& cmd, const StripBand& band) const {
    using enum rhi::Access;
    cmd.begin_compute(
        {.uses = {rhi::use(counts_, storage_read), rhi::use(cursors_, storage_read), rhi::use(nodes_, storage_read),
                  rhi::use(audit_, storage_write), rhi::use(hdr_, storage_read_write), rhi::use(tiles_, storage_read),
                  rhi::use(classes_, storage_read), rhi::use(classes_, indirect_read)},
         .name = "abuffer.resolve"});
    for (std::uint32_t c = 0; c < PELLUCID_ABUFFER_CLASS_COUNT; ++c) {
        cmd.bind_pipeline(resolve_[c]);
        cmd.bind_group(resolve_group_);
        cmd.push(rhi::bytes_of(push(band)));
        cmd.dispatch_indirect(classes_, c * sizeof(gpu::AbufferClass));
    }
    cmd.end_compute();
}

template <rhi::Backend B>
void AbufferPass<B>::record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                            std::span<const DrawItem> items) const {
    if (desc_.audit) {
        cmd.begin_render({.colors = {{.texture = audit_}}, .size = desc_.fragments.size, .name = "abuffer.audit"});
        cmd.end_render();
    }
    for (const StripBand& band : bands_) {
        place(cmd, band);
        fill(cmd, band, depth, scene, items);
        resolve(cmd, band);
    }
}

}  // namespace pellucid
