// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of GpuScene<B>: what is made once.
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/renderer/texture_levels.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
template <class T>
Result<void> GpuScene<B>::make_buffer(typename B::Device& device, rhi::Unique<typename B::Device, rhi::Buffer>& out,
                                      std::span<const T> values, rhi::BufferUsage usage, const char* debug_name) {
    // An empty table still is a buffer: every binding of a group must be there.
    const T none{};
    const auto bytes = values.empty() ? rhi::bytes_of(none) : rhi::bytes_of(values);
    if (const std::uint64_t limit = device.info().max_storage_buffer_bytes; bytes.size() > limit)
        return Error{Errc::unsupported, std::string(debug_name) + " takes " + std::to_string(bytes.size()) +
                                            " bytes; the largest storage buffer of " + device.info().name + " is " +
                                            std::to_string(limit) + " bytes: split or simplify the scene"};
    PELLUCID_OWN(out, device,
                 device.make_buffer({.size = bytes.size(),
                                     .usage = usage | rhi::BufferUsage::storage,
                                     .initial = bytes,
                                     .debug_name = debug_name}));
    resources_.push_back({debug_name, bytes.size(), false});
    return {};
}

template <rhi::Backend B>
Result<void> GpuScene<B>::make_textures(typename B::Device& device, const Scene& scene, const TexturePlan& plan) {
    auto filter = [](TextureFilter f) {
        return f == TextureFilter::linear ? rhi::Filter::linear : rhi::Filter::nearest;
    };
    auto wrap = [](TextureWrap w) {
        return w == TextureWrap::repeat   ? rhi::Wrap::repeat
               : w == TextureWrap::mirror ? rhi::Wrap::mirror
                                          : rhi::Wrap::clamp;
    };
    for (const TextureArrayPlan& array : plan.arrays) {
        // All layers of mip 0, then of mip 1, …: the order of TextureDesc::initial.
        std::vector<std::vector<Image8>> chains;
        for (const std::uint32_t image : array.images)
            chains.push_back(
                texture_levels(scene.images[image].pixels, array.size, array.srgb, array.sampler.mipmapped));
        std::vector<std::byte> texels;
        for (std::size_t mip = 0; mip < chains[0].size(); ++mip)
            for (const auto& chain : chains) {
                const auto bytes = std::as_bytes(std::span(chain[mip].data));
                texels.insert(texels.end(), bytes.begin(), bytes.end());
            }
        const rhi::TextureDesc desc{.size = array.size,
                                    .layers = static_cast<std::uint32_t>(chains.size()),
                                    .mips = static_cast<std::uint32_t>(chains[0].size()),
                                    .format = array.srgb ? rhi::Format::rgba8_srgb : rhi::Format::rgba8_unorm,
                                    .kind = rhi::TextureKind::array,
                                    .initial = texels,
                                    .debug_name = array.srgb ? "scene.color_textures" : "scene.data_textures"};
        rhi::Unique<typename B::Device, rhi::Texture> texture;
        PELLUCID_OWN(texture, device, device.make_texture(desc));
        resources_.push_back({desc.debug_name, texture_bytes(desc), false});
        textures_.push_back(std::move(texture));
        rhi::Unique<typename B::Device, rhi::Sampler> sampler;
        PELLUCID_OWN(sampler, device,
                     device.make_sampler({.min = filter(array.sampler.min),
                                          .mag = filter(array.sampler.mag),
                                          .mip = filter(array.sampler.mip),
                                          .mipmapped = array.sampler.mipmapped,
                                          .wrap_u = wrap(array.sampler.wrap_u),
                                          .wrap_v = wrap(array.sampler.wrap_v),
                                          .debug_name = desc.debug_name}));
        samplers_.push_back(std::move(sampler));
    }
    return {};
}

