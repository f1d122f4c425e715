// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The shadow maps of a scene on the GPU: the array, a record a map, and which of them have to be drawn again.
#include <pellucid/passes/shadow_map.hpp>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include <pellucid/renderer/shadow_fit.hpp>
#include <span>
#include <vector>

namespace pellucid::inline v0_1 {

/// An instance that casts.
struct ShadowCaster {
    DrawItem item;  ///< its record is that of the frame
    WorldBox bounds;
    bool masked = false;
};

/// Owns what shadow maps take.  Cascades are fitted to each frame's camera and drawn again where that moved their map;
/// maps of spots and point lights are drawn again where their light moved.
template <rhi::Backend B>
class GpuShadows {
public:
    /// `lights`: as they are stored (renderer/gpu_lights.hpp).  Errors: those of creation.
    [[nodiscard]] static Result<GpuShadows> create(typename B::Device& device, std::span<const Light> lights,
                                                   const RenderSettings& settings, const SceneNeeds& needs);
    /// Once, after create: what casts, and the bounds of everything.
    void place(std::vector<ShadowCaster> casters, const WorldBox& all);
    /// Other lights in the place of those of `create`, with as many maps each, from the next record on.
    void set_lights(std::span<const Light> lights);
    /// Writes the records of this camera and draws the maps that changed.  `view(camera, size, instances)` gives a
    /// `Result<SceneBinding>` of another view of those instances, records in their order.  Precondition: no pass is
    /// open.
    template <class View>
    [[nodiscard]] Result<void> record(typename B::Commands& cmd, const ShadowMapPass<B>& pass, const Camera& camera,
                                      Extent2D picture, View&& view);

    [[nodiscard]] rhi::Texture maps() const noexcept { return maps_; }
    [[nodiscard]] rhi::Buffer records() const noexcept { return records_; }
    [[nodiscard]] std::uint32_t size() const noexcept { return size_; }
    [[nodiscard]] std::uint32_t culls(bool masked) const noexcept { return culls_[masked ? 1 : 0]; }
    /// The views of a light's maps in the last frame; `light` as they are stored.
    [[nodiscard]] const ShadowCameras& cameras(std::size_t light) const noexcept { return lights_[light].cameras; }
    [[nodiscard]] std::uint32_t first_layer(std::size_t light) const noexcept { return lights_[light].first_layer; }
    /// Maps that the last frame drew.
    [[nodiscard]] std::uint32_t drawn() const noexcept { return drawn_; }
    /// Calls `add(debug_name, bytes)` for each texture and buffer.
    template <class Add>
    void each_resource(Add&& add) const {
        add("scene.shadow_maps", std::uint64_t{4} * size_ * size_ * layers_);
        add("scene.shadows", record_data_.size() * sizeof(gpu::ShadowRecord));
    }

private:
    struct LightMaps {
        Light light;
        std::uint32_t count = 0, first_layer = 0, rest = 0;
        ShadowCameras cameras, drawn;  ///< wanted now, and what the layers hold
    };
    void fit_placed();
    void fit_cascades(const Camera& camera, Extent2D picture);
    void write(typename B::Commands& cmd, const Camera& camera);
    template <class View>
    Result<void> draw(typename B::Commands& cmd, const ShadowMapPass<B>& pass, const Camera& map, std::uint32_t layer,
                      View&& view);

