// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of FragmentLists<B>.
#include <pellucid/passes/fragment_lists.hpp>

namespace pellucid::inline v0_1 {

namespace detail {

/// Group layouts of the lists' own passes: images below PELLUCID_PASS_0, buffers from there on.
inline rhi::GroupLayout list_layout(std::initializer_list<std::uint32_t> bindings) {
    rhi::GroupLayout layout;
    for (const std::uint32_t b : bindings)
        layout.bindings.push_back(
            {b, b < PELLUCID_PASS_0 ? rhi::BindingKind::storage_texture : rhi::BindingKind::storage_buffer});
    return layout;
}
inline rhi::GroupLayout place_layout() {
    return list_layout({PELLUCID_LAYERS_COUNTS, PELLUCID_LISTS_CURSORS, PELLUCID_LISTS_BASES, PELLUCID_LISTS_CLASSES,
                        PELLUCID_LISTS_TILES});
}
inline rhi::GroupLayout fill_layout(FragmentContent content) {
    rhi::GroupLayout layout = list_layout({PELLUCID_LISTS_CURSORS, PELLUCID_LISTS_NODES});
    if (content == FragmentContent::surfaces)
        layout.bindings.push_back({PELLUCID_LISTS_LOOKS, rhi::BindingKind::storage_texture});
    return layout;
}

}  // namespace detail

template <rhi::Backend B>
std::uint32_t FragmentLists<B>::tiles() const {
    return (desc_.fragments.size.width + PELLUCID_LAYERS_TILE - 1) / PELLUCID_LAYERS_TILE *
           static_cast<std::uint32_t>(strip_bases_.size());
}

template <rhi::Backend B>
Result<FragmentLists<B>> FragmentLists<B>::create(typename B::Device& device, const FragmentListsDesc& desc,
                                                  rhi::Texture counts) {
    using enum rhi::BufferUsage;
    FragmentLists lists;
    lists.desc_ = desc;
    lists.counts_ = counts;
    lists.strip_bases_.resize((desc.fragments.size.height + PELLUCID_LAYERS_TILE - 1) / PELLUCID_LAYERS_TILE);
    PELLUCID_OWN(lists.bases_, device,
                 device.make_buffer({.size = lists.strip_bases_.size() * 4,
                                     .usage = storage | copy_destination,
                                     .debug_name = "fragment_lists.bases"}));
    PELLUCID_OWN(lists.classes_, device,
                 device.make_buffer({.size = PELLUCID_LISTS_CLASS_COUNT * sizeof(gpu::ListClass),
                                     .usage = storage | indirect | copy_destination,
                                     .debug_name = "fragment_lists.classes"}));
    PELLUCID_OWN(lists.tiles_, device,
                 device.make_buffer({.size = std::uint64_t{4} * PELLUCID_LISTS_CLASS_COUNT * lists.tiles(),
                                     .usage = storage,
                                     .debug_name = "fragment_lists.tiles"}));
    PELLUCID_OWN(lists.cursors_, device,
                 device.make_texture({.size = desc.fragments.size,
                                      .format = rhi::Format::r32_uint,
                                      .usage = rhi::TextureUsage::storage,
                                      .debug_name = "fragment_lists.cursors"}));
    PELLUCID_OWN(lists.place_, device,
                 device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::fragment_lists_place_comp,
                                                               .pass_group = detail::place_layout(),
                                                               .push_bytes = sizeof(gpu::ListBand),
                                                               .debug_name = "fragment_lists.place"}));
    const auto constants = desc.fragments.constants();
    const rhi::Shader* const shade = lists.lit_later()      ? &shaders::fragment_lists_surfaces_frag
                                     : desc.fragments.exact ? &shaders::fragment_lists_colors_frag_exact
                                                            : &shaders::fragment_lists_colors_frag;
    PELLUCID_CHECK(lists.fill_.create(device,
                                      {.vertex = &shaders::scene_vert,
                                       .fragment = shade,
                                       .constants = constants,
                                       .pass_group = detail::fill_layout(desc.content),
                                       .scene_group = scene_group_layout(),
                                       .depth = FragmentDesc::depth_test(),
                                       .debug_name = "fragment_lists.fill"},
                                      desc.fragments.culls));
    return lists;
}

