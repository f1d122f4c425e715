// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The loop of shaders/bench_brdf: what an evaluation of a term costs.
#include <pellucid/rhi/readback.hpp>
#include <pellucid/shaders/bench_brdf.hpp>
#include "brdf/errors.hpp"
#include "support/pass_clock.hpp"

namespace pellucid::bench {

/// The tables as textures, and the sums of all invocations.
template <rhi::Backend B>
struct TermTargets {
    std::vector<rhi::Unique<rhi::DeviceFor<B>, rhi::Texture>> tables;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> sums;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Sampler> sampler;
    rhi::TextureDesc sums_desc = {};

    [[nodiscard]] static Result<TermTargets> create(rhi::DeviceFor<B>& device, Extent2D size,
                                                    const std::vector<TableForm>& forms) {
        TermTargets out;
        for (const TableForm& form : forms) {
            std::vector<float> values;
            for (std::size_t i = 0; i < form.table.texels().size(); ++i) {
                const auto& texel = form.table.texels()[i];
                const auto& average = form.table.averages()[i / static_cast<std::size_t>(form.size)];
                values.insert(values.end(), {texel.loss, texel.shift, average.loss, average.bias});
            }
            std::vector<std::uint16_t> halves(values.size());
            std::transform(values.begin(), values.end(), halves.begin(), half_toward_zero);  // exact: they are halves
            const bool half = form.storage == reference::DfgStorage::float16;
            const auto side = static_cast<std::uint32_t>(form.size);
            rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> texture;
            PELLUCID_OWN(texture, device,
                         device.make_texture({.size = {side, side},
                                              .format = half ? rhi::Format::rgba16_float : rhi::Format::rgba32_float,
                                              .initial = half ? rhi::bytes_of(std::span<const std::uint16_t>(halves))
                                                              : rhi::bytes_of(std::span<const float>(values)),
                                              .debug_name = "albedo table"}));
            out.tables.push_back(std::move(texture));
        }
        out.sums_desc = {.size = size,
                         .format = rhi::Format::r32_float,
                         .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                         .debug_name = "sums"};
        PELLUCID_OWN(out.sums, device, device.make_texture(out.sums_desc));
        PELLUCID_OWN(out.sampler, device,
                     device.make_sampler({.mipmapped = false,
                                          .wrap_u = rhi::Wrap::clamp,
                                          .wrap_v = rhi::Wrap::clamp,
                                          .debug_name = "albedo table"}));
        return out;
    }
};

template <rhi::Backend B>
struct TermLoop {
    rhi::Unique<rhi::DeviceFor<B>, rhi::Buffer> parameters;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Group> group;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline;
    rhi::Texture table = {}, sums = {};
    Extent2D size = {};
    std::uint32_t term = 0, count = 0;

    /// `count`: evaluations of an invocation, of which there is one for each texel of the sums.
    [[nodiscard]] static Result<TermLoop> create(rhi::DeviceFor<B>& device, const TermTargets<B>& targets,
                                                 const std::vector<TableForm>& forms, std::size_t table,
                                                 std::uint32_t term, std::uint32_t count) {
        TermLoop out;
        out.table = targets.tables[table];
        out.sums = targets.sums;
        out.size = targets.sums_desc.size;
        out.term = term;
        out.count = count;
        const auto side = static_cast<float>(forms[table].size);
        const gpu::BrdfParameters values{
            .normal = {static_cast<float>(loop_normal.x), static_cast<float>(loop_normal.y),
                       static_cast<float>(loop_normal.z)},
            .count = count,
            .scale = (side - 1) / side,
            .offset = 0.5f / side,
            .reserved0 = 0,
            .reserved1 = 0};
        PELLUCID_OWN(out.parameters, device,
                     device.make_buffer({.size = sizeof values,
                                         .usage = rhi::BufferUsage::uniform,
                                         .initial = rhi::bytes_of(values),
                                         .debug_name = "terms.parameters"}));
        const rhi::GroupLayout layout{{{BENCH_BRDF_OUTPUT, rhi::BindingKind::storage_texture},
                                       {BENCH_BRDF_PARAMETERS, rhi::BindingKind::uniform_buffer},
                                       {BENCH_BRDF_TABLE, rhi::BindingKind::sampled_texture}}};
        const rhi::SpecConstant constants[] = {{0, term}};
        PELLUCID_OWN(out.group, device,
                     device.make_group(
                         {.layout = layout,
                          .bindings = {{.binding = BENCH_BRDF_OUTPUT, .texture = out.sums},
                                       {.binding = BENCH_BRDF_PARAMETERS, .buffer = out.parameters},
                                       {.binding = BENCH_BRDF_TABLE, .texture = out.table, .sampler = targets.sampler}},
                          .debug_name = "terms"}));
        PELLUCID_OWN(out.pipeline, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::bench_brdf_term_comp,
                                                                   .constants = constants,
                                                                   .pass_group = layout,
                                                                   .debug_name = "terms"}));
        return out;
    }
    void record(rhi::CommandsFor<B>& cmd) const {
        cmd.begin_compute({.uses = {rhi::use(parameters.get(), rhi::Access::uniform_read),
                                    rhi::use(table, rhi::Access::sampled), rhi::use(sums, rhi::Access::storage_write)},
                           .name = "terms"});
        cmd.bind_pipeline(pipeline);
        cmd.bind_group(group);
        cmd.dispatch((size.width + 7) / 8, (size.height + 7) / 8, 1);
        cmd.end_compute();
    }
    [[nodiscard]] double evaluations() const { return double(size.width) * size.height * count; }

    /// Relative errors of the sums against those of the same term in double.
    [[nodiscard]] ErrorSample errors(const rhi::Texels& found, const DfgTable& values, std::uint32_t samples) const {
        ErrorSample out;
        for (const auto [x, y] : sample_pixels(size, samples))
            out.add(double{found.at<float>(x, y)} / loop_sum(term, y * size.width + x, count, values) - 1);
        return out;
    }
};

}  // namespace pellucid::bench