    std::vector<LightMaps> lights_;
    std::vector<gpu::ShadowRecord> record_data_;
    std::vector<ShadowCaster> casters_;
    std::vector<WorldBox> boxes_;
    ShadowScene scene_;
    std::vector<std::uint32_t> instances_;  ///< of the map that is drawn
    std::vector<DrawItem> opaque_, masked_;
    rhi::Unique<typename B::Device, rhi::Texture> maps_;
    rhi::Unique<typename B::Device, rhi::Buffer> records_;
    std::uint32_t size_ = 0, layers_ = 0, drawn_ = 0, culls_[2] = {0, 0};
    bool written_ = false;
    glm::dmat4 written_for_{1.0};
};

// ------------------------------------------------------------------------------------------------------- bodies

/// What a shader needs to know of a map that `map` looks into, for points of `camera`'s view space.
[[nodiscard]] inline gpu::ShadowRecord gpu_shadow(const Camera& map, std::uint32_t size, const Camera& camera) {
    const glm::dmat4 m = rigid_inverse(map.world_from_view) * camera.world_from_view;
    const ClipFromView clip = clip_from_view(map, {size, size});
    gpu::ShadowRecord r{};
    const auto row = [&](int i) { return to_gpu(glm::dvec3(m[0][i], m[1][i], m[2][i])); };
    r.axis_x = row(0), r.axis_y = row(1), r.axis_z = row(2);
    r.offset_x = static_cast<float>(m[3].x);
    r.offset_y = static_cast<float>(m[3].y);
    r.offset_z = static_cast<float>(m[3].z);
    r.clip = {static_cast<float>(clip.zz), static_cast<float>(clip.zw), static_cast<float>(clip.wz),
              static_cast<float>(clip.ww)};
    r.scale = static_cast<float>(0.5 * size * clip.sx);
    r.half_side = 0.5f * static_cast<float>(size);
    // A point is four roundings of its distance from the eye off (reference/gbuffer.hpp), its place in the map as many
    // of the way between the eye and the map; depth of parallel rays is a share of the map's.
    const bool parallel = map.projection == Projection::orthographic;
    const double away = glm::length(glm::dvec3(m[3])) + (parallel ? map.far + 2 * map.half_height : 0);
    r.error = static_cast<float>(0x1p-21 * away);
    r.spread = parallel ? 0 : 0x1p-21f;
    return r;
}

template <rhi::Backend B>
Result<GpuShadows<B>> GpuShadows<B>::create(typename B::Device& device, std::span<const Light> lights,
                                            const RenderSettings& settings, const SceneNeeds& needs) {
    GpuShadows out;
    out.size_ = settings.shadow_size;
    out.layers_ = needs.shadow_maps;
    std::uint32_t layer = 0, rest = static_cast<std::uint32_t>(lights.size());
    for (const Light& light : lights) {
        const std::uint32_t count = shadow_maps_of(light);
        out.lights_.push_back({.light = light, .count = count, .first_layer = layer, .rest = rest});
        layer += count;
        rest += count == 0 ? 0 : count - 1;
    }
    out.record_data_.resize(rest);
    using enum rhi::TextureUsage;
    PELLUCID_OWN(out.maps_, device,
                 device.make_texture({.size = {out.size_, out.size_},
                                      .layers = out.layers_,
                                      .format = rhi::Format::d32_float,
                                      .kind = rhi::TextureKind::array,
                                      .usage = attachment | sampled | copy_source,
                                      .debug_name = "scene.shadow_maps"}));
    PELLUCID_OWN(out.records_, device,
                 device.make_buffer({.size = out.record_data_.size() * sizeof(gpu::ShadowRecord),
                                     .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_destination,
                                     .debug_name = "scene.shadows"}));
    return out;
}

template <rhi::Backend B>
void GpuShadows<B>::place(std::vector<ShadowCaster> casters, const WorldBox& all) {
    casters_ = std::move(casters);
    scene_.all = all;
    for (const ShadowCaster& c : casters_) {
        scene_.casters.add(c.bounds);
        boxes_.push_back(c.bounds);
        culls_[c.masked ? 1 : 0] |= 1u << static_cast<std::uint32_t>(c.item.cull);
    }
    instances_.reserve(casters_.size());
    opaque_.reserve(casters_.size());
    masked_.reserve(casters_.size());
    fit_placed();
}

template <rhi::Backend B>
void GpuShadows<B>::set_lights(std::span<const Light> lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) lights_[i].light = lights[i];
    fit_placed();
}

