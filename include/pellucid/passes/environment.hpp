// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// An equirectangular picture as a prefiltered cube map, made once on the device: what image-based light looks up
/// (gpu/environment.h has its levels).  Conventions, formulae and errors: reference/environment.hpp,
/// reference/cube_map.hpp, reference/importance_sampling.hpp.
#include <pellucid/core/image.hpp>
#include <pellucid/gpu/environment.h>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/environment.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1 {

/// Side of a cube map [texel]: the power of two that keeps a picture's detail, or `asked`, cut to 8 … 512 (128 on
/// processors, where making it takes a second then).
[[nodiscard]] inline std::uint32_t environment_size(const ImageF& picture, std::uint32_t asked,
                                                    const rhi::DeviceInfo& device) {
    const std::uint32_t most = device.software ? 128u : 512u;
    const std::uint32_t wanted = asked ? asked : std::min(most, picture.height / 2);
    return std::clamp(std::bit_floor(std::max(1u, wanted)), std::uint32_t{PELLUCID_ENVIRONMENT_LEAST}, 512u);
}

/// Level l of `levels` is prefiltered by roughness (l/(levels - 1))².
[[nodiscard]] constexpr double environment_roughness(std::uint32_t level, std::uint32_t levels) {
    const double t = levels > 1 ? static_cast<double>(level) / (levels - 1) : 0.0;
    return t * t;
}

/// Projects a picture onto a cube map and prefilters its levels, once.
template <rhi::Backend B>
class EnvironmentPass {
public:
    /// `picture`: `[h, 2h, 3]` linear radiance, checked by `check_environment`; `size`: side of the cube, a power of
    /// two from 8 on.  Errors: those of creation.
    [[nodiscard]] static Result<EnvironmentPass> create(typename B::Device& device, const ImageF& picture,
                                                        std::uint32_t size);
    /// Records the passes that make the cube.  Precondition: no pass is open.
    void record(typename B::Commands& cmd) const;

    /// rgba16_float, levels() levels.
    [[nodiscard]] rhi::Texture cube() const noexcept { return cube_; }
    [[nodiscard]] std::uint32_t levels() const noexcept { return static_cast<std::uint32_t>(lobes_.size()); }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }  ///< of the cube
    /// Keeps the cube and lets go of all else; the device must be done with `record`.
    [[nodiscard]] rhi::Unique<typename B::Device, rhi::Texture> take_cube() && { return std::move(cube_); }

private:
    struct Lobe {
        gpu::EnvironmentPush push{};
        bool narrow = false;
        rhi::Unique<typename B::Device, rhi::Group> group;
    };
    [[nodiscard]] Result<void> make_textures(typename B::Device& device, const ImageF& picture, std::uint32_t size);
    [[nodiscard]] Result<void> make_lobes(typename B::Device& device, std::uint32_t size);

    rhi::Unique<typename B::Device, rhi::Texture> picture_, source_, cube_;
    rhi::Unique<typename B::Device, rhi::Sampler> texels_, smooth_;
    rhi::Unique<typename B::Device, rhi::Group> project_group_;
    std::vector<rhi::Unique<typename B::Device, rhi::Group>> halve_groups_;
    std::vector<Lobe> lobes_;
    rhi::Unique<typename B::Device, rhi::Pipeline> project_, halve_, sums_, samples_;
    std::uint32_t size_ = 0;
    std::uint64_t bytes_ = 0;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<void> EnvironmentPass<B>::make_textures(typename B::Device& device, const ImageF& picture, std::uint32_t size) {
    using enum rhi::TextureUsage;
    std::vector<float> texels;
    texels.reserve(std::size_t{4} * picture.width * picture.height);
    for (std::size_t i = 0; i < picture.data.size(); i += picture.channels)
        texels.insert(texels.end(), {picture.data[i], picture.data[i + 1], picture.data[i + 2], 1.0f});
    PELLUCID_OWN(picture_, device,
                 device.make_texture({.size = {picture.width, picture.height},
                                      .format = rhi::Format::rgba32_float,
                                      .initial = rhi::bytes_of(std::span<const float>(texels)),
                                      .debug_name = "environment.picture"}));
    PELLUCID_OWN(source_, device,
                 device.make_texture({.size = {size, size},
                                      .layers = 6,
                                      .mips = static_cast<std::uint32_t>(std::bit_width(size)),
                                      .format = rhi::Format::rgba32_float,
                                      .kind = rhi::TextureKind::cube,
                                      .usage = sampled | storage,
                                      .debug_name = "environment.source"}));
    const rhi::TextureDesc cube{.size = {size, size},
                                .layers = 6,
                                .mips = static_cast<std::uint32_t>(std::bit_width(size / PELLUCID_ENVIRONMENT_LEAST)),
                                .format = rhi::Format::rgba16_float,
                                .kind = rhi::TextureKind::cube,
                                .usage = sampled | storage | copy_source,
                                .debug_name = "scene.environment"};
    bytes_ = rhi::texture_bytes(cube);
    lobes_.resize(cube.mips);
    PELLUCID_OWN(cube_, device, device.make_texture(cube));
    PELLUCID_OWN(texels_, device,
                 device.make_sampler({.min = rhi::Filter::nearest,
                                      .mag = rhi::Filter::nearest,
                                      .mipmapped = false,
                                      .debug_name = "environment.picture"}));
    PELLUCID_OWN(smooth_, device,
                 device.make_sampler(
                     {.wrap_u = rhi::Wrap::clamp, .wrap_v = rhi::Wrap::clamp, .debug_name = "environment.source"}));
    return {};
}

