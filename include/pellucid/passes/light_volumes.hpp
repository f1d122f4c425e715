// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Adds lights with a range to a lit picture, one drawn volume each: a sphere, or a cone for a narrow spot.
///
/// Two draws a light.  The first marks, in the stencil buffer, the pixels whose surface lies inside the volume: faces
/// behind a surface count, back faces +1 and front faces -1 (the "Z-fail" rule of shadow volumes: W. Bilodeau and M.
/// Songy, 1999; J. Carmack, 2000), so it holds with the eye inside the volume and where the near plane cuts it.  The
/// second draws the back faces, which cover each pixel of a convex volume once, lights what is marked and unmarks it.
/// Light is summed in single precision, in the order of the lights, and added to the picture at the end.
///
/// This is how deferred renderers began; on most GPUs lists of lights cost less (benchmarks/light_lists).
#include <pellucid/gpu/light_volumes.h>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/scene/light.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/shaders/light_volumes.hpp>
#include <glm/geometric.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace pellucid::inline v0_1 {

/// Draws the volumes of lights with a range; the file's comment says how.
template <rhi::Backend B>
class LightVolumesPass {
public:
    /// `lights`: as they are stored (renderer/gpu_lights.hpp), of which those from `first_ranged` on have a range.
    /// `picture`: rgba16_float, storage, `[h, w]` like the G-buffer.  Errors: `unsupported` on devices that cannot
    /// blend into 32-bit float targets; those of creation.
    [[nodiscard]] static Result<LightVolumesPass> create(typename B::Device& device, const LightingDesc& desc,
                                                         const GBufferTargets& gbuffer, rhi::Texture picture,
                                                         std::span<const Light> lights, std::uint32_t first_ranged);
    /// Other lights in the place of those of `create`, as many and stored alike.
    void set_lights(std::span<const Light> lights, std::uint32_t first_ranged);
    /// Records three passes.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const SceneBinding& scene) const;

    [[nodiscard]] static constexpr std::uint32_t pipelines() noexcept { return 4; }
    /// Calls `add(debug_name, bytes)` for each texture and buffer.
    template <class Add>
    void each_resource(Add&& add) const {
        const std::uint64_t pixels = std::uint64_t{size_.width} * size_.height;
        add("light_volumes.sum", 16 * pixels);
        add("light_volumes.stencil", 8 * pixels);
        add("light_volumes.mesh", mesh_bytes_);
    }

private:
    std::vector<gpu::LightVolumePush> volumes_;
    std::uint32_t sphere_corners_ = 0, cone_corners_ = 0;
    std::uint64_t mesh_bytes_ = 0;
    Extent2D size_ = {};
    rhi::Texture picture_ = {};
    rhi::Uses uses_ = {};  ///< of the G-buffer
    rhi::Unique<typename B::Device, rhi::Texture> sum_, stencil_;
    rhi::Unique<typename B::Device, rhi::Buffer> mesh_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_, add_group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> mark_, light_, add_;
    std::optional<FullScreenPass<B>> depth_;
};

// ------------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// Half angle [rad] of the widest cone that is drawn as one: beyond it the sphere is smaller.
inline constexpr double widest_cone = std::numbers::pi / 4;

/// Corners of the triangles of a sphere that encloses the unit sphere.
[[nodiscard]] inline std::vector<gpu::vec4> volume_sphere() {
    const Mesh ball = make_icosphere(1, 2);
    double inner = 1;  // radius of the sphere inside the polyhedron
    for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
        const glm::dvec3 a(ball.positions[ball.indices[i]]), b(ball.positions[ball.indices[i + 1]]),
            c(ball.positions[ball.indices[i + 2]]);
        inner = std::min(inner, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
    }
    std::vector<gpu::vec4> out;
    for (const std::uint32_t i : ball.indices) {
        const glm::dvec3 p = glm::dvec3(ball.positions[i]) * (1.0001 / inner);
        out.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0});
    }
    return out;
}

/// The same of a pyramid round a cone: tip at the origin, axis +z of length 1, radius 1 at its end.
[[nodiscard]] inline std::vector<gpu::vec4> volume_cone() {
    constexpr int sides = 16;
    std::vector<gpu::vec4> rim, out;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides, radius = 1.0001 / std::cos(std::numbers::pi / sides);
        rim.push_back(
            {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), 1, 0});
    }
    for (int i = 0; i < sides; ++i) {
        const gpu::vec4 a = rim[static_cast<std::size_t>(i)], b = rim[static_cast<std::size_t>((i + 1) % sides)];
        for (const gpu::vec4& corner : {gpu::vec4{0, 0, 0, 0}, b, a, gpu::vec4{0, 0, 1, 0}, a, b})
            out.push_back(corner);
    }
    return out;
}

}  // namespace detail