template <rhi::Backend B>
Result<bool> FragmentLists<B>::prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips) {
    constexpr std::uint32_t width = 1u << PELLUCID_LISTS_WIDTH_BITS;
    std::uint64_t most = std::uint64_t{device.info().max_texture_size} * width;
    if (desc_.memory_budget != 0) most = std::min(most, desc_.memory_budget / fragment_bytes());
    if (most > width) most -= most % width;  // an image has whole rows, and at least one
    PELLUCID_TRY(bands_, split_strips(strips, most, fragment_bytes()));
    PELLUCID_CHECK(check_depth(device.info(), strips));
    std::uint32_t needed = 0;
    for (const StripBand& band : bands_) {
        std::uint32_t base = 0;
        for (std::uint32_t i = band.first; i < band.first + band.count; ++i) {
            strip_bases_[i] = base;
            base += strips[i].slots;
        }
        needed = std::max(needed, band.slots);
    }
    const std::uint32_t rows = (needed + width - 1) / width;
    if (rows <= rows_) return false;
    rows_ = rows;
    nodes_.reset();
    looks_.reset();
    rhi::TextureDesc pool{.size = {width, rows},
                          .format = rhi::Format::rgba32_uint,
                          .usage = rhi::TextureUsage::storage,
                          .debug_name = "fragment_lists.nodes"};
    PELLUCID_OWN(nodes_, device, device.make_texture(pool));
    pool.debug_name = "fragment_lists.looks";
    if (lit_later()) {
        PELLUCID_OWN(looks_, device, device.make_texture(pool));
    }
    PELLUCID_OWN(place_group_, device,
                 device.make_group({.layout = detail::place_layout(),
                                    .bindings = {{.binding = PELLUCID_LAYERS_COUNTS, .texture = counts_},
                                                 {.binding = PELLUCID_LISTS_CURSORS, .texture = cursors_},
                                                 {.binding = PELLUCID_LISTS_BASES, .buffer = bases_},
                                                 {.binding = PELLUCID_LISTS_CLASSES, .buffer = classes_},
                                                 {.binding = PELLUCID_LISTS_TILES, .buffer = tiles_}},
                                    .debug_name = "fragment_lists.place"}));
    rhi::GroupDesc fill{.layout = detail::fill_layout(desc_.content),
                        .bindings = {{.binding = PELLUCID_LISTS_CURSORS, .texture = cursors_},
                                     {.binding = PELLUCID_LISTS_NODES, .texture = nodes_}},
                        .debug_name = "fragment_lists.fill"};
    if (looks_) fill.bindings.push_back({.binding = PELLUCID_LISTS_LOOKS, .texture = looks_});
    PELLUCID_OWN(fill_group_, device, device.make_group(fill));
    return true;
}

template <rhi::Backend B>
Result<void> FragmentLists<B>::check_depth(const rhi::DeviceInfo& info, std::span<const gpu::LayerStrip> strips) const {
    const std::uint32_t most = deepest_walk(info.max_loop_turns, desc_.visit_turns);
    for (std::size_t i = 0; i < strips.size(); ++i)
        if (strips[i].deepest > most)
            return Error{Errc::unsupported, "a pixel of rows " + std::to_string(i * PELLUCID_LAYERS_TILE) + " to " +
                                                std::to_string((i + 1) * PELLUCID_LAYERS_TILE - 1) + " has " +
                                                std::to_string(strips[i].deepest) + " translucent fragments, and " +
                                                info.name + " ends shaders after " +
                                                std::to_string(info.max_loop_turns) +
                                                " turns of their loops, which sort " + std::to_string(most) +
                                                ": use the method 'peel', or another device"};
    return {};
}

template <rhi::Backend B>
void FragmentLists<B>::place(typename B::Commands& cmd, const StripBand& band) const {
    using enum rhi::Access;
    gpu::ListClass empty[PELLUCID_LISTS_CLASS_COUNT];
    for (gpu::ListClass& c : empty) c = {.columns = PELLUCID_LISTS_COLUMNS, .depth = 1};
    cmd.begin_copy(
        {.uses = {rhi::use(bases_, copy_write), rhi::use(classes_, copy_write)}, .name = "fragment_lists.bases"});
    cmd.update(bases_, 0, rhi::bytes_of(std::span<const std::uint32_t>(strip_bases_)));
    cmd.update(classes_, 0, rhi::bytes_of(std::span<const gpu::ListClass>(empty)));
    cmd.end_copy();
    cmd.begin_compute(
        {.uses = {rhi::use(counts_, storage_read), rhi::use(bases_, storage_read), rhi::use(cursors_, storage_write),
                  rhi::use(classes_, storage_read_write), rhi::use(tiles_, storage_write)},
         .name = "fragment_lists.place"});
    cmd.bind_pipeline(place_);
    cmd.bind_group(place_group_);
    cmd.push(rhi::bytes_of(push(band, 0, 0)));
    cmd.dispatch(band.count, 1, 1);
    cmd.end_compute();
}

