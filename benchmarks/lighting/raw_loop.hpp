// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The raw GGX loop of shaders/bench_lighting: the arithmetic of the lighting pass and nothing else.
#include <bench_lighting/parameters.h>
#include <memory>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/shaders/bench_lighting.hpp>
#include "lighting/radiance_errors.hpp"
#include "support/scenes.hpp"

namespace pellucid::bench {

/// The surface that both the raw loop and the G-buffer of the benchmark show.
inline constexpr struct {
    double distance = 2;       ///< [m]
    double lean = 0.25;        ///< at the edges of the picture
    glm::dvec3 base{1, 0, 1};  // codes that every driver's sRGB decoding gives exactly: the arithmetic is judged alone
    double metallic = 0.2;     // 51/255
    double roughness = 0.4;
} raw_surface;

/// How the loop is written, and where its lights come from.
struct RawForm {
    const char* name = "raw loop";
    std::uint32_t form = BENCH_LIGHTING_PLAIN;
    std::uint32_t storage = 0;  ///< 1: lights come from a storage buffer, not from a uniform block
};
inline constexpr RawForm raw_forms[] = {
    {}, {"raw loop, lights in storage", BENCH_LIGHTING_PLAIN, 1}, {"raw loop, factored", BENCH_LIGHTING_FACTORED, 0}};

template <rhi::Backend B>
struct RawLoop {
    rhi::Unique<rhi::DeviceFor<B>, rhi::Buffer> parameters, stored;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Group> group;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline;
    rhi::Texture output = {};
    Extent2D size = {};

    /// `lights`: up to 256 point lights in view space.  `output`: rgba16_float with storage usage.
    [[nodiscard]] static Result<RawLoop> create(rhi::DeviceFor<B>& device, Extent2D size, const RawForm& form,
                                                const std::vector<Light>& lights, rhi::Texture output) {
        RawLoop out;
        out.output = output;
        out.size = size;
        const auto values = std::make_unique<gpu::RawParameters>();
        const double half = raw_surface.distance * std::tan(0.5 * bench_camera().vertical_fov);
        values->base = to_gpu(raw_surface.base);
        values->metallic = static_cast<float>(raw_surface.metallic);
        values->half_extent = {static_cast<float>(half * size.width / size.height), static_cast<float>(half)};
        values->distance = static_cast<float>(raw_surface.distance);
        values->roughness = static_cast<float>(raw_surface.roughness);
        values->lean = static_cast<float>(raw_surface.lean);
        values->count = static_cast<std::uint32_t>(lights.size());
        values->pixel = {1.0f / static_cast<float>(size.width), 1.0f / static_cast<float>(size.height)};
        for (std::size_t i = 0; i < lights.size(); ++i)
            values->lights[i] = {.position = to_gpu(lights[i].position),
                                 .intensity = to_gpu(lights[i].color * lights[i].intensity)};
        PELLUCID_OWN(out.parameters, device,
                     device.make_buffer({.size = sizeof(gpu::RawParameters),
                                         .usage = rhi::BufferUsage::uniform,
                                         .initial = rhi::bytes_of(*values),
                                         .debug_name = "raw loop.parameters"}));
        PELLUCID_OWN(out.stored, device,
                     device.make_buffer({.size = sizeof values->lights,
                                         .usage = rhi::BufferUsage::storage,
                                         .initial = rhi::bytes_of(values->lights),
                                         .debug_name = "raw loop.lights"}));
        const rhi::GroupLayout layout{{{BENCH_LIGHTING_OUTPUT, rhi::BindingKind::storage_texture},
                                       {BENCH_LIGHTING_PARAMETERS, rhi::BindingKind::uniform_buffer},
                                       {BENCH_LIGHTING_LIGHTS, rhi::BindingKind::storage_buffer}}};
        const rhi::SpecConstant constants[] = {{0, form.form}, {1, form.storage}};
        PELLUCID_OWN(out.group, device,
                     device.make_group({.layout = layout,
                                        .bindings = {{.binding = BENCH_LIGHTING_OUTPUT, .texture = output},
                                                     {.binding = BENCH_LIGHTING_PARAMETERS, .buffer = out.parameters},
                                                     {.binding = BENCH_LIGHTING_LIGHTS, .buffer = out.stored}},
                                        .debug_name = "raw loop"}));
        PELLUCID_OWN(out.pipeline, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::bench_lighting_raw_ggx_comp,
                                                                   .constants = constants,
                                                                   .pass_group = layout,
                                                                   .debug_name = "raw loop"}));
        return out;
    }
    void record(rhi::CommandsFor<B>& cmd) const {
        cmd.begin_compute(
            {.uses = {rhi::use(parameters.get(), rhi::Access::uniform_read),
                      rhi::use(stored.get(), rhi::Access::storage_read), rhi::use(output, rhi::Access::storage_write)},
             .name = "raw loop"});
        cmd.bind_pipeline(pipeline);
        cmd.bind_group(group);
        cmd.dispatch((size.width + 15) / 16, (size.height + 7) / 8, 1);
        cmd.end_compute();
    }
};

/// Errors of the raw loop's picture against the same surface and lights in double.
[[nodiscard]] inline RadianceErrors raw_errors(const ImageF& hdr, const std::vector<Light>& lights,
                                               std::uint32_t samples) {
    RadianceErrors out;
    const Extent2D size{hdr.width, hdr.height};
    const double half = raw_surface.distance * std::tan(0.5 * bench_camera().vertical_fov);
    for (const auto [x, y] : sample_pixels(size, samples)) {
        const glm::dvec2 ndc((2.0 * x + 1) / size.width - 1, 1 - (2.0 * y + 1) / size.height);
        const glm::dvec3 position(ndc.x * half * size.width / size.height, ndc.y * half, -raw_surface.distance);
        const reference::Surface<double> surface{.normal = glm::normalize(glm::dvec3(ndc * raw_surface.lean, 1)),
                                                 .base_color = raw_surface.base,
                                                 .metallic = raw_surface.metallic,
                                                 .roughness = raw_surface.roughness};
        const glm::dvec3 expected =
            reference::surface_radiance(surface, position, glm::normalize(-position), lights, glm::dvec3(0));
        out.add(hdr.texel(x, y), expected);
    }
    return out;
}

}  // namespace pellucid::bench
