// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Counted<B>`: a backend that wraps another one and counts the calls of each frame by kind, and the bytes that the
/// CPU sends.  Handles are the wrapped backend's own.
#include <memory>
#include <pellucid/rhi/surface.hpp>
#include <utility>

namespace pellucid::inline v0_1 {
namespace counted {

/// Calls of one frame, from `begin_frame` to `submit`.
struct Counts {
    std::uint64_t passes = 0;     ///< render, compute and copy
    std::uint64_t pipelines = 0;  ///< bind_pipeline
    std::uint64_t groups = 0;     ///< bind_group and bind_frame
    std::uint64_t states = 0;     ///< index buffers, scissors, stencil references
    std::uint64_t pushes = 0;
    std::uint64_t draws = 0;  ///< an indirect call counts each of its draws
    std::uint64_t dispatches = 0;
    std::uint64_t copies = 0;  ///< copies, updates, fills, generated levels
    std::uint64_t queries = 0;
    std::uint64_t uploads = 0;    ///< upload_uniforms and upload_records
    std::uint64_t creations = 0;  ///< make_* within the frame: a steady frame has none
    std::uint64_t bytes = 0;      ///< [byte] pushed, uploaded, updated
    /// Calls of every kind but creations.
    [[nodiscard]] std::uint64_t calls() const {
        return passes + pipelines + groups + states + pushes + draws + dispatches + copies + queries + uploads;
    }
    friend bool operator==(const Counts&, const Counts&) = default;
};

/// Models `CommandList`.
template <rhi::Backend B>
class Commands {
public:
    void begin_render(const rhi::RenderPassDesc& pass) { count(counts_.passes).begin_render(pass); }
    void end_render() { inner_->end_render(); }
    void begin_compute(const rhi::ComputePassDesc& pass) { count(counts_.passes).begin_compute(pass); }
    void end_compute() { inner_->end_compute(); }
    void begin_copy(const rhi::CopyPassDesc& pass) { count(counts_.passes).begin_copy(pass); }
    void end_copy() { inner_->end_copy(); }

    void bind_pipeline(rhi::Pipeline pipeline) { count(counts_.pipelines).bind_pipeline(pipeline); }
    void bind_group(rhi::Group group) { count(counts_.groups).bind_group(group); }
    void bind_frame(rhi::UniformSlice u, const rhi::RecordSlice& r) { count(counts_.groups).bind_frame(u, r); }
    void bind_index_buffer(rhi::Buffer indices) { count(counts_.states).bind_index_buffer(indices); }
    void set_scissor(rhi::Rect rect) { count(counts_.states).set_scissor(rect); }
    void set_stencil_reference(std::uint8_t value) { count(counts_.states).set_stencil_reference(value); }
    void push(std::span<const std::byte> bytes) { count(counts_.pushes, bytes.size()).push(bytes); }

    void draw(const rhi::Draw& draw) { count(counts_.draws).draw(draw); }
    void draw_indexed(const rhi::DrawIndexed& draw) { count(counts_.draws).draw_indexed(draw); }
    void draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t n) {
        counts_.draws += n;
        inner_->draw_indexed_indirect(arguments, offset, n);
    }
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { count(counts_.dispatches).dispatch(x, y, z); }
    void dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset) {
        count(counts_.dispatches).dispatch_indirect(arguments, offset);
    }

    void copy(rhi::Buffer from, rhi::Buffer to, const rhi::BufferCopy& what) {
        count(counts_.copies).copy(from, to, what);
    }
    void copy(rhi::Texture from, rhi::Buffer to, const rhi::TextureCopy& what) {
        count(counts_.copies).copy(from, to, what);
    }
    void copy(rhi::Buffer from, rhi::Texture to, const rhi::TextureCopy& what) {
        count(counts_.copies).copy(from, to, what);
    }
    void update(rhi::Buffer to, std::uint64_t offset, std::span<const std::byte> bytes) {
        count(counts_.copies, bytes.size()).update(to, offset, bytes);
    }
    void fill(rhi::Buffer to, std::uint64_t offset, std::uint64_t bytes, std::uint32_t value) {
        count(counts_.copies).fill(to, offset, bytes, value);
    }
    void generate_mips(rhi::Texture texture) { count(counts_.copies).generate_mips(texture); }

    Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte> bytes) {
        return count(counts_.uploads, bytes.size()).upload_uniforms(bytes);
    }
    Result<rhi::RecordSlice> upload_records(std::uint32_t n, std::uint32_t stride) {
        return count(counts_.uploads, std::uint64_t{n} * stride).upload_records(n, stride);
    }

    void reset(rhi::Queries queries) { count(counts_.queries).reset(queries); }
    void write_timestamp(rhi::Queries queries, std::uint32_t i) { count(counts_.queries).write_timestamp(queries, i); }
    void begin_query(rhi::Queries queries, std::uint32_t i) { count(counts_.queries).begin_query(queries, i); }
    void end_query(rhi::Queries queries, std::uint32_t i) { inner_->end_query(queries, i); }

