// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The frame as a list of passes with declared reads and writes: passes that nothing reads are culled before anything
/// of theirs is built, and textures whose lifetimes do not overlap share memory.
#include <pellucid/core/small_vector.hpp>
#include <pellucid/graph/frame.hpp>
#include <pellucid/graph/report.hpp>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace pellucid::inline v0_1 {

/// Names a texture of a graph.
struct GraphTexture {
    std::uint32_t index = ~0u;
    [[nodiscard]] explicit operator bool() const noexcept { return index != ~0u; }
    friend bool operator==(GraphTexture, GraphTexture) = default;
};

/// What a pass reads and writes: its order and its life follow from that.
struct GraphPassDesc {
    const char* name = "pass";
    SmallVector<GraphTexture, 8> reads = {};
    SmallVector<GraphTexture, 8> writes = {};  ///< written; also listed in `reads` where earlier content matters
    bool live = false;  ///< runs even if nothing reads its textures: it writes buffers that the graph does not know
};

/// Passes run in the order they were added.  Build once, execute every frame without allocation.
template <rhi::Backend B>
class Graph {
public:
    /// Declares a texture that lives as long as the graph needs it; nothing is allocated yet.
    [[nodiscard]] GraphTexture texture(const rhi::TextureDesc& desc);

    /// Adds a pass.  `create(device) -> Result<void>` builds its pipelines and groups, only if the pass is live, after
    /// all textures exist; `record(commands)` records it every frame, or `record(frame) -> Result<void>`, which may
    /// flush the frame to see on the CPU what the GPU found.
    template <class Create, class Record>
    void add(const GraphPassDesc& desc, Create create, Record record);

    /// Notes a pass that the scene does not need, with the reason, for the report.
    void leave_out(const char* name, std::string reason) { reports_.push_back({name, false, std::move(reason)}); }

    /// The texture is wanted after the frame: whatever writes it is live and its memory is not shared afterwards.
    void keep(GraphTexture texture) { nodes_kept_.push_back(texture); }

    /// Culls, allocates and creates.  Errors: those of texture creation and of the passes' own creation.
    [[nodiscard]] Result<void> compile(typename B::Device& device);

    /// Records every live pass into an open frame.  `around(name, record)` is called for each and must call `record()`
    /// once.  Errors: those of the passes; what comes after is not recorded then.
    template <class Around>
    [[nodiscard]] Result<void> execute(Frame<B>& frame, Around&& around);

    [[nodiscard]] rhi::Texture operator[](GraphTexture t) const { return textures_[t.index].physical; }
    [[nodiscard]] const std::vector<PassReport>& passes() const noexcept { return reports_; }
    [[nodiscard]] const std::vector<TextureReport>& textures() const noexcept { return texture_reports_; }

private:
    struct Node {
        explicit Node(const GraphPassDesc& d) : desc(d) {}
        virtual ~Node() = default;
        virtual Result<void> create(typename B::Device& device) = 0;
        virtual Result<void> record(Frame<B>& frame) = 0;
        GraphPassDesc desc;
        bool live = false;
    };
    struct Virtual {
        rhi::TextureDesc desc;
        rhi::Texture physical = {};
        std::size_t first = ~std::size_t{0}, last = 0;  ///< first and last live pass that touches it
    };
    void cull();
    [[nodiscard]] Result<void> allocate(typename B::Device& device);

    std::vector<Virtual> textures_;
    std::vector<GraphTexture> nodes_kept_;
    std::vector<rhi::Unique<typename B::Device, rhi::Texture>> owned_;
    std::vector<std::unique_ptr<Node>> nodes_;  // after owned_: passes go before the textures they use
    std::vector<PassReport> reports_;
    std::vector<TextureReport> texture_reports_;
};

using rhi::texture_bytes;

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
GraphTexture Graph<B>::texture(const rhi::TextureDesc& desc) {
    textures_.push_back({.desc = desc});
    return {static_cast<std::uint32_t>(textures_.size() - 1)};
}