template <rhi::Backend B>
void GpuScene<B>::place_instances(const Scene& scene, const MeshPlacement& meshes, const RenderSettings& settings) {
    std::uint32_t primitive = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Material& material = scene.materials[mesh.material];
        const bool blend = material.alpha_mode == AlphaMode::blend;
        if (mesh.indices.empty() || (blend && settings.transparency == Transparency::none)) continue;
        Placed p;
        place(p.record, instance.world_from_object);  // for the mirroring; the view's matrices come every frame
        p.record.first_vertex = meshes.first_vertex[instance.mesh];
        p.record.first_index = meshes.first_index[instance.mesh];
        p.record.first_primitive = primitive;
        p.record.triangle_count = static_cast<std::uint32_t>(mesh.indices.size() / 3);
        p.record.material = mesh.material;
        p.record.instance = static_cast<std::uint32_t>(placed_.size());
        p.record.flags |= mesh.colors.empty() ? 0u : PELLUCID_DRAW_COLORS;
        primitive += p.record.triangle_count;
        triangles_ += p.record.triangle_count;
        p.world_from_object = instance.world_from_object;
        const glm::dvec3 middle = 0.5 * (glm::dvec3(mesh.lower) + glm::dvec3(mesh.upper));
        p.center = glm::dvec3(instance.world_from_object * glm::dvec4(middle, 1));
        p.bounds = WorldBox::placed(glm::dvec3(mesh.lower), glm::dvec3(mesh.upper), instance.world_from_object);
        const bool mirrored = (p.record.flags & PELLUCID_DRAW_MIRRORED) != 0;
        p.item = {.first_index = p.record.first_index,
                  .index_count = static_cast<std::uint32_t>(mesh.indices.size()),
                  .vertex_offset = static_cast<std::int32_t>(p.record.first_vertex),
                  .record = static_cast<std::uint32_t>(placed_.size()),
                  .cull = material.double_sided ? rhi::Cull::none
                          : mirrored            ? rhi::Cull::front
                                                : rhi::Cull::back};
        p.translucent = blend;
        p.masked = material.alpha_mode == AlphaMode::mask;
        mirrored_.push_back(mirrored ? 1 : 0);
        auto bit = [](rhi::Cull cull) { return 1u << static_cast<std::uint32_t>(cull); };
        if (blend && any_order(settings.transparency)) {
            translucent_culls_ |= bit(p.item.cull);
            translucent_.push_back(p.item);
        } else if (blend) {
            // Double-sided translucents are drawn as back faces, then front faces.
            translucent_culls_ |=
                material.double_sided ? bit(rhi::Cull::front) | bit(rhi::Cull::back) : bit(p.item.cull);
            sorted_.push_back({p.item, 0});
        } else {
            opaque_culls_ |= bit(p.item.cull);
            opaque_.push_back(p.item);
        }
        all_.push_back(static_cast<std::uint32_t>(placed_.size()));
        placed_.push_back(p);
    }
    if (!sorted_.empty()) translucent_.reserve(2 * sorted_.size());
    if (settings.transparency != Transparency::peel) return;
    reversed_.assign(translucent_.rbegin(), translucent_.rend());
    for (DrawItem& item : reversed_) item.first_index = meshes.reversed_index(item.first_index, item.index_count);
}

template <rhi::Backend B>
void GpuScene<B>::place_shadows() {
    std::vector<ShadowCaster> casters;
    WorldBox all;
    for (const Placed& p : placed_) {
        all.add(p.bounds);
        if (!p.translucent) casters.push_back({p.item, p.bounds, p.masked});
    }
    shadows_->place(std::move(casters), all);
}

template <rhi::Backend B>
Result<void> GpuScene<B>::make_group(typename B::Device& device, rhi::Texture shadow_maps, rhi::Buffer shadows,
                                     rhi::Unique<typename B::Device, rhi::Group>& out, SceneBinding& binding) {
    rhi::GroupDesc group{.slot = rhi::GroupSlot::scene, .layout = scene_group_layout(), .debug_name = "scene"};
    const auto bind_buffer = [&](std::uint32_t number, rhi::Buffer buffer, bool stands_in = false) {
        group.bindings.push_back({.binding = number, .buffer = buffer});
        if (!stands_in) binding.uses.push_back(rhi::use(buffer, rhi::Access::storage_read));
    };
    bind_buffer(PELLUCID_BIND_VERTICES, vertices_);
    bind_buffer(PELLUCID_BIND_INDICES, indices_);
    bind_buffer(PELLUCID_BIND_MATERIALS, materials_);
    bind_buffer(PELLUCID_BIND_LIGHTS, lights_->records());
    bind_buffer(PELLUCID_BIND_LIGHT_LISTS, lights_->lists());
    group.bindings.push_back({.binding = PELLUCID_BIND_LIGHT_BLOCK, .buffer = lights_->block()});
    binding.uses.push_back(rhi::use(lights_->block(), rhi::Access::uniform_read));
    for (std::uint32_t i = 0; i < PELLUCID_TEXTURE_ARRAYS; ++i) {
        const std::size_t at = std::min<std::size_t>(i, textures_.size() - 1);
        group.bindings.push_back(
            {.binding = PELLUCID_BIND_TEXTURES + i, .texture = textures_[at], .sampler = samplers_[at]});
        if (i == at) binding.uses.push_back(rhi::use(textures_[at], rhi::Access::sampled));
    }
    // Any array and any storage buffer stand in for shadows that there are none of: nothing reads them.
    bind_buffer(PELLUCID_BIND_SHADOWS, shadows ? shadows : lights_->records(), !shadows);
    group.bindings.push_back({.binding = PELLUCID_BIND_SHADOW_MAPS,
                              .texture = shadow_maps ? shadow_maps : textures_.back().get(),
                              .sampler = shadow_maps ? shadow_sampler_.get() : samplers_.back().get()});
    if (shadow_maps) binding.uses.push_back(rhi::use(shadow_maps, rhi::Access::sampled));
    environment_->bind(group, binding.uses);
    PELLUCID_OWN(out, device, device.make_group(group));
    binding.group = out;
    binding.indices = indices_;
    return {};
}

