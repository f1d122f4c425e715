// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Reading a compact G-buffer and writing a texel (shaders/bench_lighting/fetch.comp): the floor of a lighting pass.
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/shaders/bench_lighting.hpp>
#include "lighting/radiance_errors.hpp"
#include "support/gbuffer_set.hpp"
#include "support/scenes.hpp"

namespace pellucid::bench {

template <rhi::Backend B>
struct FetchFloor {
    rhi::Unique<rhi::DeviceFor<B>, rhi::Sampler> sampler;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Group> group;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline;
    rhi::Uses uses;
    Extent2D size = {};

    /// `output`: rgba16_float with storage usage, of the G-buffer's size.
    [[nodiscard]] static Result<FetchFloor> create(rhi::DeviceFor<B>& device, const GBufferTargets& gbuffer,
                                                   rhi::Texture output) {
        FetchFloor out;
        out.size = gbuffer.size;
        PELLUCID_OWN(out.sampler, device, device.make_sampler(texel_sampler("fetch floor")));
        const rhi::GroupDesc group = detail::gbuffer_group(gbuffer, false, out.sampler, output, "fetch floor");
        PELLUCID_OWN(out.group, device, device.make_group(group));
        const rhi::SpecConstant constants[] = {{0, 0}};
        PELLUCID_OWN(out.pipeline, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::bench_lighting_fetch_comp,
                                                                   .constants = constants,
                                                                   .pass_group = group.layout,
                                                                   .debug_name = "fetch floor"}));
        for (const rhi::Texture t : gbuffer.colors) out.uses.push_back(rhi::use(t, rhi::Access::sampled));
        out.uses.push_back(rhi::use(gbuffer.depth, rhi::Access::sampled));
        out.uses.push_back(rhi::use(output, rhi::Access::storage_write));
        return out;
    }
    void record(rhi::CommandsFor<B>& cmd) const {
        constexpr std::uint32_t width = PELLUCID_LIGHTING_GROUP_SIZE, height = width * PELLUCID_LIGHTING_PIXELS;
        cmd.begin_compute({.uses = uses, .name = "fetch floor"});
        cmd.bind_pipeline(pipeline);
        cmd.bind_group(group);
        cmd.dispatch((size.width + width - 1) / width, (size.height + height - 1) / height, 1);
        cmd.end_compute();
    }
};

/// What the shader must have written, at some pixels.
template <rhi::Backend B>
[[nodiscard]] RadianceErrors fetch_errors(const GBufferSet<B>& set, const ImageF& hdr, std::uint32_t samples) {
    RadianceErrors out;
    for (const auto [x, y] : sample_pixels(set.targets.size, samples)) {
        const reference::Surface<double> s = stored_pixel(set, bench_camera(), x, y).surface;
        const auto low = [&](std::size_t target) {
            return static_cast<double>(set.texels[target].template at<std::uint32_t>(x, y) & 0x7FFu);
        };
        out.add(hdr.texel(x, y), {low(0), low(2),
                                  s.base_color.r + s.base_color.g + s.base_color.b + s.occlusion +
                                      double{set.texels.back().template at<float>(x, y)}});
    }
    return out;
}

}  // namespace pellucid::bench
