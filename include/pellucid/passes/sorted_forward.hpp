// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Transparency by sorting whole instances: blended back to front over the lit picture.
#include <pellucid/gpu/sorted_forward.h>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/shaders/sorted_forward.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pellucid::inline v0_1 {

/// A translucent instance with the distance that it is sorted by.
struct SortedItem {
    DrawItem draw = {};
    double view_depth = 0;  ///< [m] along the view direction, of the centre of the instance's bounds
};

/// Farthest first; equal depths in the order of their records, whatever the order was before; a NaN counts as nearest.
/// A total order, so the result never depends on the sort algorithm; nothing is allocated.
inline void sort_back_to_front(std::vector<SortedItem>& items) {
    auto depth = [](const SortedItem& item) {
        return std::isnan(item.view_depth) ? -std::numeric_limits<double>::infinity() : item.view_depth;
    };
    std::sort(items.begin(), items.end(), [&](const SortedItem& a, const SortedItem& b) {
        const double x = depth(a), y = depth(b);
        return x != y ? x > y : a.draw.record < b.draw.record;
    });
}

/// How fragments are lit, and which pipelines are built.
struct SortedForwardDesc {
    Brdf brdf = Brdf::gltf;
    std::uint32_t needs = PELLUCID_NEED_ALL;
    std::uint32_t culls = 7;  ///< bit (1 << Cull) for each way of culling in use
    bool exact = false;
};

/// `dst = src + (1 - alpha) dst` in linear HDR, each instance in the order given.  Every fragment is lit by the
/// function that lights opaque pixels.  Depth is tested greater-or-equal against the opaque surfaces and not written.
/// Exact where instances do not overlap in depth and none overlaps itself but for its back and front faces: a
/// double-sided instance is drawn twice, back faces first.  Shaders: shaders/sorted_forward.
template <rhi::Backend B>
class SortedForwardPass {
public:
    /// Errors: those of pipeline creation.
    [[nodiscard]] static Result<SortedForwardPass> create(typename B::Device& device, const SortedForwardDesc& desc);

    /// Records one render pass over `hdr` (rgba16_float, loaded) with `depth` read only; both `[h, w]` of `size`.
    void record(typename B::Commands& cmd, rhi::Texture hdr, rhi::Texture depth, Extent2D size,
                const SceneBinding& scene, std::span<const DrawItem> items) const;

private:
    CullVariants<B> pipelines_;
};

/// Splits double-sided instances into their back and their front faces, after sorting.
inline void split_sides(const std::vector<SortedItem>& sorted, std::vector<DrawItem>& out,
                        std::span<const std::uint8_t> mirrored) {
    out.clear();
    for (const SortedItem& item : sorted) {
        DrawItem draw = item.draw;
        if (draw.cull != rhi::Cull::none) {
            out.push_back(draw);
            continue;
        }
        const bool flip = mirrored[draw.record] != 0;
        draw.cull = flip ? rhi::Cull::back : rhi::Cull::front;
        out.push_back(draw);
        draw.cull = flip ? rhi::Cull::front : rhi::Cull::back;
        out.push_back(draw);
    }
}

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<SortedForwardPass<B>> SortedForwardPass<B>::create(typename B::Device& device, const SortedForwardDesc& desc) {
    SortedForwardPass pass;
    const rhi::SpecConstant constants[] = {{0, desc.needs}, {1, static_cast<std::uint32_t>(desc.brdf)}};
    PELLUCID_CHECK(pass.pipelines_.create(
        device,
        {.vertex = &shaders::scene_vert,
         .fragment = desc.exact ? &shaders::sorted_forward_frag_exact : &shaders::sorted_forward_frag,
         .constants = constants,
         .scene_group = scene_group_layout(),
         .colors = {{.format = rhi::Format::rgba16_float, .blend = rhi::blend_premultiplied}},
         .depth = {.format = rhi::Format::d32_float, .test = true, .compare = rhi::Compare::greater_equal},
         .debug_name = "sorted_forward"},
        desc.culls));
    return pass;
}

template <rhi::Backend B>
void SortedForwardPass<B>::record(typename B::Commands& cmd, rhi::Texture hdr, rhi::Texture depth, Extent2D size,
                                  const SceneBinding& scene, std::span<const DrawItem> items) const {
    rhi::RenderPassDesc pass{.colors = {{.texture = hdr, .load = rhi::Load::load}},
                             .depth = {.texture = depth, .load = rhi::Load::load, .read_only = true},
                             .uses = scene.uses,
                             .size = size,
                             .name = "sorted_forward"};
    pass.uses.push_back(rhi::use(scene.indices, rhi::Access::index_read));
    cmd.begin_render(pass);
    draw_items<B>(cmd, pipelines_, scene, items);
    cmd.end_render();
}

}  // namespace pellucid::inline v0_1