template <rhi::Backend B>
template <class Create, class Record>
void Graph<B>::add(const GraphPassDesc& desc, Create create, Record record) {
    struct Made final : Node {
        Made(const GraphPassDesc& d, Create c, Record r) : Node(d), create_(std::move(c)), record_(std::move(r)) {}
        Result<void> create(typename B::Device& device) override { return create_(device); }
        Result<void> record(Frame<B>& frame) override {
            if constexpr (std::is_invocable_v<Record&, Frame<B>&>) {
                return record_(frame);
            } else {
                record_(frame.commands());
                return {};
            }
        }
        Create create_;
        Record record_;
    };
    nodes_.push_back(std::make_unique<Made>(desc, std::move(create), std::move(record)));
}

template <rhi::Backend B>
void Graph<B>::cull() {
    std::vector<bool> wanted(textures_.size(), false);
    for (const GraphTexture t : nodes_kept_) wanted[t.index] = true;
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
        (*node)->live = (*node)->desc.live;
        for (const GraphTexture t : (*node)->desc.writes) (*node)->live = (*node)->live || wanted[t.index];
        if (!(*node)->live) continue;
        // What this pass writes without reading it, nobody needs to have written before.
        for (const GraphTexture t : (*node)->desc.writes) wanted[t.index] = false;
        for (const GraphTexture t : (*node)->desc.reads) wanted[t.index] = true;
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = *nodes_[i];
        reports_.push_back({node.desc.name, node.live, node.live ? "" : "nothing reads what it writes"});
        if (!node.live) continue;
        auto touch = [&](GraphTexture t) {
            Virtual& texture = textures_[t.index];
            texture.first = std::min(texture.first, i);
            texture.last = std::max(texture.last, i);
        };
        for (const GraphTexture t : node.desc.reads) touch(t);
        for (const GraphTexture t : node.desc.writes) touch(t);
    }
    for (const GraphTexture t : nodes_kept_) textures_[t.index].last = nodes_.size();
}

template <rhi::Backend B>
Result<void> Graph<B>::allocate(typename B::Device& device) {
    struct Physical {
        rhi::TextureDesc desc;
        rhi::Texture texture;
        std::size_t free_after;
    };
    std::vector<Physical> physical;
    for (std::size_t pass = 0; pass < nodes_.size(); ++pass) {
        for (Virtual& v : textures_) {
            if (v.first != pass) continue;
            const rhi::TextureDesc& d = v.desc;
            Physical* reused = nullptr;
            for (Physical& p : physical)
                if (p.free_after < pass && p.desc.size == d.size && p.desc.format == d.format &&
                    p.desc.mips == d.mips && p.desc.layers == d.layers && p.desc.kind == d.kind &&
                    p.desc.usage == d.usage)
                    reused = &p;
            if (reused) {
                v.physical = reused->texture;
                reused->free_after = v.last;
            } else {
                rhi::Unique<typename B::Device, rhi::Texture> made;
                PELLUCID_OWN(made, device, device.make_texture(d));
                v.physical = made;
                physical.push_back({d, made, v.last});
                owned_.push_back(std::move(made));
            }
            texture_reports_.push_back({d.debug_name, reused ? 0 : texture_bytes(d), reused != nullptr});
        }
    }
    return {};
}

template <rhi::Backend B>
Result<void> Graph<B>::compile(typename B::Device& device) {
    cull();
    PELLUCID_CHECK(allocate(device));
    for (const auto& node : nodes_)
        if (node->live) PELLUCID_CHECK(node->create(device));
    return {};
}

template <rhi::Backend B>
template <class Around>
Result<void> Graph<B>::execute(Frame<B>& frame, Around&& around) {
    for (const auto& node : nodes_) {
        if (!node->live) continue;
        Result<void> recorded;
        around(node->desc.name, [&] { recorded = node->record(frame); });
        PELLUCID_CHECK(std::move(recorded));
    }
    return {};
}

}  // namespace pellucid::inline v0_1
