// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exact transparency by blending and depth tests alone: depth peeling (Everitt 2001) in two phases, so that fragments
/// of equal depth are neither lost nor doubled.
#include <pellucid/gpu/peel.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/peel.hpp>
#include <algorithm>
#include <array>
#include <vector>

namespace pellucid::inline v0_1 {

/// How far peeling goes.
struct PeelDesc {
    FragmentDesc fragments = {};
    std::uint32_t max_layers = 0;   ///< 0: as many as there are
    std::uint32_t first_layer = 0;  ///< those before it are peeled, but not composited
    float min_transmittance = 0;    ///< a pixel is done where no more gets through; 0: only what nothing can change
    bool audit = false;             ///< count what each pixel composited, and composite it all
};

/// `[h, w]` each; `hdr` and `opaque` are the frame's, the rest belongs to the pass.
struct PeelTargets {
    rhi::Texture hdr = {};     ///< rgba16_float, attachment
    rhi::Texture opaque = {};  ///< d32_float, sampled and attachment: never written
    rhi::Texture next = {};    ///< r32_float, attachment and sampled
    rhi::Texture layer = {};   ///< d32_float, attachment
    rhi::Texture sum = {};     ///< rgba32_float, attachment and sampled
    rhi::Texture count = {};   ///< r32_float, attachment; only for an audit
};

/// Layer by layer, nearest first:
///   nearest: the depth of the nearest fragments behind the last layer, by blending with MAX under the depth test LESS;
///   advance: that depth becomes the layer, depth 0 where the pixel is done: what was found is behind something opaque,
///     or no more gets through;
///   layer: all fragments of exactly this depth (the depth test EQUAL compares bits) are shaded and composited under
///     what is there, C += T c, T *= 1 - a, in single precision; the last primitive first.
/// It goes on until no pixel has a layer, by an occlusion query of `advance`, so any number of layers is composited;
/// every fragment is shaded once.  With `max_layers` or `min_transmittance` t > 0 the error of a pixel is at most the
/// share of light that its composited layers let through (for t: at most t) times the largest radiance behind.  One
/// layer k alone is `first_layer` k and `max_layers` k + 1.  Shaders: shaders/peel.
template <rhi::Backend B>
class PeelPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<PeelPass> create(typename B::Device& device, const PeelDesc& desc,
                                                 const PeelTargets& targets);

    /// Other `first_layer` and `max_layers` than those of `create`, from the next `begin` on.
    void set_layers(std::uint32_t first, std::uint32_t most) {
        desc_.first_layer = first;
        desc_.max_layers = most;
    }
    /// Starts a frame.  `areas[k]`: pixels outside have no layer k, and none has a layer beyond the last
    /// (`layer_areas`): passes are drawn in there.  Empty: nothing is known, and they are drawn over the whole picture.
    void begin(std::vector<rhi::Rect> areas = {});
    /// Records some layers more.  Precondition of all that record: no pass is open.  `items` in the order of the scene,
    /// `reversed` the same surfaces in exactly the reverse order of primitives.
    void record_layers(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
                       std::span<const DrawItem> reversed);
    /// Once what was recorded is done: whether there are layers left to record.  Errors: those of the queries.
    [[nodiscard]] Result<bool> more(typename B::Device& device);
    /// Records the layers over `hdr`.
    void composite(typename B::Commands& cmd) const;

    [[nodiscard]] std::uint32_t layers() const { return found_; }        ///< of the last frame, from the nearest one on
    [[nodiscard]] bool truncated() const { return truncated_; }          ///< max_layers left fragments out
    [[nodiscard]] rhi::Texture sum() const { return targets_.sum; }      ///< colour and transmittance of all layers
    [[nodiscard]] rhi::Texture count() const { return targets_.count; }  ///< fragments composited; audit only

private:
    static constexpr std::uint32_t batch_limit = 64;

    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device);
    void nearest(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) const;
    void advance(typename B::Commands& cmd) const;
    void layer(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> reversed) const;
    /// Nothing is composited yet: the sums hold nothing.
    [[nodiscard]] bool nothing_composited() const { return recorded_ <= desc_.first_layer; }
    /// What layers are summed up in, cleared by the first pass that has it.
    void add_sums(rhi::RenderPassDesc& pass) const {
        const rhi::Load load = nothing_composited() ? rhi::Load::clear : rhi::Load::load;
        pass.colors.push_back({.texture = targets_.sum, .load = load, .clear = {0, 0, 0, 1}});
        if (desc_.audit) pass.colors.push_back({.texture = targets_.count, .load = load});
    }

    [[nodiscard]] rhi::Rect area(std::size_t layer) const {
        const Extent2D size = desc_.fragments.size;
        return areas_.empty() ? rhi::Rect{.width = size.width, .height = size.height} : areas_[layer];
    }
    [[nodiscard]] bool recorded_all() const { return !areas_.empty() && recorded_ == areas_.size(); }

    PeelDesc desc_;
    PeelTargets targets_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> layer_group_;
    FullScreenPass<B> advance_first_, advance_, composite_;
    rhi::Unique<typename B::Device, rhi::Queries> queries_;
    CullVariants<B> first_, nearest_, layer_;
    std::vector<rhi::Rect> areas_;
    std::uint32_t recorded_ = 0;  ///< layers of this frame, up to now
    std::uint32_t in_batch_ = 0;  ///< of them in the last batch
    std::uint32_t batch_ = 4;     ///< size of the next batch
    std::uint32_t found_ = 0;
    bool probed_ = false;  ///< the last batch ended with the question whether max_layers leaves anything out
    bool truncated_ = false;
};

}  // namespace pellucid::inline v0_1

#include <pellucid/passes/peel-inl.hpp>
