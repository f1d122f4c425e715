// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The baseline of transparency: the same layers as constant colours, blended in order by the fixed function, with the
/// depth test of the pass that is measured.
#include <cmath>
#include <cstring>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/scene/scene.hpp>
#include <pellucid/shaders/bench_blend.hpp>
#include <vector>
#include "support/scenes.hpp"

namespace pellucid::bench {

template <rhi::Backend B>
class PlainBlend {
public:
    /// `layers`: full-screen rectangles across the view (`make_view_quad`), one an instance, in any order.
    /// `hdr` (rgba16_float) and `depth` (read only) are `[h, w]` of `size`.
    [[nodiscard]] static Result<PlainBlend> create(rhi::DeviceFor<B>& device, const Scene& layers, rhi::Texture hdr,
                                                   rhi::Texture depth, Extent2D size) {
        PlainBlend out;
        out.hdr_ = hdr;
        out.depth_ = depth;
        out.size_ = size;
        PELLUCID_OWN(
            out.pipeline_, device,
            device.make_pipeline(rhi::GraphicsPipelineDesc{
                .vertex = &shaders::bench_blend_layer_vert,
                .fragment = &shaders::bench_blend_layer_frag,
                .colors = {{.format = rhi::Format::rgba16_float, .blend = rhi::blend_premultiplied}},
                .depth = {.format = rhi::Format::d32_float, .test = true, .compare = rhi::Compare::greater_equal},
                .debug_name = "plain blending"}));
        for (const Instance& instance : layers.instances) {
            const Mesh& mesh = layers.meshes[instance.mesh];
            const glm::vec4 c = layers.materials[mesh.material].base_color;
            const double distance = -mesh.positions[0].z;
            const auto depth_value = static_cast<float>(bench_camera().near / distance);
            out.layers_.push_back({{c.x * c.w, c.y * c.w, c.z * c.w, c.w}, {1.2f, 1.2f, depth_value, 0}});
        }
        // Farthest first: the smallest reversed depth.
        std::stable_sort(out.layers_.begin(), out.layers_.end(),
                         [](const Layer& a, const Layer& b) { return a.place[2] < b.place[2]; });
        return out;
    }
    /// Uploads the layers' records.  Precondition: no pass is open.
    [[nodiscard]] Result<void> begin_frame(rhi::CommandsFor<B>& cmd) {
        PELLUCID_TRY(records_, cmd.upload_records(static_cast<std::uint32_t>(layers_.size()), sizeof(Layer)));
        std::memcpy(records_.bytes.data(), layers_.data(), layers_.size() * sizeof(Layer));
        PELLUCID_TRY(frame_, cmd.upload_uniforms(rhi::bytes_of(Layer{})));  // not read, but a frame has one
        return {};
    }
    void record(rhi::CommandsFor<B>& cmd) const {
        cmd.begin_render({.colors = {{.texture = hdr_, .load = rhi::Load::load}},
                          .depth = {.texture = depth_, .load = rhi::Load::load, .read_only = true},
                          .size = size_,
                          .name = "plain blending"});
        cmd.bind_pipeline(pipeline_);
        cmd.bind_frame(frame_, records_);
        for (std::uint32_t i = 0; i < layers_.size(); ++i)
            cmd.draw({.vertex_count = 6, .first_instance = records_.first + i});
        cmd.end_render();
    }

private:
    /// As in shaders/bench_blend/layer.vert.
    struct Layer {
        float color[4] = {};  ///< premultiplied
        float place[4] = {};  ///< half extent in normalised device coordinates, depth, unused
    };

    rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline_;
    rhi::Texture hdr_ = {}, depth_ = {};
    Extent2D size_ = {};
    std::vector<Layer> layers_;
    rhi::RecordSlice records_ = {};
    rhi::UniformSlice frame_ = {};
};

}  // namespace pellucid::bench