private:
    template <rhi::Backend>
    friend class Device;

    typename B::Commands& count(std::uint64_t& kind, std::uint64_t bytes = 0) {
        ++kind;
        counts_.bytes += bytes;
        return *inner_;
    }

    typename B::Commands* inner_ = nullptr;
    Counts counts_;
};

/// Models `DeviceOf<Device, Commands>`.
template <rhi::Backend B>
class Device {
public:
    explicit Device(std::unique_ptr<typename B::Device> inner) : inner_(std::move(inner)) {}

    Result<rhi::Buffer> make_buffer(const rhi::BufferDesc& desc) { return created().make_buffer(desc); }
    Result<rhi::Texture> make_texture(const rhi::TextureDesc& desc) { return created().make_texture(desc); }
    Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc& desc) { return created().make_sampler(desc); }
    Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc& desc) { return created().make_pipeline(desc); }
    Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc& desc) { return created().make_pipeline(desc); }
    Result<rhi::Group> make_group(const rhi::GroupDesc& desc) { return created().make_group(desc); }
    Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc) { return created().make_queries(desc); }
    std::span<std::byte> mapped(rhi::Buffer buffer) { return inner_->mapped(buffer); }
    Result<void> results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out) {
        return inner_->results(queries, first, out);
    }
    void destroy(rhi::Buffer object) { inner_->destroy(object); }
    void destroy(rhi::Texture object) { inner_->destroy(object); }
    void destroy(rhi::Sampler object) { inner_->destroy(object); }
    void destroy(rhi::Pipeline object) { inner_->destroy(object); }
    void destroy(rhi::Group object) { inner_->destroy(object); }
    void destroy(rhi::Queries object) { inner_->destroy(object); }
    bool alive(rhi::Buffer object) const { return std::as_const(*inner_).alive(object); }
    bool alive(rhi::Texture object) const { return std::as_const(*inner_).alive(object); }
    bool alive(rhi::Sampler object) const { return std::as_const(*inner_).alive(object); }
    bool alive(rhi::Pipeline object) const { return std::as_const(*inner_).alive(object); }
    bool alive(rhi::Group object) const { return std::as_const(*inner_).alive(object); }
    bool alive(rhi::Queries object) const { return std::as_const(*inner_).alive(object); }

    Result<Commands<B>*> begin_frame() {
        PELLUCID_TRY(commands_.inner_, inner_->begin_frame());
        commands_.counts_ = {};
        return &commands_;
    }
    Result<rhi::Ticket> submit() {
        last_frame_ = commands_.counts_;
        return inner_->submit();
    }
    Result<void> wait(rhi::Ticket ticket) { return inner_->wait(ticket); }
    bool done(rhi::Ticket ticket) { return inner_->done(ticket); }
    const rhi::DeviceInfo& info() const { return std::as_const(*inner_).info(); }
    std::uint64_t api_calls() const { return std::as_const(*inner_).api_calls(); }
    std::uint32_t live_objects() const { return std::as_const(*inner_).live_objects(); }

    /// What the last submitted frame asked for.
    [[nodiscard]] const Counts& last_frame() const { return last_frame_; }
    /// The wrapped device.
    [[nodiscard]] typename B::Device& backend() { return *inner_; }

private:
    typename B::Device& created() {
        ++commands_.counts_.creations;
        return *inner_;
    }

    std::unique_ptr<typename B::Device> inner_;
    Commands<B> commands_;
    Counts last_frame_;
};

/// Models `SurfaceOf<Surface<B>, Device<B>>` where B presents; counts nothing: presenting is no part of a frame.
template <rhi::Backend B>
class Surface {
public:
    static Result<std::unique_ptr<Surface>> create(Device<B>& device, const rhi::SurfaceDesc& desc) {
        PELLUCID_TRY(auto inner, B::Surface::create(device.backend(), desc));
        return std::unique_ptr<Surface>(new Surface(std::move(inner)));
    }
    Result<bool> present(rhi::Texture texture, Extent2D size) { return inner_->present(texture, size); }

private:
    explicit Surface(std::unique_ptr<typename B::Surface> inner) : inner_(std::move(inner)) {}
    std::unique_ptr<typename B::Surface> inner_;
};

}  // namespace counted

/// A backend that counts the calls that reach the one it wraps.
template <rhi::Backend B>
struct Counted {
    static constexpr const char* name = B::name;
    using Device = counted::Device<B>;
    using Commands = counted::Commands<B>;
    using Surface = counted::Surface<B>;

    static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc) {
        PELLUCID_TRY(auto inner, B::create(desc));
        return std::make_unique<Device>(std::move(inner));
    }
    static std::vector<rhi::DeviceInfo> list() { return B::list(); }
};

}  // namespace pellucid::inline v0_1
