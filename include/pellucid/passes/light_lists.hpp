// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Lists of the lights that reach each tile of the picture, and each slice of the view, as bits in the order of the
/// lights: nothing overflows, and a pixel that walks its list adds the same lights in the same order as a loop over all
/// of them, so the picture is the same bit for bit (tests/passes/light_lists.cpp).
///
/// Tiles bounded by depth: A. Lauritzen, "Deferred rendering for current and future rendering pipelines", 2010; lists
/// as bits, and slices apart from tiles: M. Drobot, "Improved culling for tiled and clustered rendering", 2017.
#include <pellucid/gpu/light_lists.h>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/light_lists.hpp>

namespace pellucid::inline v0_1 {

/// How lights find the pixels that they reach.
enum class LightAssignment : std::uint8_t {
    automatic,  ///< by the number of lights: `scene_needs` says which and why
    loop,       ///< every light is tried at every pixel
    volumes,   ///< opaque surfaces: each light with a range adds to the pixels in its volume (passes/light_volumes.hpp)
    tiled,     ///< lists of lights by tile, bounded by opaque depth
    clustered  ///< lists of lights by tile and slice of the view
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(LightAssignment a) noexcept {
    constexpr const char* names[] = {"auto", "loop", "volumes", "tiled", "clustered"};
    return names[static_cast<std::size_t>(a)];
}

/// How the lists of a picture lie in memory (gpu/light_lists.h).
struct LightGrid {
    Extent2D tiles = {};          ///< in a row, rows
    std::uint32_t lists = 0;      ///< a tile
    std::uint32_t slices = 0;     ///< of the view; 0: none
    std::uint32_t words = 0;      ///< a list, the summary too
    std::uint32_t summaries = 0;  ///< of them, words that summarise
    std::uint32_t kinds = 0;      ///< PELLUCID_LIGHTS_OPAQUE and …_TRANSLUCENT

    /// Of `lights` point and spot lights over a picture; `kinds`: surfaces that are lit.  Empty for a method without
    /// lists, or where no surface or no light is.
    [[nodiscard]] static constexpr LightGrid of(LightAssignment method, Extent2D size, std::uint32_t lights,
                                                std::uint32_t kinds) {
        const bool tiled = method == LightAssignment::tiled, clustered = method == LightAssignment::clustered;
        if ((!tiled && !clustered) || lights == 0 || kinds == 0) return {};
        const auto parts = [](std::uint32_t whole, std::uint32_t part) { return (whole + part - 1) / part; };
        const std::uint32_t words = parts(lights, 32), summaries = parts(words, 32);
        return {.tiles = {parts(size.width, PELLUCID_LIGHTS_TILE), parts(size.height, PELLUCID_LIGHTS_TILE)},
                .lists = tiled && kinds == (PELLUCID_LIGHTS_OPAQUE | PELLUCID_LIGHTS_TRANSLUCENT) ? 2u : 1u,
                .slices = clustered ? std::uint32_t{PELLUCID_LIGHTS_SLICES} : 0u,
                .words = summaries + words,
                .summaries = summaries,
                .kinds = kinds};
    }
    [[nodiscard]] constexpr bool empty() const noexcept { return words == 0; }
    /// First word of the slices' lists.
    [[nodiscard]] constexpr std::uint64_t slice_words() const noexcept {
        return std::uint64_t{tiles.width} * tiles.height * lists * words;
    }
    [[nodiscard]] constexpr std::uint64_t bytes() const noexcept {
        return 4 * (slice_words() + std::uint64_t{slices} * words);
    }
};

/// Fills the lists of a frame.
template <rhi::Backend B>
class LightListsPass {
public:
    /// `bounds`: vec4 a light, `lists`: `grid.bytes()`, both as storage; `depth`: d32_float of what is opaque, sampled,
    /// only read where tiles are bounded by depth (`grid.slices` is 0).  Errors: those of pipelines and groups.
    [[nodiscard]] static Result<LightListsPass> create(typename B::Device& device, const LightGrid& grid,
                                                       rhi::Buffer bounds, rhi::Buffer lists, rhi::Texture depth);
    /// Records one pass.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const SceneBinding& scene) const;
    [[nodiscard]] std::uint32_t pipelines() const noexcept { return slices_ ? 2u : 1u; }

private:
    LightGrid grid_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> tiles_, slices_;
    rhi::Uses uses_ = {};
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<LightListsPass<B>> LightListsPass<B>::create(typename B::Device& device, const LightGrid& grid,
                                                    rhi::Buffer bounds, rhi::Buffer lists, rhi::Texture depth) {
    using enum rhi::BindingKind;
    LightListsPass pass;
    pass.grid_ = grid;
    const bool clustered = grid.slices != 0;
    rhi::GroupDesc group{
        .layout = {{{PELLUCID_LIGHTS_BOUNDS, storage_buffer}, {PELLUCID_LIGHTS_LISTS, storage_buffer}}},
        .bindings = {{.binding = PELLUCID_LIGHTS_BOUNDS, .buffer = bounds},
                     {.binding = PELLUCID_LIGHTS_LISTS, .buffer = lists}},
        .debug_name = "light_lists"};
    pass.uses_ = {rhi::use(bounds, rhi::Access::storage_read), rhi::use(lists, rhi::Access::storage_write)};
    if (!clustered) {
        PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("light_lists.depth")));
        group.layout.bindings.push_back({PELLUCID_LIGHTS_DEPTH, sampled_texture});
        group.bindings.push_back({.binding = PELLUCID_LIGHTS_DEPTH, .texture = depth, .sampler = pass.sampler_});
        pass.uses_.push_back(rhi::use(depth, rhi::Access::sampled));
    }
    PELLUCID_OWN(pass.group_, device, device.make_group(group));
    const rhi::SpecConstant constants[] = {{1, grid.kinds}};
    const auto pipeline = [&](const rhi::Shader& shader, std::span<const rhi::SpecConstant> with) {
        return device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shader, .constants = with, .pass_group = group.layout, .debug_name = "light_lists"});
    };
    if (!clustered) {
        PELLUCID_OWN(pass.tiles_, device, pipeline(shaders::light_lists_tiled_comp, constants));
    } else {
        PELLUCID_OWN(pass.tiles_, device, pipeline(shaders::light_lists_columns_comp, {}));
        PELLUCID_OWN(pass.slices_, device, pipeline(shaders::light_lists_slices_comp, {}));
    }
    return pass;
}

template <rhi::Backend B>
void LightListsPass<B>::record(typename B::Commands& cmd, const SceneBinding& scene) const {
    cmd.begin_compute({.uses = uses_, .name = "light_lists"});
    cmd.bind_pipeline(tiles_);
    cmd.bind_frame(scene.frame, scene.records);
    cmd.bind_group(group_);
    cmd.dispatch(grid_.tiles.width, grid_.tiles.height, 1);
    if (slices_) {
        cmd.bind_pipeline(slices_);
        cmd.dispatch(grid_.slices, 1, 1);
    }
    cmd.end_compute();
}

}  // namespace pellucid::inline v0_1
