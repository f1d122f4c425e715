// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of GpuScene<B>: what every frame writes and draws.
#include <pellucid/renderer/gpu_scene.hpp>
#include <cstring>

namespace pellucid::inline v0_1 {

/// What a shader must know of a view: where it is and how it projects.
[[nodiscard]] inline gpu::FrameParams view_params(const Camera& camera, Extent2D size) {
    gpu::FrameParams f{};
    const glm::dmat4& w = camera.world_from_view;
    auto narrow = [](double a, double b, double c, double d) {
        return gpu::vec4{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c), static_cast<float>(d)};
    };
    f.world_x = narrow(w[0].x, w[0].y, w[0].z, 0);
    f.world_y = narrow(w[1].x, w[1].y, w[1].z, 0);
    f.world_z = narrow(w[2].x, w[2].y, w[2].z, 0);
    const ClipFromView clip = clip_from_view(camera, size);
    f.clip_scale = narrow(clip.sx, clip.sy, clip.ox, clip.oy);
    f.clip_depth = narrow(clip.zz, clip.zw, clip.wz, clip.ww);
    f.view_scale = narrow(1 / clip.sx, 1 / clip.sy, 0, 0);
    f.pixel = narrow(2.0 / size.width, 2.0 / size.height, size.width, size.height);
    f.camera_position = to_gpu(glm::dvec3(w[3]));
    return f;
}

template <rhi::Backend B>
gpu::FrameParams GpuScene<B>::frame_params(const Camera& camera, const RenderSettings& settings) const {
    gpu::FrameParams f = view_params(camera, settings.size);
    f.exposure = std::exp2(settings.exposure_ev);
    f.background = to_gpu(settings.background);
    f.draw_count = instances();
    lights_->describe(f);
    f.environment_lod = environment_->last_level();
    return f;
}

template <rhi::Backend B>
Result<void> GpuScene<B>::place_view(typename B::Commands& cmd, const glm::dmat4& view_from_world,
                                     const gpu::FrameParams& frame, std::span<const std::uint32_t> which,
                                     SceneBinding& out) const {
    PELLUCID_TRY(out.frame, cmd.upload_uniforms(rhi::bytes_of(frame)));
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(1, which.size()));
    PELLUCID_TRY(out.records, cmd.upload_records(count, sizeof(gpu::DrawRecord)));
    std::byte* bytes = out.records.bytes.data();
    for (const std::uint32_t i : which) {
        gpu::DrawRecord record = placed_[i].record;
        place(record, view_from_world * placed_[i].world_from_object);
        std::memcpy(bytes, &record, sizeof record);
        bytes += sizeof record;
    }
    return {};
}

template <rhi::Backend B>
Result<void> GpuScene<B>::draw_shadows(typename B::Commands& cmd, const ShadowMapPass<B>& pass, const Camera& camera,
                                       const RenderSettings& settings) {
    const auto view = [&](const Camera& map, Extent2D size,
                          std::span<const std::uint32_t> which) -> Result<SceneBinding> {
        SceneBinding out = shadow_binding_;
        PELLUCID_CHECK(place_view(cmd, rigid_inverse(map.world_from_view), view_params(map, size), which, out));
        return out;
    };
    return shadows_->record(cmd, pass, camera, settings.size, view);
}

template <rhi::Backend B>
Result<void> GpuScene<B>::set_lights(std::span<const Light> lights) {
    PELLUCID_CHECK(lights_->check(lights, shadows_.has_value()));
    lights_->set(lights);
    if (shadows_) shadows_->set_lights(lights_->sources());
    return {};
}

template <rhi::Backend B>
Result<void> GpuScene<B>::begin_frame(typename B::Commands& cmd, const Camera& camera, const RenderSettings& settings) {
    const glm::dmat4 view_from_world = rigid_inverse(camera.world_from_view);
    lights_->update(cmd, camera, view_from_world);
    PELLUCID_CHECK(place_view(cmd, view_from_world, frame_params(camera, settings), all_, binding_));
    if (sorted_.empty()) return {};
    for (SortedItem& item : sorted_)
        item.view_depth = -(view_from_world * glm::dvec4(placed_[item.draw.record].center, 1)).z;
    sort_back_to_front(sorted_);
    split_sides(sorted_, translucent_, mirrored_);
    return {};
}

}  // namespace pellucid::inline v0_1
