// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Validated<B>::Commands`: each call is checked, then forwarded with the backend's own handles.
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/validated/checks.hpp>

namespace pellucid::inline v0_1::validated {

/// Models `CommandList`.
template <rhi::Backend B>
class Commands {
public:
    explicit Commands(Objects& objects) : objects_(&objects), checks_(objects) {}

    void begin_render(const rhi::RenderPassDesc& desc) {
        rhi::RenderPassDesc inner;
        if (checks_.begin(desc, inner)) inner_->begin_render(inner);
    }
    void end_render() {
        rhi::Queries queries;
        std::uint32_t index = 0;
        if (checks_.abandoned_query(queries, index)) inner_->end_query(queries, index);
        if (checks_.end_render()) inner_->end_render();
    }
    void begin_compute(const rhi::ComputePassDesc& desc) {
        rhi::ComputePassDesc inner;
        if (checks_.begin(desc, inner)) inner_->begin_compute(inner);
    }
    void end_compute() {
        if (checks_.end_compute()) inner_->end_compute();
    }
    void begin_copy(const rhi::CopyPassDesc& desc) {
        rhi::CopyPassDesc inner;
        if (checks_.begin(desc, inner)) inner_->begin_copy(inner);
    }
    void end_copy() {
        if (checks_.end_copy()) inner_->end_copy();
    }

    void bind_pipeline(rhi::Pipeline pipeline) {
        if (checks_.bind_pipeline(pipeline)) inner_->bind_pipeline(inner(pipeline));
    }
    void bind_group(rhi::Group group) {
        if (checks_.bind_group(group)) inner_->bind_group(inner(group));
    }
    void bind_frame(rhi::UniformSlice uniforms, const rhi::RecordSlice& records) {
        if (checks_.bind_frame(uniforms, records)) inner_->bind_frame(uniforms, records);
    }
    void bind_index_buffer(rhi::Buffer indices) {
        if (checks_.bind_index_buffer(indices)) inner_->bind_index_buffer(inner(indices));
    }
    void push(std::span<const std::byte> bytes) {
        if (checks_.push(bytes.size())) inner_->push(bytes);
    }
    void set_scissor(rhi::Rect rect) {
        if (checks_.set_scissor(rect)) inner_->set_scissor(rect);
    }
    void set_stencil_reference(std::uint8_t value) {
        if (checks_.set_stencil_reference()) inner_->set_stencil_reference(value);
    }

    void draw(const rhi::Draw& draw) {
        if (checks_.draw(draw)) inner_->draw(draw);
    }
    void draw_indexed(const rhi::DrawIndexed& draw) {
        if (checks_.draw_indexed(draw)) inner_->draw_indexed(draw);
    }
    void draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t count) {
        if (checks_.draw_indexed_indirect(arguments, offset, count))
            inner_->draw_indexed_indirect(inner(arguments), offset, count);
    }
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        if (checks_.dispatch(x, y, z)) inner_->dispatch(x, y, z);
    }
    void dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset) {
        if (checks_.dispatch_indirect(arguments, offset)) inner_->dispatch_indirect(inner(arguments), offset);
    }

    void copy(rhi::Buffer from, rhi::Buffer to, const rhi::BufferCopy& what) {
        if (checks_.copy(from, to, what)) inner_->copy(inner(from), inner(to), what);
    }
    void copy(rhi::Texture from, rhi::Buffer to, const rhi::TextureCopy& what) {
        if (checks_.copy(from, to, what)) inner_->copy(inner(from), inner(to), what);
    }
    void copy(rhi::Buffer from, rhi::Texture to, const rhi::TextureCopy& what) {
        if (checks_.copy(from, to, what)) inner_->copy(inner(from), inner(to), what);
    }
    void update(rhi::Buffer to, std::uint64_t offset, std::span<const std::byte> bytes) {
        if (checks_.update(to, offset, bytes.size())) inner_->update(inner(to), offset, bytes);
    }
    void fill(rhi::Buffer to, std::uint64_t offset, std::uint64_t bytes, std::uint32_t value) {
        if (checks_.fill(to, offset, bytes)) inner_->fill(inner(to), offset, bytes, value);
    }
    void generate_mips(rhi::Texture texture) {
        if (checks_.generate_mips(texture)) inner_->generate_mips(inner(texture));
    }

    Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte> bytes) {
        if (!checks_.upload_uniforms(bytes.size())) return Error{Errc::invalid_argument, "upload_uniforms was misused"};
        auto made = inner_->upload_uniforms(bytes);
        if (made) checks_.uploaded(*made);
        return made;
    }
    Result<rhi::RecordSlice> upload_records(std::uint32_t count, std::uint32_t stride) {
        if (!checks_.upload_records(count, stride)) return Error{Errc::invalid_argument, "upload_records was misused"};
        auto made = inner_->upload_records(count, stride);
        if (made) checks_.uploaded(*made);
        return made;
    }

    void reset(rhi::Queries queries) {
        if (checks_.reset(queries)) inner_->reset(inner(queries));
    }
    void write_timestamp(rhi::Queries queries, std::uint32_t index) {
        if (checks_.write_timestamp(queries, index)) inner_->write_timestamp(inner(queries), index);
    }
    void begin_query(rhi::Queries queries, std::uint32_t index) {
        if (checks_.begin_query(queries, index)) inner_->begin_query(inner(queries), index);
    }
    void end_query(rhi::Queries queries, std::uint32_t index) {
        if (checks_.end_query(queries, index)) inner_->end_query(inner(queries), index);
    }

    /// The wrapped command list, for what only one backend has.
    [[nodiscard]] typename B::Commands& backend() { return *inner_; }

private:
    template <rhi::Backend>
    friend class Device;

    /// The backend's handle; precondition: the checks said yes.
    template <class H>
    [[nodiscard]] H inner(H handle) {
        return objects_->of(handle).find(handle)->inner;
    }

    Objects* objects_;
    RecordingChecks checks_;
    typename B::Commands* inner_ = nullptr;  ///< while a frame is recorded
};

}  // namespace pellucid::inline v0_1::validated