template <rhi::Backend B>
void FragmentLists<B>::record(typename B::Commands& cmd, const StripBand& band, rhi::Texture depth,
                              const SceneBinding& scene, std::span<const DrawItem> items) const {
    using enum rhi::Access;
    place(cmd, band);
    rhi::RenderPassDesc pass = desc_.fragments.render_pass(depth, scene, "fragment_lists.fill");
    pass.uses.push_back(rhi::use(cursors_, storage_read_write));
    pass.uses.push_back(rhi::use(nodes_, storage_write));
    if (looks_) pass.uses.push_back(rhi::use(looks_, storage_write));
    cmd.begin_render(pass);
    const Extent2D size = desc_.fragments.size;
    const std::uint32_t top = band.first * PELLUCID_LAYERS_TILE;
    cmd.set_scissor(
        {.y = top, .width = size.width, .height = std::min(band.count * PELLUCID_LAYERS_TILE, size.height - top)});
    draw_items<B>(cmd, fill_, scene, items, fill_group_);
    cmd.end_render();
}

template <rhi::Backend B>
rhi::GroupDesc FragmentLists<B>::walker_group(const SmallVector<BoundTexture, 8>& images,
                                              const SmallVector<BoundTexture, 8>& textures, rhi::Sampler sampler,
                                              const char* debug_name) const {
    rhi::GroupDesc group = sampled_group(sampler, textures, debug_name);
    const auto image = [&](std::uint32_t binding, rhi::Texture texture) {
        group.layout.bindings.push_back({binding, rhi::BindingKind::storage_texture});
        group.bindings.push_back({.binding = binding, .texture = texture});
    };
    const auto buffer = [&](std::uint32_t binding, rhi::Buffer made) {
        group.layout.bindings.push_back({binding, rhi::BindingKind::storage_buffer});
        group.bindings.push_back({.binding = binding, .buffer = made});
    };
    image(PELLUCID_LAYERS_COUNTS, counts_);
    image(PELLUCID_LISTS_CURSORS, cursors_);
    image(PELLUCID_LISTS_NODES, nodes_);
    if (lit_later()) image(PELLUCID_LISTS_LOOKS, looks_);
    for (const BoundTexture& own : images) image(own.binding, own.texture);
    buffer(PELLUCID_LISTS_CLASSES, classes_);
    buffer(PELLUCID_LISTS_TILES, tiles_);
    return group;
}

template <rhi::Backend B>
void FragmentLists<B>::walk(typename B::Commands& cmd, const StripBand& band, const SceneBinding& scene, rhi::Uses uses,
                            std::span<const rhi::Pipeline, PELLUCID_LISTS_CLASS_COUNT> pipelines, rhi::Group group,
                            float min_transmittance, const char* name) const {
    using enum rhi::Access;
    for (const rhi::Texture t : {counts_, cursors_.get(), nodes_.get()}) uses.push_back(rhi::use(t, storage_read));
    if (looks_) uses.push_back(rhi::use(looks_, storage_read));
    uses.push_back(rhi::use(tiles_, storage_read));
    uses.push_back(rhi::use(classes_, storage_read));
    uses.push_back(rhi::use(classes_, indirect_read));
    if (lit_later())
        for (const rhi::ResourceUse& u : scene.uses) uses.push_back(u);
    cmd.begin_compute({.uses = uses, .name = name});
    rhi::Pipeline pipeline{};
    for (std::uint32_t c = 0; c < PELLUCID_LISTS_CLASS_COUNT; ++c) {
        if (pipelines[c]) pipeline = pipelines[c];
        cmd.bind_pipeline(pipeline);
        if (lit_later()) cmd.bind_frame(scene.frame, scene.records);
        cmd.bind_group(group);
        if (lit_later()) cmd.bind_group(scene.group);
        cmd.push(rhi::bytes_of(push(band, min_transmittance, c)));
        cmd.dispatch_indirect(classes_, c * sizeof(gpu::ListClass));
    }
    cmd.end_compute();
}

}  // namespace pellucid::inline v0_1
