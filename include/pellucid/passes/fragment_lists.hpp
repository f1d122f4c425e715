// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Every translucent fragment of the frame in memory, in lists by pixel: what exact and interleaved transparency walk.
#include <pellucid/gpu/fragment_lists.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/strip_bands.hpp>
#include <pellucid/shaders/fragment_lists.hpp>
#include <algorithm>
#include <vector>

namespace pellucid::inline v0_1 {

/// What the lists hold of a fragment.
enum class FragmentContent : std::uint8_t {
    colors,   ///< shaded, 16 bytes: binary16 colour (relative error 2^-12), alpha within 2^-20
    surfaces  ///< to be lit by whoever walks them, 32 bytes: normals within 0.0025°, the rest in 16 bits, metallic in 8
};

/// What the lists hold, in how much memory.
struct FragmentListsDesc {
    FragmentDesc fragments = {};
    FragmentContent content = FragmentContent::colors;
    std::uint64_t memory_budget = 0;  ///< [byte] of stored fragments; 0: what the device can bind
    std::uint32_t visit_turns = 0;    ///< turns of loops that visiting one fragment takes
};

/// Specialises shaders that walk lists to a device.
[[nodiscard]] inline rhi::SpecConstant walk_constant(const rhi::DeviceInfo& device) {
    return {3, device.max_loop_turns != 0 ? 1u : 0u};
}
/// Turns of its loops that a shader needs to walk `layers` fragments where turns are limited
/// (shaders/common/fragment_lists.glsl).
[[nodiscard]] constexpr std::uint64_t walk_turns(std::uint64_t layers, std::uint64_t visit_turns) {
    constexpr std::uint64_t window = 16;
    const std::uint64_t windows = (layers + window - 1) / window;
    return windows * (1 + (windows + 1) / 2) + layers * visit_turns;
}
/// The most fragments of a pixel that can be walked in `turns`; 0 turns: no limit.
[[nodiscard]] constexpr std::uint32_t deepest_walk(std::uint32_t turns, std::uint32_t visit_turns) {
    std::uint32_t low = 0, high = 1u << 24u;  // walkable, not walkable: counts are exact up to 2^24
    if (turns == 0) return high;
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (walk_turns(middle, visit_turns) <= turns ? low : high) = middle;
    }
    return low;
}

/// Lists of exactly the size that LayerCountPass counted.  Where they exceed the budget the picture is made in bands of
/// rows, one after the other; nothing is dropped.  Groups of neighbouring pixels lie side by side
/// (gpu/fragment_lists.h), and tiles are listed by depth, so that shallow ones are sorted in few registers.  Shaders:
/// shaders/fragment_lists.
template <rhi::Backend B>
class FragmentLists {
public:
    /// `counts`: LayerCountPass::counts().  Errors: those of creation.
    [[nodiscard]] static Result<FragmentLists> create(typename B::Device& device, const FragmentListsDesc& desc,
                                                      rhi::Texture counts);

    /// Once the counts are on the CPU: decides the bands and makes room.  `true`: the images are new, so groups made of
    /// them must be made again.  Errors: those of `split_strips`, of memory; `unsupported` where a pixel is deeper than
    /// the device's shaders can walk.
    [[nodiscard]] Result<bool> prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips);
    [[nodiscard]] std::span<const StripBand> bands() const { return bands_; }

    /// Records what stores the fragments of one band, tested greater-or-equal against `depth`, which is read only.
    /// Precondition: no pass is open; a band of the last `prepare`.
    void record(typename B::Commands& cmd, const StripBand& band, rhi::Texture depth, const SceneBinding& scene,
                std::span<const DrawItem> items) const;

    /// The pass group of a compute shader that walks the lists, with images and sampled textures of its own.
    [[nodiscard]] rhi::GroupDesc walker_group(const SmallVector<BoundTexture, 8>& images,
                                              const SmallVector<BoundTexture, 8>& textures, rhi::Sampler sampler,
                                              const char* debug_name) const;
    /// Records a compute pass that walks a band: `pipelines[c]` for the tiles of class c; null: that of the class
    /// before.  `uses`: what it declares beside the lists.
    void walk(typename B::Commands& cmd, const StripBand& band, const SceneBinding& scene, rhi::Uses uses,
              std::span<const rhi::Pipeline, PELLUCID_LISTS_CLASS_COUNT> pipelines, rhi::Group group,
              float min_transmittance, const char* name) const;

    [[nodiscard]] bool lit_later() const { return desc_.content == FragmentContent::surfaces; }
    [[nodiscard]] std::uint64_t bytes() const {
        return (std::uint64_t{rows_} << PELLUCID_LISTS_WIDTH_BITS) * fragment_bytes();
    }
    /// Calls `visit(name, bytes)` for each buffer and texture that the lists own.
    template <class F>
    void each_resource(F&& visit) const {
        visit("fragment_lists.bases", std::uint64_t{4} * strip_bases_.size());
        visit("fragment_lists.classes", PELLUCID_LISTS_CLASS_COUNT * sizeof(gpu::ListClass));
        visit("fragment_lists.tiles", std::uint64_t{4} * PELLUCID_LISTS_CLASS_COUNT * tiles());
        visit("fragment_lists.cursors", std::uint64_t{4} * desc_.fragments.size.width * desc_.fragments.size.height);
        const std::uint64_t each = bytes() / (lit_later() ? 2 : 1);
        if (nodes_) visit("fragment_lists.nodes", each);
        if (looks_) visit("fragment_lists.looks", each);
    }

private:
    [[nodiscard]] std::uint32_t fragment_bytes() const { return PELLUCID_LISTS_TEXEL_BYTES * (lit_later() ? 2u : 1u); }
    [[nodiscard]] std::uint32_t tiles() const;
    [[nodiscard]] gpu::ListBand push(const StripBand& band, float min_transmittance, std::uint32_t tile_class) const {
        return {.first_strip = band.first,
                .tile_stride = tiles(),
                .min_transmittance = min_transmittance,
                .tile_class = tile_class};
    }
    void place(typename B::Commands& cmd, const StripBand& band) const;
    [[nodiscard]] Result<void> check_depth(const rhi::DeviceInfo& info, std::span<const gpu::LayerStrip> strips) const;

    FragmentListsDesc desc_;
    rhi::Texture counts_ = {};
    rhi::Unique<typename B::Device, rhi::Buffer> bases_, classes_, tiles_;
    rhi::Unique<typename B::Device, rhi::Texture> cursors_, nodes_, looks_;
    rhi::Unique<typename B::Device, rhi::Group> place_group_, fill_group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> place_;
    CullVariants<B> fill_;
    std::vector<StripBand> bands_;
    std::vector<std::uint32_t> strip_bases_;
    std::uint32_t rows_ = 0;  ///< of `nodes_`
};

}  // namespace pellucid::inline v0_1

#include <pellucid/passes/fragment_lists-inl.hpp>