template <rhi::Backend B>
Result<void> EnvironmentPass<B>::make_lobes(typename B::Device& device, std::uint32_t size) {
    using enum rhi::BindingKind;
    const rhi::GroupLayout layout{
        {{PELLUCID_ENVIRONMENT_TARGET, storage_texture}, {PELLUCID_ENVIRONMENT_SOURCE, sampled_texture}}};
    for (std::uint32_t level = 0; level < levels(); ++level) {
        Lobe& lobe = lobes_[level];
        const double roughness = environment_roughness(level, levels()), alpha = roughness * roughness;
        lobe.narrow = roughness <= PELLUCID_ENVIRONMENT_NARROW;
        // The smallest level whose sum is exact enough: reference/cube_map.hpp, prefilter_level.
        std::uint32_t from = 0;
        while (!lobe.narrow && (size >> (from + 1)) >= std::max(64.0, 16 / std::sqrt(alpha))) ++from;
        lobe.push = {.size = size >> level,
                     .alpha = static_cast<float>(alpha),
                     .level = static_cast<float>(lobe.narrow ? level : from),
                     .side = size >> from};
        PELLUCID_OWN(
            lobe.group, device,
            device.make_group(
                {.layout = layout,
                 .bindings = {{.binding = PELLUCID_ENVIRONMENT_TARGET, .texture = cube_, .mip = level},
                              {.binding = PELLUCID_ENVIRONMENT_SOURCE, .texture = source_, .sampler = smooth_}},
                 .debug_name = "environment.lobe"}));
    }
    const auto pipeline = [&](const rhi::Shader& shader) {
        return device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shader,
                                                             .pass_group = layout,
                                                             .push_bytes = sizeof(gpu::EnvironmentPush),
                                                             .debug_name = "environment.lobe"});
    };
    PELLUCID_OWN(sums_, device, pipeline(shaders::environment_sums_comp));
    PELLUCID_OWN(samples_, device, pipeline(shaders::environment_samples_comp));
    return {};
}

template <rhi::Backend B>
Result<EnvironmentPass<B>> EnvironmentPass<B>::create(typename B::Device& device, const ImageF& picture,
                                                      std::uint32_t size) {
    using enum rhi::BindingKind;
    EnvironmentPass pass;
    pass.size_ = size;
    PELLUCID_CHECK(pass.make_textures(device, picture, size));
    const rhi::GroupLayout project{
        {{PELLUCID_ENVIRONMENT_TARGET, storage_texture}, {PELLUCID_ENVIRONMENT_PICTURE, sampled_texture}}};
    PELLUCID_OWN(
        pass.project_group_, device,
        device.make_group(
            {.layout = project,
             .bindings = {{.binding = PELLUCID_ENVIRONMENT_TARGET, .texture = pass.source_},
                          {.binding = PELLUCID_ENVIRONMENT_PICTURE, .texture = pass.picture_, .sampler = pass.texels_}},
             .debug_name = "environment.cube"}));
    PELLUCID_OWN(
        pass.project_, device,
        device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shaders::environment_cube_comp, .pass_group = project, .debug_name = "environment.cube"}));
    const rhi::GroupLayout halve{
        {{PELLUCID_ENVIRONMENT_TARGET, storage_texture}, {PELLUCID_ENVIRONMENT_ABOVE, storage_texture}}};
    for (std::uint32_t level = 1; (size >> level) != 0; ++level) {
        rhi::Unique<typename B::Device, rhi::Group> group;
        PELLUCID_OWN(
            group, device,
            device.make_group(
                {.layout = halve,
                 .bindings = {{.binding = PELLUCID_ENVIRONMENT_TARGET, .texture = pass.source_, .mip = level},
                              {.binding = PELLUCID_ENVIRONMENT_ABOVE, .texture = pass.source_, .mip = level - 1}},
                 .debug_name = "environment.halve"}));
        pass.halve_groups_.push_back(std::move(group));
    }
    PELLUCID_OWN(
        pass.halve_, device,
        device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shaders::environment_halve_comp, .pass_group = halve, .debug_name = "environment.halve"}));
    PELLUCID_CHECK(pass.make_lobes(device, size));
    return pass;
}

template <rhi::Backend B>
void EnvironmentPass<B>::record(typename B::Commands& cmd) const {
    using enum rhi::Access;
    const auto dispatch = [&](std::uint32_t side) {
        const std::uint32_t groups = (side + PELLUCID_ENVIRONMENT_THREADS - 1) / PELLUCID_ENVIRONMENT_THREADS;
        cmd.dispatch(groups, groups, 6);
    };
    cmd.begin_compute(
        {.uses = {rhi::use(picture_, sampled), rhi::use(source_, storage_write)}, .name = "environment.cube"});
    cmd.bind_pipeline(project_);
    cmd.bind_group(project_group_);
    dispatch(size_);
    cmd.end_compute();
    for (std::size_t level = 0; level < halve_groups_.size(); ++level) {
        cmd.begin_compute({.uses = {rhi::use(source_, storage_read_write)}, .name = "environment.halve"});
        cmd.bind_pipeline(halve_);
        cmd.bind_group(halve_groups_[level]);
        dispatch(size_ >> (level + 1));
        cmd.end_compute();
    }
    cmd.begin_compute(
        {.uses = {rhi::use(source_, sampled), rhi::use(cube_, storage_write)}, .name = "environment.lobes"});
    for (const Lobe& lobe : lobes_) {
        cmd.bind_pipeline(lobe.narrow ? samples_ : sums_);
        cmd.bind_group(lobe.group);
        cmd.push(rhi::bytes_of(lobe.push));
        dispatch(lobe.push.size);
    }
    cmd.end_compute();
}

}  // namespace pellucid::inline v0_1