template <rhi::Backend B>
Result<GpuScene<B>> GpuScene<B>::create(typename B::Device& device, const Scene& scene,
                                        const RenderSettings& settings) {
    GpuScene out;
    const MeshPlacement meshes = place_meshes(scene);
    const std::vector<gpu::Vertex> vertices = gpu_vertices(scene);
    std::vector<std::uint32_t> indices;
    indices.reserve(meshes.indices);
    for (const Mesh& mesh : scene.meshes) indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    if (settings.transparency == Transparency::peel) append_reversed_triangles(indices);
    const TexturePlan plan = plan_textures(scene, PELLUCID_TEXTURE_ARRAYS, device.info().max_array_layers);
    out.warnings_ = plan.warnings;
    std::vector<gpu::MaterialRecord> materials;
    for (const Material& m : scene.materials) materials.push_back(gpu_material(m, plan));

    const SceneNeeds needs = scene_needs(scene, settings);
    PELLUCID_TRY(out.lights_, GpuLights<B>::create(device, scene, settings, needs));
    PELLUCID_TRY(out.environment_, GpuEnvironment<B>::create(device, settings, needs));
    const auto report = [&](const char* debug_name, std::uint64_t bytes) {
        out.resources_.push_back({debug_name, bytes, false});
    };
    out.lights_->each_resource(report);
    out.environment_->each_resource(report);

    using enum rhi::BufferUsage;
    PELLUCID_CHECK(
        out.make_buffer(device, out.vertices_, std::span<const gpu::Vertex>(vertices), storage, "scene.vertices"));
    PELLUCID_CHECK(
        out.make_buffer(device, out.indices_, std::span<const std::uint32_t>(indices), index, "scene.indices"));
    PELLUCID_CHECK(out.make_buffer(device, out.materials_, std::span<const gpu::MaterialRecord>(materials), storage,
                                   "scene.materials"));
    PELLUCID_CHECK(out.make_textures(device, scene, plan));
    if (out.textures_.size() < PELLUCID_TEXTURE_ARRAYS) {
        // One white texel stands in for the arrays that the scene does not need.
        const std::uint32_t white = ~0u;
        rhi::Unique<typename B::Device, rhi::Texture> texture;
        PELLUCID_OWN(texture, device,
                     device.make_texture({.size = {1, 1},
                                          .kind = rhi::TextureKind::array,
                                          .initial = rhi::bytes_of(white),
                                          .debug_name = "scene.no_texture"}));
        out.resources_.push_back({"scene.no_texture", sizeof white, false});
        out.textures_.push_back(std::move(texture));
        rhi::Unique<typename B::Device, rhi::Sampler> sampler;
        PELLUCID_OWN(sampler, device, device.make_sampler({.mipmapped = false, .debug_name = "scene.no_texture"}));
        out.samplers_.push_back(std::move(sampler));
    }
    if (needs.shadows == Shadows::map) {
        PELLUCID_TRY(out.shadows_, GpuShadows<B>::create(device, out.lights_->sources(), settings, needs));
        out.shadows_->each_resource([&](const char* debug_name, std::uint64_t bytes) {
            out.resources_.push_back({debug_name, bytes, false});
        });
        PELLUCID_OWN(out.shadow_sampler_, device, device.make_sampler(texel_sampler("scene.shadow_maps")));
        PELLUCID_CHECK(out.make_group(device, {}, {}, out.shadow_group_, out.shadow_binding_));
        PELLUCID_CHECK(out.make_group(device, out.shadows_->maps(), out.shadows_->records(), out.group_, out.binding_));
    } else {
        PELLUCID_CHECK(out.make_group(device, {}, {}, out.group_, out.binding_));
    }
    out.place_instances(scene, meshes, settings);
    if (out.shadows_) out.place_shadows();
    return out;
}

}  // namespace pellucid::inline v0_1
