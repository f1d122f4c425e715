// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The frame written once against the RHI, for every backend.
#include <cstring>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/bench_draws.hpp>
#include "rhi_overhead/loop.hpp"
#include "support/time.hpp"

namespace pellucid::bench {

/// The inner loops, kept out of line so that a disassembler finds them by name.
template <rhi::Backend B>
[[gnu::noinline]] void record_draws(rhi::CommandsFor<B>& c, const rhi::RecordSlice& slice,
                                    std::span<const DrawMatrix> matrices) {
    std::byte* to = slice.bytes.data();
    std::uint32_t record = slice.first;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        c.draw({.vertex_count = 3, .first_instance = record++});
    }
}
template <rhi::Backend B>
[[gnu::noinline]] void record_indexed(rhi::CommandsFor<B>& c, const rhi::RecordSlice& slice,
                                      std::span<const DrawMatrix> matrices) {
    std::byte* to = slice.bytes.data();
    std::uint32_t record = slice.first;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        c.draw_indexed({.index_count = 3, .first_instance = record++});
    }
}
template <rhi::Backend B>
[[gnu::noinline]] void record_pushes(rhi::CommandsFor<B>& c, std::span<const DrawMatrix> matrices) {
    for (const DrawMatrix& matrix : matrices) {
        c.push(rhi::bytes_of(matrix));
        c.draw({.vertex_count = 3});
    }
}

template <rhi::Backend B>
class OurLoop final : public Loop {
public:
    using Device = rhi::DeviceFor<B>;

    /// `device` must outlive the loop.
    static Result<std::unique_ptr<Loop>> make(Device& device) {
        auto loop = std::make_unique<OurLoop>(device);
        if (auto made = loop->make_objects(); !made) return made.error();
        return std::unique_ptr<Loop>(std::move(loop));
    }
    explicit OurLoop(Device& device) : device_(device) {}

    Result<FrameTime> frame(const Workload& workload, std::uint64_t number, Variant variant) override {
        const auto matrices = workload.matrices(number);
        const double start = now_ns();
        PELLUCID_TRY(auto* commands, device_.begin_frame());
        auto& c = *commands;
        PELLUCID_TRY(const rhi::UniformSlice uniforms, c.upload_uniforms(rhi::bytes_of(uniforms_)));
        rhi::RecordSlice records;
        if (variant != Variant::push) {
            PELLUCID_TRY(records, c.upload_records(static_cast<std::uint32_t>(matrices.size()), record_stride));
        }
        c.begin_render({.colors = {{.texture = target_}}, .size = {target_size, target_size}, .name = "draws"});
        c.bind_pipeline(variant == Variant::push ? push_pipeline_ : record_pipeline_);
        c.bind_frame(uniforms, records);
        switch (variant) {
            case Variant::records:
                record_draws<B>(c, records, matrices);
                break;
            case Variant::records_indexed:
                c.bind_index_buffer(indices_);
                record_indexed<B>(c, records, matrices);
                break;
            case Variant::push:
                record_pushes<B>(c, matrices);
                break;
        }
        c.end_render();
        const double recorded = now_ns();

        c.begin_copy({.uses = {rhi::use(target_, rhi::Access::copy_read), rhi::use(readback_, rhi::Access::copy_write)},
                      .name = "readback"});
        c.copy(target_, readback_, rhi::TextureCopy{});
        c.end_copy();
        PELLUCID_TRY(const rhi::Ticket ticket, device_.submit());
        PELLUCID_CHECK(device_.wait(ticket));
        const double done = now_ns();
        return FrameTime{recorded - start, done - start};
    }
    std::span<const std::byte> picture() override { return device_.mapped(readback_); }
    std::uint64_t api_calls() const override { return device_.api_calls(); }

private:
    Result<void> make_objects() {
        using rhi::BufferUsage, rhi::TextureUsage;
        constexpr std::uint32_t triangle[3] = {0, 1, 2};
        PELLUCID_OWN(target_, device_,
                     device_.make_texture({.size = {target_size, target_size},
                                           .usage = TextureUsage::attachment | TextureUsage::copy_source,
                                           .debug_name = "target"}));
        PELLUCID_OWN(readback_, device_,
                     device_.make_buffer({.size = target_size * target_size * 4,
                                          .usage = BufferUsage::copy_destination,
                                          .memory = rhi::Memory::readback,
                                          .debug_name = "readback"}));
        PELLUCID_OWN(indices_, device_,
                     device_.make_buffer({.size = sizeof triangle,
                                          .usage = BufferUsage::index,
                                          .initial = rhi::bytes_of(triangle),
                                          .debug_name = "indices"}));
        rhi::GraphicsPipelineDesc pipeline{.vertex = &shaders::bench_draws_record_vert,
                                           .fragment = &shaders::bench_draws_flat_frag,
                                           .colors = {{.format = rhi::Format::rgba8_unorm}},
                                           .debug_name = "draws with records"};
        PELLUCID_OWN(record_pipeline_, device_, device_.make_pipeline(pipeline));
        pipeline.vertex = &shaders::bench_draws_push_vert;
        pipeline.push_bytes = sizeof(DrawMatrix);
        pipeline.debug_name = "draws with push data";
        PELLUCID_OWN(push_pipeline_, device_, device_.make_pipeline(pipeline));
        return {};
    }

    Device& device_;
    rhi::Unique<Device, rhi::Texture> target_;
    rhi::Unique<Device, rhi::Buffer> readback_, indices_;
    rhi::Unique<Device, rhi::Pipeline> record_pipeline_, push_pipeline_;
    FrameUniforms uniforms_;
};

}  // namespace pellucid::bench