template <rhi::Backend B>
Result<LightVolumesPass<B>> LightVolumesPass<B>::create(typename B::Device& device, const LightingDesc& desc,
                                                        const GBufferTargets& gbuffer, rhi::Texture picture,
                                                        std::span<const Light> lights, std::uint32_t first_ranged) {
    if (!device.info().float32_blending)
        return Error{Errc::unsupported, "light volumes need blending into 32-bit float targets, and " +
                                            device.info().name + " has none: choose another --lighting"};
    LightVolumesPass pass;
    pass.size_ = gbuffer.size;
    pass.picture_ = picture;
    std::vector<gpu::vec4> corners = detail::volume_sphere();
    pass.sphere_corners_ = static_cast<std::uint32_t>(corners.size());
    for (const gpu::vec4& corner : detail::volume_cone()) corners.push_back(corner);
    pass.cone_corners_ = static_cast<std::uint32_t>(corners.size()) - pass.sphere_corners_;
    pass.set_lights(lights, first_ranged);
    using enum rhi::TextureUsage;
    PELLUCID_OWN(pass.sum_, device,
                 device.make_texture({.size = gbuffer.size,
                                      .format = rhi::Format::rgba32_float,
                                      .usage = attachment | sampled,
                                      .debug_name = "light_volumes.sum"}));
    PELLUCID_OWN(pass.stencil_, device,
                 device.make_texture({.size = gbuffer.size,
                                      .format = rhi::Format::d32_float_s8_uint,
                                      .usage = attachment,
                                      .debug_name = "light_volumes.stencil"}));
    const auto bytes = rhi::bytes_of(std::span<const gpu::vec4>(corners));
    pass.mesh_bytes_ = bytes.size();
    PELLUCID_OWN(pass.mesh_, device,
                 device.make_buffer({.size = bytes.size(), .initial = bytes, .debug_name = "light_volumes.mesh"}));
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("light_volumes")));

    constexpr rhi::Format stencil_format = rhi::Format::d32_float_s8_uint;
    PELLUCID_TRY(
        pass.depth_,
        FullScreenPass<B>::create(
            device, {.fragment = &shaders::light_volumes_depth_frag,
                     .textures = {{PELLUCID_GBUFFER_DEPTH, gbuffer.depth}},
                     .depth = {.format = stencil_format, .test = true, .write = true, .compare = rhi::Compare::always},
                     .debug_name = "light_volumes.depth"}));

    rhi::GroupDesc group = detail::gbuffer_group(gbuffer, desc.emissive, pass.sampler_, {}, "light_volumes");
    group.layout.bindings.push_back({PELLUCID_VOLUMES_MESH, rhi::BindingKind::storage_buffer});
    group.bindings.push_back({.binding = PELLUCID_VOLUMES_MESH, .buffer = pass.mesh_});
    PELLUCID_OWN(pass.group_, device, device.make_group(group));
    for (const rhi::Texture texture : gbuffer.colors) pass.uses_.push_back(rhi::use(texture, rhi::Access::sampled));
    pass.uses_.push_back(rhi::use(gbuffer.depth, rhi::Access::sampled));
    pass.uses_.push_back(rhi::use(pass.mesh_, rhi::Access::storage_read));

    using Op = rhi::StencilFace::Op;
    const std::uint32_t needs = desc.emissive ? desc.needs : desc.needs & ~PELLUCID_NEED_EMISSIVE;
    const rhi::SpecConstant constants[] = {{0, needs}, {1, static_cast<std::uint32_t>(desc.brdf)}};
    rhi::GraphicsPipelineDesc pipeline{.vertex = &shaders::light_volumes_volume_vert,
                                       .constants = constants,
                                       .pass_group = group.layout,
                                       .scene_group = scene_group_layout(),
                                       .push_bytes = sizeof(gpu::LightVolumePush),
                                       .colors = {{.format = rhi::Format::rgba32_float, .write_mask = 0}},
                                       .depth = {.format = stencil_format,
                                                 .test = true,
                                                 .compare = rhi::Compare::greater_equal,
                                                 .stencil_test = true,
                                                 .front = {.depth_fail = Op::decrement_wrap},
                                                 .back = {.depth_fail = Op::increment_wrap}},
                                       .cull = rhi::Cull::none,
                                       .depth_clamp = true,
                                       .debug_name = "light_volumes.mark"};
    PELLUCID_OWN(pass.mark_, device, device.make_pipeline(pipeline));
    const bool compact = desc.layout == GBufferLayout::compact;
    pipeline.fragment =
        compact ? (desc.exact ? &shaders::light_volumes_light_frag_exact : &shaders::light_volumes_light_frag)
                : (desc.exact ? &shaders::light_volumes_classic_frag_exact : &shaders::light_volumes_classic_frag);
    pipeline.colors = {
        {.format = rhi::Format::rgba32_float,
         .blend = {.enabled = true, .dst_color = rhi::BlendFactor::one, .dst_alpha = rhi::BlendFactor::one}}};
    const rhi::StencilFace marked{.compare = rhi::Compare::not_equal, .pass = Op::zero};
    pipeline.depth = {.format = stencil_format, .stencil_test = true, .front = marked, .back = marked};
    pipeline.cull = rhi::Cull::front;
    pipeline.debug_name = "light_volumes.light";
    PELLUCID_OWN(pass.light_, device, device.make_pipeline(pipeline));

    const rhi::GroupLayout add_layout{{{PELLUCID_VOLUMES_TARGET, rhi::BindingKind::storage_texture},
                                       {PELLUCID_VOLUMES_SUM, rhi::BindingKind::sampled_texture}}};
    PELLUCID_OWN(pass.add_group_, device,
                 device.make_group(
                     {.layout = add_layout,
                      .bindings = {{.binding = PELLUCID_VOLUMES_TARGET, .texture = picture},
                                   {.binding = PELLUCID_VOLUMES_SUM, .texture = pass.sum_, .sampler = pass.sampler_}},
                      .debug_name = "light_volumes.add"}));
    PELLUCID_OWN(
        pass.add_, device,
        device.make_pipeline(rhi::ComputePipelineDesc{
            .compute = &shaders::light_volumes_add_comp, .pass_group = add_layout, .debug_name = "light_volumes.add"}));
    return pass;
}

