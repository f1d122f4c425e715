// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A scene on the GPU, laid out once so that any stage can evaluate any surface: vertices, indices, a material table
/// and texture arrays in one group; instances as records of the frame's ring.
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/sorted_forward.hpp>
#include <pellucid/renderer/gpu_environment.hpp>
#include <pellucid/renderer/gpu_lights.hpp>
#include <pellucid/renderer/gpu_shadows.hpp>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include <pellucid/rhi/unique.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

namespace pellucid::inline v0_1 {

/// Owns the GPU's copy of one Scene.  `settings` decide what is uploaded and drawn.
template <rhi::Backend B>
class GpuScene {
public:
    /// Uploads meshes, materials and textures.  Errors: `unsupported` where a buffer would exceed the device's largest
    /// storage buffer, and those of creation.
    [[nodiscard]] static Result<GpuScene> create(typename B::Device& device, const Scene& scene,
                                                 const RenderSettings& settings);

    /// Other lights in the place of the scene's, from the next frame on; renderer.hpp has the contract.
    [[nodiscard]] Result<void> set_lights(std::span<const Light> lights);

    /// Writes the frame's uniforms, instance records and (where the camera or a light moved) lights, and sorts
    /// translucents.
    /// Precondition: no pass is open.  Errors: those of the rings.
    [[nodiscard]] Result<void> begin_frame(typename B::Commands& cmd, const Camera& camera,
                                           const RenderSettings& settings);

    /// Draws the shadow maps that this frame's camera asks for.  Precondition: begin_frame, shadows(), no pass is open.
    [[nodiscard]] Result<void> draw_shadows(typename B::Commands& cmd, const ShadowMapPass<B>& pass,
                                            const Camera& camera, const RenderSettings& settings);

    /// What passes bind; valid after begin_frame, for this frame.
    [[nodiscard]] const SceneBinding& binding() const noexcept { return binding_; }
    [[nodiscard]] std::span<const DrawItem> opaque() const noexcept { return opaque_; }
    /// Back to front, back and front faces apart; in the order of the scene for methods that sort fragments.
    [[nodiscard]] std::span<const DrawItem> translucent() const noexcept { return translucent_; }
    /// The same surfaces with their primitives in exactly the reverse order; only for Transparency::peel.
    [[nodiscard]] std::span<const DrawItem> translucent_reversed() const noexcept { return reversed_; }
    [[nodiscard]] std::uint32_t opaque_culls() const noexcept { return opaque_culls_; }
    [[nodiscard]] std::uint32_t translucent_culls() const noexcept { return translucent_culls_; }
    [[nodiscard]] std::uint32_t instances() const noexcept { return static_cast<std::uint32_t>(placed_.size()); }
    [[nodiscard]] const GpuLights<B>& lights() const noexcept { return *lights_; }
    [[nodiscard]] const GpuEnvironment<B>& environment() const noexcept { return *environment_; }
    /// Null where no light has a shadow map.
    [[nodiscard]] const GpuShadows<B>* shadows() const noexcept { return shadows_ ? &*shadows_ : nullptr; }
    [[nodiscard]] std::uint64_t triangles() const noexcept { return triangles_; }
    [[nodiscard]] const std::vector<TextureReport>& resources() const noexcept { return resources_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

private:
    struct Placed {
        gpu::DrawRecord record{};  ///< all but the matrices, which depend on the camera
        glm::dmat4 world_from_object{1.0};
        glm::dvec3 center{0, 0, 0};  ///< [m] world, of the bounds
        WorldBox bounds;
        DrawItem item;
        bool translucent = false, masked = false;
    };
    template <class T>
    [[nodiscard]] Result<void> make_buffer(typename B::Device& device,
                                           rhi::Unique<typename B::Device, rhi::Buffer>& out, std::span<const T> values,
                                           rhi::BufferUsage usage, const char* debug_name);
    [[nodiscard]] Result<void> make_textures(typename B::Device& device, const Scene& scene, const TexturePlan& plan);
    void place_instances(const Scene& scene, const MeshPlacement& meshes, const RenderSettings& settings);
    [[nodiscard]] Result<void> make_group(typename B::Device& device, rhi::Texture shadow_maps, rhi::Buffer shadows,
                                          rhi::Unique<typename B::Device, rhi::Group>& out, SceneBinding& binding);
    void place_shadows();
    [[nodiscard]] gpu::FrameParams frame_params(const Camera& camera, const RenderSettings& settings) const;
    /// Uniforms and records of a view of the instances `which`, in that order.
    [[nodiscard]] Result<void> place_view(typename B::Commands& cmd, const glm::dmat4& view_from_world,
                                          const gpu::FrameParams& frame, std::span<const std::uint32_t> which,
                                          SceneBinding& out) const;

    rhi::Unique<typename B::Device, rhi::Buffer> vertices_, indices_, materials_;
    std::vector<rhi::Unique<typename B::Device, rhi::Texture>> textures_;
    std::vector<rhi::Unique<typename B::Device, rhi::Sampler>> samplers_;
    rhi::Unique<typename B::Device, rhi::Sampler> shadow_sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_, shadow_group_;
    std::vector<Placed> placed_;
    std::vector<std::uint32_t> all_;  ///< indices of placed_
    std::vector<DrawItem> opaque_, translucent_, reversed_;
    std::vector<SortedItem> sorted_;
    std::vector<std::uint8_t> mirrored_;
    std::optional<GpuLights<B>> lights_;
    std::optional<GpuEnvironment<B>> environment_;
    std::optional<GpuShadows<B>> shadows_;
    std::uint32_t opaque_culls_ = 0, translucent_culls_ = 0;
    std::uint64_t triangles_ = 0;
    SceneBinding binding_, shadow_binding_;  ///< of views that draw shadow maps, without those
    std::vector<TextureReport> resources_;
    std::vector<std::string> warnings_;
};

}  // namespace pellucid::inline v0_1

#include <pellucid/renderer/gpu_scene-inl.hpp>
#include <pellucid/renderer/gpu_scene_frame-inl.hpp>
