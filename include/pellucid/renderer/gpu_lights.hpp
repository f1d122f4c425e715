// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The lights of a scene on the GPU: records, bounds, and room for the lists of which light reaches what.
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/renderer/light_changes.hpp>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pellucid::inline v0_1 {

/// Owns what lights take.  Records and bounds are in view space: they are written again where the camera or a light
/// moved.
template <rhi::Backend B>
class GpuLights {
public:
    /// Errors: `unsupported` where the lists would exceed the device's largest storage buffer; those of creation.
    [[nodiscard]] static Result<GpuLights> create(typename B::Device& device, const Scene& scene,
                                                  const RenderSettings& settings, const SceneNeeds& needs);
    /// That `lights` can take the place of the scene's.  Errors: `invalid_argument`.
    [[nodiscard]] Result<void> check(std::span<const Light> lights, bool maps) const;
    /// Puts them there, from the next update on.  Precondition: check.
    void set(std::span<const Light> lights);
    /// Precondition: no pass is open.
    void update(typename B::Commands& cmd, const Camera& camera, const glm::dmat4& view_from_world);
    /// Fills in what shaders want to know about lights.
    void describe(gpu::FrameParams& frame) const;

    [[nodiscard]] std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(sources_.size()); }
    /// As they are stored: directional ones, then those that reach everywhere, then those with a range.
    [[nodiscard]] const std::vector<Light>& sources() const noexcept { return sources_; }
    /// Index of the first light with a range.
    [[nodiscard]] std::uint32_t first_ranged() const noexcept { return ends_.y; }
    [[nodiscard]] rhi::Buffer records() const noexcept { return records_; }
    [[nodiscard]] rhi::Buffer block() const noexcept { return block_; }
    [[nodiscard]] rhi::Buffer bounds() const noexcept { return bounds_; }
    [[nodiscard]] rhi::Buffer lists() const noexcept { return lists_; }
    [[nodiscard]] const LightGrid& grid() const noexcept { return grid_; }
    /// Calls `add(debug_name, bytes)` for each buffer.
    template <class Add>
    void each_resource(Add&& add) const {
        add("scene.lights", record_data_.size() * sizeof(gpu::LightRecord));
        add(looped_ ? "scene.light_block" : "scene.no_light_block", block_bytes);
        if (!grid_.empty()) {
            add("scene.light_bounds", bound_data_.size() * sizeof(gpu::vec4));
            add("scene.light_lists", list_bytes());
        } else {
            add("scene.no_lists", list_bytes());
        }
    }

private:
    static constexpr std::uint64_t block_bytes = sizeof(gpu::LightRecord) * PELLUCID_LIGHT_BLOCK;
    /// There is always something to bind.
    [[nodiscard]] std::uint64_t list_bytes() const noexcept { return std::max<std::uint64_t>(16, grid_.bytes()); }

    std::vector<Light> sources_;
    std::vector<std::uint32_t> stored_;  ///< where each light of the scene is in sources_
    std::vector<gpu::LightRecord> record_data_;
    std::vector<gpu::vec4> bound_data_;  ///< of lights with a place
    rhi::Unique<typename B::Device, rhi::Buffer> records_, block_, bounds_, lists_;
    LightGrid grid_;
    gpu::uvec4 ends_;
    gpu::vec4 slices_{1, 0, 0, 0};
    glm::dmat4 written_for_{1.0};
    bool written_ = false;
    bool ambient_ = false;
    bool looped_ = false;  ///< the block is read
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<GpuLights<B>> GpuLights<B>::create(typename B::Device& device, const Scene& scene,
                                          const RenderSettings& settings, const SceneNeeds& needs) {
    GpuLights out;
    const auto kind = [](const Light& l) { return l.kind == LightKind::directional ? 0 : reaches_an_end(l) ? 2 : 1; };
    out.stored_.resize(scene.lights.size());
    std::uint32_t ends[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            if (kind(scene.lights[i]) != k) continue;
            out.stored_[i] = static_cast<std::uint32_t>(out.sources_.size());
            out.sources_.push_back(scene.lights[i]);
        }
        if (k == 0 && gets_default_sun(scene, settings)) {
            out.sources_.push_back(default_sun());
            out.ambient_ = settings.environment.kind == EnvironmentKind::none;
        }
        ends[k] = out.size();
    }
    out.grid_ = needs.grid;
    out.looped_ = needs.has(PELLUCID_NEED_LIGHT_BLOCK);
    out.ends_ = {ends[0], ends[1], ends[2], static_cast<gpu::uint>(needs.grid.slice_words())};
    out.record_data_.resize(std::max<std::size_t>(1, out.sources_.size()));
    out.bound_data_.resize(std::max(1u, out.ends_.z - out.ends_.x));
    const std::uint64_t bytes = out.list_bytes();
    if (const std::uint64_t limit = device.info().max_storage_buffer_bytes; bytes > limit)
        return Error{Errc::unsupported, std::string(name(needs.assignment)) + " lists of " +
                                            std::to_string(needs.placed) + " lights take " + std::to_string(bytes) +
                                            " bytes; the largest storage buffer of " + device.info().name + " is " +
                                            std::to_string(limit) +
                                            " bytes: draw a smaller picture, or ask for --lighting loop"};
    const auto make = [&](std::uint64_t size, const char* debug_name) {
        using enum rhi::BufferUsage;
        return device.make_buffer(
            {.size = size, .usage = storage | copy_destination | copy_source, .debug_name = debug_name});
    };
    PELLUCID_OWN(out.records_, device, make(out.record_data_.size() * sizeof(gpu::LightRecord), "scene.lights"));
    PELLUCID_OWN(out.block_, device,
                 device.make_buffer({.size = block_bytes,
                                     .usage = rhi::BufferUsage::uniform | rhi::BufferUsage::copy_destination,
                                     .debug_name = "scene.light_block"}));
    PELLUCID_OWN(out.lists_, device, make(bytes, "scene.light_lists"));
    if (!out.grid_.empty()) {
        PELLUCID_OWN(out.bounds_, device, make(out.bound_data_.size() * sizeof(gpu::vec4), "scene.light_bounds"));
    }
    return out;
}

