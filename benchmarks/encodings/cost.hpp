// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What encoding a value and decoding it again costs on a device.
#include <pellucid/gpu/scene.h>
#include <bit>
#include "encodings/kernels.hpp"
#include "support/pass_clock.hpp"

namespace pellucid::bench {

/// The frame's parameters as far as positions need them.
[[nodiscard]] inline gpu::FrameParams kernel_frame(DepthRange range, Extent2D size) {
    const PositionView view = kernel_view(range, size);
    const auto narrow = [](double x, double y, double z, double w) {
        return gpu::vec4{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
    };
    const auto column = [&](int i) {
        const glm::dvec4& c = view.world_from_view[i];
        return narrow(c.x, c.y, c.z, 0);
    };
    gpu::FrameParams frame{};
    frame.world_x = column(0), frame.world_y = column(1), frame.world_z = column(2);
    frame.clip_scale = narrow(view.clip.sx, view.clip.sy, view.clip.ox, view.clip.oy);
    frame.clip_depth = narrow(view.clip.zz, view.clip.zw, view.clip.wz, view.clip.ww);
    frame.view_scale = narrow(1 / view.clip.sx, 1 / view.clip.sy, 0, 0);
    frame.pixel = narrow(2.0 / size.width, 2.0 / size.height, size.width, size.height);
    return frame;
}

/// Checks and times every kernel; the rows of each family get their costs.
template <rhi::Backend B>
[[nodiscard]] Result<void> add_costs(rhi::DeviceFor<B>& device, const PassSettings& settings,
                                     std::vector<EncodingFamily>& families, const std::vector<PixelAt>& pixels) {
    const Extent2D size = settings.size;
    const rhi::TextureDesc shown{.size = size,
                                 .format = rhi::Format::rgba32_float,
                                 .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                                 .debug_name = "encodings.errors"};
    rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> errors;
    PELLUCID_OWN(errors, device, device.make_texture(shown));
    const auto matrix = std::bit_cast<gpu::EncodingMatrix>(kernel_view(DepthRange::infinite, size).world_from_clip);
    rhi::Unique<rhi::DeviceFor<B>, rhi::Buffer> matrices;
    PELLUCID_OWN(matrices, device,
                 device.make_buffer({.size = sizeof matrix,
                                     .usage = rhi::BufferUsage::uniform,
                                     .initial = rhi::bytes_of(matrix),
                                     .debug_name = "encodings.matrix"}));
    const rhi::GroupLayout layout{{{BENCH_ENCODINGS_OUTPUT, rhi::BindingKind::storage_texture},
                                   {BENCH_ENCODINGS_MATRIX, rhi::BindingKind::uniform_buffer}}};
    rhi::Unique<rhi::DeviceFor<B>, rhi::Group> group;
    PELLUCID_OWN(group, device,
                 device.make_group({.layout = layout,
                                    .bindings = {{.binding = BENCH_ENCODINGS_OUTPUT, .texture = errors},
                                                 {.binding = BENCH_ENCODINGS_MATRIX, .buffer = matrices}},
                                    .debug_name = "encodings"}));

    std::array<rhi::UniformSlice, 3> frames;  // one a DepthRange
    const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
        for (const DepthRange range : {DepthRange::standard, DepthRange::reversed, DepthRange::infinite}) {
            PELLUCID_TRY(frames[static_cast<std::size_t>(range)],
                         cmd.upload_uniforms(rhi::bytes_of(kernel_frame(range, size))));
        }
        return {};
    };
    std::vector<rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline>> pipelines;
    std::vector<Work<B>> works;
    for (const EncodingFamily& family : families)
        for (const EncodingKernel& kernel : family.kernels) {
            const rhi::SpecConstant constants[] = {{0, 0},
                                                   {1, kernel.constants[0]},
                                                   {2, kernel.constants[1]},
                                                   {3, kernel.constants[2]},
                                                   {4, kernel.constants[3]}};
            rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline;
            PELLUCID_OWN(pipeline, device,
                         device.make_pipeline(rhi::ComputePipelineDesc{.compute = kernel.shader,
                                                                       .constants = constants,
                                                                       .pass_group = layout,
                                                                       .debug_name = kernel.name.c_str()}));
            const rhi::Pipeline handle = pipeline;
            pipelines.push_back(std::move(pipeline));
            const auto record = [&, handle, range = kernel.range](rhi::CommandsFor<B>& cmd) {
                cmd.begin_compute({.uses = {rhi::use(matrices.get(), rhi::Access::uniform_read),
                                            rhi::use(errors.get(), rhi::Access::storage_write)},
                                   .name = "encodings"});
                cmd.bind_pipeline(handle);
                cmd.bind_frame(frames[static_cast<std::size_t>(range)], {});
                cmd.bind_group(group);
                cmd.dispatch((size.width + 7) / 8, (size.height + 7) / 8, 1);
                cmd.end_compute();
            };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const rhi::Texels texels, rhi::download<B>(device, errors, shown));
            PELLUCID_CHECK(check_kernel(kernel, texels, pixels));
            works.push_back({.name = kernel.name, .record = record});
        }
    PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));

    const double values = BENCH_ENCODINGS_VALUES * static_cast<double>(size.width) * size.height;
    std::size_t first = 0;
    for (EncodingFamily& family : families) {
        std::vector<std::vector<double>> own;  // without the loop, round by round
        std::size_t cheapest = 0;
        for (std::size_t i = 0; i < family.table.rows.size(); ++i) {
            own.push_back(differences(times[first + 1 + i], times[first]));
            if (summarise(own[i]).median < summarise(own[cheapest]).median) cheapest = i;
        }
        // Where the cheapest cannot be told from the loop there is nothing to be a multiple of.
        const bool has_ratio = summarise(own[cheapest]).lowest > 0;
        for (std::size_t i = 0; i < family.table.rows.size(); ++i) {
            SpeedErrorRow& row = family.table.rows[i];
            const double scale = 1e6 / values;  // [ms] of a dispatch → [ns] a value
            std::vector<NamedNumber> more = {{"ns a value", summarise(own[i]).median * scale}};
            if (family.has_decoders) {
                const std::vector<double>& decoder = times[first + 1 + i + family.table.rows.size()];
                more.push_back({"to encode", summarise(differences(times[first + 1 + i], decoder)).median * scale});
                more.push_back({"to decode", summarise(differences(decoder, times[first])).median * scale});
            }
            row.more.insert(row.more.begin(), more.begin(), more.end());
            for (double& ms : own[i]) ms /= BENCH_ENCODINGS_VALUES;  // one value a pixel
            row.milliseconds = summarise(own[i]);
        }
        for (std::size_t i = 0; has_ratio && i < family.table.rows.size(); ++i)
            family.table.rows[i].ratio = summarise(ratios(own[i], own[cheapest])).median;
        char text[160];
        std::snprintf(text, sizeof text,
                      "ms: encoding and decoding one value a pixel, without the loop, which took %.3g ns a value",
                      summarise(times[first]).median * 1e6 / values);
        family.table.notes.push_back(text);
        first += family.kernels.size();
    }
    return {};
}

}  // namespace pellucid::bench