template <rhi::Backend B>
void LightVolumesPass<B>::set_lights(std::span<const Light> lights, std::uint32_t first_ranged) {
    volumes_.clear();
    for (std::uint32_t i = first_ranged; i < lights.size(); ++i) {
        const Light& l = lights[i];
        const bool cone = l.kind == LightKind::spot && l.outer_cone <= detail::widest_cone;
        volumes_.push_back({.light = i,
                            .first_corner = cone ? sphere_corners_ : 0,
                            .reach = 1.0001f * l.range,
                            .width = cone ? 1.0001f * l.range * static_cast<float>(std::tan(l.outer_cone)) : 0});
    }
}

template <rhi::Backend B>
void LightVolumesPass<B>::record(typename B::Commands& cmd, const SceneBinding& scene) const {
    depth_->record(cmd, {.depth = {.texture = stencil_, .load = rhi::Load::clear}, .size = size_});
    rhi::RenderPassDesc lit{.colors = {{.texture = sum_}},
                            .depth = {.texture = stencil_, .load = rhi::Load::load, .store = rhi::Store::discard},
                            .uses = scene.uses,
                            .size = size_,
                            .name = "light_volumes"};
    for (const rhi::ResourceUse& u : uses_) lit.uses.push_back(u);
    cmd.begin_render(lit);
    bool first = true;
    for (const gpu::LightVolumePush& volume : volumes_)
        for (const bool marks : {true, false}) {
            cmd.bind_pipeline(marks ? mark_ : light_);
            if (std::exchange(first, false)) {
                cmd.bind_frame(scene.frame, scene.records);
                cmd.bind_group(group_);
                cmd.bind_group(scene.group);
            }
            if (marks) cmd.push(rhi::bytes_of(volume));
            cmd.draw({.vertex_count = volume.first_corner == 0 ? sphere_corners_ : cone_corners_});
        }
    cmd.end_render();

    cmd.begin_compute(
        {.uses = {rhi::use(picture_, rhi::Access::storage_read_write), rhi::use(sum_, rhi::Access::sampled)},
         .name = "light_volumes.add"});
    cmd.bind_pipeline(add_);
    cmd.bind_group(add_group_);
    constexpr std::uint32_t tile = PELLUCID_LIGHTING_GROUP_SIZE;
    cmd.dispatch((size_.width + tile - 1) / tile, (size_.height + tile - 1) / tile, 1);
    cmd.end_compute();
}

}  // namespace pellucid::inline v0_1