template <rhi::Backend B>
Result<void> GpuLights<B>::check(std::span<const Light> lights, bool maps) const {
    if (lights.size() != stored_.size())
        return Error{Errc::invalid_argument, std::to_string(lights.size()) + " lights cannot take the place of " +
                                                 std::to_string(stored_.size()) +
                                                 ": keep their number, or create a renderer for these lights"};
    PELLUCID_CHECK(check_lights(lights));
    for (std::size_t i = 0; i < lights.size(); ++i)
        PELLUCID_CHECK(check_light_change(sources_[stored_[i]], lights[i], i, maps));
    return {};
}

template <rhi::Backend B>
void GpuLights<B>::set(std::span<const Light> lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) sources_[stored_[i]] = lights[i];
    written_ = false;
}

template <rhi::Backend B>
void GpuLights<B>::update(typename B::Commands& cmd, const Camera& camera, const glm::dmat4& view_from_world) {
    if (sources_.empty() || (written_ && camera.world_from_view == written_for_)) return;
    const auto write = [&](rhi::Buffer buffer, std::span<const std::byte> bytes) {
        constexpr std::size_t step = 65536 / 48 * 48;  // whole records
        for (std::size_t at = 0; at < bytes.size(); at += step)
            cmd.update(buffer, at, bytes.subspan(at, std::min(step, bytes.size() - at)));
    };
    for (std::size_t i = 0; i < sources_.size(); ++i) record_data_[i] = gpu_light(sources_[i], view_from_world);
    rhi::CopyPassDesc copy{.uses = {rhi::use(records_, rhi::Access::copy_write)}, .name = "lights"};
    if (looped_) copy.uses.push_back(rhi::use(block_, rhi::Access::copy_write));
    if (!grid_.empty()) copy.uses.push_back(rhi::use(bounds_, rhi::Access::copy_write));
    cmd.begin_copy(copy);
    write(records_, rhi::bytes_of(std::span<const gpu::LightRecord>(record_data_)));
    if (looped_) write(block_, rhi::bytes_of(std::span<const gpu::LightRecord>(record_data_)));
    if (!grid_.empty()) {
        double nearest = 1e30, farthest = 0;  // distances along the view that any light with a range reaches
        for (std::size_t i = ends_.x; i < sources_.size(); ++i) {
            const gpu::vec4 b = bound_data_[i - ends_.x] = gpu_light_bounds(sources_[i], view_from_world);
            if (i < ends_.y) continue;
            nearest = std::min<double>(nearest, -b.z - b.w);
            farthest = std::max<double>(farthest, -b.z + b.w);
        }
        // Slices begin where lights begin, but not so near that most of them are spent where nothing is seen.
        nearest = std::max({nearest, camera.near, farthest * 1e-4, 1e-6});
        const double octaves = std::log2(std::max(farthest / nearest, 2.0));
        const double scale = std::max(1u, grid_.slices) / octaves;
        slices_ = {static_cast<float>(scale), static_cast<float>(-std::log2(nearest) * scale),
                   static_cast<float>(std::max(1u, grid_.slices) - 1), 0};
        write(bounds_, rhi::bytes_of(std::span<const gpu::vec4>(bound_data_)));
    }
    cmd.end_copy();
    written_for_ = camera.world_from_view;
    written_ = true;
}

template <rhi::Backend B>
void GpuLights<B>::describe(gpu::FrameParams& frame) const {
    if (ambient_) frame.ambient = {default_ambient, default_ambient, default_ambient};
    frame.light_ends = ends_;
    frame.light_grid = {grid_.tiles.width, grid_.lists, grid_.words, grid_.summaries};
    frame.light_slices = slices_;
}

}  // namespace pellucid::inline v0_1