template <rhi::Backend B>
void GpuShadows<B>::fit_placed() {
    for (LightMaps& l : lights_)
        if (l.count != 0 && l.light.kind != LightKind::directional)
            l.cameras = placed_maps(l.light, l.count, scene_, boxes_, size_);
}

template <rhi::Backend B>
void GpuShadows<B>::fit_cascades(const Camera& camera, Extent2D picture) {
    for (LightMaps& l : lights_)
        if (l.count != 0 && l.light.kind == LightKind::directional)
            l.cameras = cascades(l.light, camera, picture, scene_, size_);
}

template <rhi::Backend B>
void GpuShadows<B>::write(typename B::Commands& cmd, const Camera& camera) {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const LightMaps& l = lights_[i];
        for (std::uint32_t k = 0; k < l.cameras.size(); ++k) {
            gpu::ShadowRecord r = gpu_shadow(l.cameras[k], size_, camera);
            r.layer = l.first_layer + k;
            r.count = static_cast<std::uint32_t>(l.cameras.size());
            r.rest = l.rest;
            record_data_[k == 0 ? i : l.rest + k - 1] = r;
        }
    }
    cmd.begin_copy({.uses = {rhi::use(records_, rhi::Access::copy_write)}, .name = "shadows"});
    const auto bytes = rhi::bytes_of(std::span<const gpu::ShadowRecord>(record_data_));
    constexpr std::size_t step = 65536 / sizeof(gpu::ShadowRecord) * sizeof(gpu::ShadowRecord);  // whole records
    for (std::size_t at = 0; at < bytes.size(); at += step)
        cmd.update(records_, at, bytes.subspan(at, std::min(step, bytes.size() - at)));
    cmd.end_copy();
}

template <rhi::Backend B>
template <class View>
Result<void> GpuShadows<B>::draw(typename B::Commands& cmd, const ShadowMapPass<B>& pass, const Camera& map,
                                 std::uint32_t layer, View&& view) {
    const ClipFromView clip = clip_from_view(map, {size_, size_});
    const glm::dmat4 map_from_world = rigid_inverse(map.world_from_view);
    instances_.clear();
    opaque_.clear();
    masked_.clear();
    for (const ShadowCaster& c : casters_) {
        if (!casts_into(c.bounds, clip, map_from_world)) continue;
        DrawItem item = c.item;
        item.record = static_cast<std::uint32_t>(instances_.size());
        instances_.push_back(c.item.record);
        (c.masked ? masked_ : opaque_).push_back(item);
    }
    SceneBinding binding;
    PELLUCID_TRY(binding, view(map, Extent2D{size_, size_}, std::span<const std::uint32_t>(instances_)));
    pass.record(cmd, {.maps = maps_, .layer = layer, .size = size_}, binding, opaque_, masked_);
    ++drawn_;
    return {};
}

template <rhi::Backend B>
template <class View>
Result<void> GpuShadows<B>::record(typename B::Commands& cmd, const ShadowMapPass<B>& pass, const Camera& camera,
                                   Extent2D picture, View&& view) {
    const auto same = [](const Camera& a, const Camera& b) {
        return a.world_from_view == b.world_from_view && a.half_height == b.half_height && a.far == b.far &&
               a.vertical_fov == b.vertical_fov && a.near == b.near;
    };
    drawn_ = 0;
    fit_cascades(camera, picture);
    for (LightMaps& l : lights_) {
        for (std::uint32_t k = 0; k < l.cameras.size(); ++k) {
            if (k < l.drawn.size() && same(l.drawn[k], l.cameras[k])) continue;
            PELLUCID_CHECK(draw(cmd, pass, l.cameras[k], l.first_layer + k, view));
        }
        written_ = written_ && l.drawn.size() == l.cameras.size();
        l.drawn = l.cameras;
    }
    if (!written_ || drawn_ != 0 || camera.world_from_view != written_for_) write(cmd, camera);
    written_ = true;
    written_for_ = camera.world_from_view;
    return {};
}

}  // namespace pellucid::inline v0_1
