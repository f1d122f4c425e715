// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What image-based light and the conserving model look up, made once: the table of directional albedo, the prefiltered
/// environment, the sky's table; each only where a scene needs it, one texel else.
#include <pellucid/passes/dfg.hpp>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/passes/environment.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/renderer/needs.hpp>
#include <optional>

namespace pellucid::inline v0_1 {

/// An environment's light on a device: the sky's table or a prefiltered cube map, and the table of albedos.
template <rhi::Backend B>
class GpuEnvironment {
public:
    /// Makes the tables on the device and waits.  Errors: those of creation; device loss.
    [[nodiscard]] static Result<GpuEnvironment> create(typename B::Device& device, const RenderSettings& settings,
                                                       const SceneNeeds& needs);
    /// Adds the three textures to the scene's group.
    void bind(rhi::GroupDesc& group, rhi::Uses& uses) const;
    [[nodiscard]] float last_level() const noexcept { return last_level_; }
    [[nodiscard]] std::uint32_t pipelines() const noexcept { return pipelines_; }  ///< that were built, and are gone
    template <class Add>
    void each_resource(Add&& add) const {
        for (const auto& [debug_name, bytes] : resources_) add(debug_name, bytes);
    }

private:
    [[nodiscard]] Result<void> stand_in(typename B::Device& device, rhi::Unique<typename B::Device, rhi::Texture>& out,
                                        rhi::TextureKind kind);

    rhi::Unique<typename B::Device, rhi::Texture> dfg_, cube_, sky_;
    rhi::Unique<typename B::Device, rhi::Sampler> smooth_, texels_;
    float last_level_ = 0;
    std::uint32_t pipelines_ = 0;
    std::vector<std::pair<const char*, std::uint64_t>> resources_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<void> GpuEnvironment<B>::stand_in(typename B::Device& device, rhi::Unique<typename B::Device, rhi::Texture>& out,
                                         rhi::TextureKind kind) {
    const std::uint32_t black[6] = {};
    const rhi::TextureDesc desc{.size = {1, 1},
                                .layers = kind == rhi::TextureKind::cube ? 6u : 1u,
                                .kind = kind,
                                .initial = rhi::bytes_of(black).first(kind == rhi::TextureKind::cube ? 24 : 4),
                                .debug_name = "scene.no_texture"};
    PELLUCID_OWN(out, device, device.make_texture(desc));
    resources_.push_back({desc.debug_name, rhi::texture_bytes(desc)});
    return {};
}

template <rhi::Backend B>
Result<GpuEnvironment<B>> GpuEnvironment<B>::create(typename B::Device& device, const RenderSettings& settings,
                                                    const SceneNeeds& needs) {
    GpuEnvironment out;
    PELLUCID_OWN(out.smooth_, device,
                 device.make_sampler(
                     {.wrap_u = rhi::Wrap::clamp, .wrap_v = rhi::Wrap::clamp, .debug_name = "scene.environment"}));
    PELLUCID_OWN(out.texels_, device, device.make_sampler(texel_sampler("scene.sky")));
    std::optional<DfgPass<B>> dfg;
    std::optional<EnvironmentPass<B>> environment;
    if (needs.albedo_table) {
        PELLUCID_OWN(out.dfg_, device, device.make_texture(DfgPass<B>::table_desc()));
        PELLUCID_TRY(dfg, DfgPass<B>::create(device, out.dfg_));
        out.resources_.push_back({"scene.dfg", rhi::texture_bytes(DfgPass<B>::table_desc())});
        ++out.pipelines_;
    } else {
        PELLUCID_CHECK(out.stand_in(device, out.dfg_, rhi::TextureKind::flat));
    }
    if (needs.has(PELLUCID_NEED_ENVIRONMENT)) {
        const ImageF& picture = *settings.environment.picture;
        PELLUCID_TRY(environment,
                     EnvironmentPass<B>::create(device, picture,
                                                environment_size(picture, settings.environment.size, device.info())));
        out.last_level_ = static_cast<float>(environment->levels() - 1);
        out.resources_.push_back({"scene.environment", environment->bytes()});
        out.pipelines_ += 4;
    } else {
        PELLUCID_CHECK(out.stand_in(device, out.cube_, rhi::TextureKind::cube));
    }
    if (needs.has(PELLUCID_NEED_SKY)) {
        const ImageF table = make_sky_table(settings.environment.sky);
        std::vector<float> texels;
        for (std::size_t i = 0; i < table.data.size(); i += 3)
            texels.insert(texels.end(), {table.data[i], table.data[i + 1], table.data[i + 2], 1.0f});
        PELLUCID_OWN(out.sky_, device,
                     device.make_texture({.size = {table.width, table.height},
                                          .format = rhi::Format::rgba32_float,
                                          .initial = rhi::bytes_of(std::span<const float>(texels)),
                                          .debug_name = "scene.sky"}));
        out.resources_.push_back({"scene.sky", texels.size() * sizeof(float)});
    } else {
        PELLUCID_CHECK(out.stand_in(device, out.sky_, rhi::TextureKind::flat));
    }
    if (dfg || environment) {
        typename B::Commands* cmd = nullptr;
        PELLUCID_TRY(cmd, device.begin_frame());
        if (dfg) dfg->record(*cmd);
        if (environment) environment->record(*cmd);
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, device.submit());
        PELLUCID_CHECK(device.wait(ticket));
    }
    if (environment) out.cube_ = std::move(*environment).take_cube();
    return out;
}

template <rhi::Backend B>
void GpuEnvironment<B>::bind(rhi::GroupDesc& group, rhi::Uses& uses) const {
    const auto add = [&](std::uint32_t binding, rhi::Texture texture, rhi::Sampler sampler) {
        group.bindings.push_back({.binding = binding, .texture = texture, .sampler = sampler});
        uses.push_back(rhi::use(texture, rhi::Access::sampled));
    };
    add(PELLUCID_BIND_DFG, dfg_, smooth_);
    add(PELLUCID_BIND_ENVIRONMENT, cube_, smooth_);
    add(PELLUCID_BIND_SKY, sky_, texels_);
}

}  // namespace pellucid::inline v0_1
