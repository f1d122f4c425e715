// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Null`: a backend with no GPU.  It has exactly the surface of the concepts, so what compiles with it uses nothing
/// that only one API has.  It draws nothing: it writes down what it was asked, counts live objects, lends real memory
/// for mapped buffers and frame data, and can be told to fail.
#include <algorithm>
#include <memory>
#include <pellucid/rhi/surface.hpp>
#include <vector>

namespace pellucid::inline v0_1 {
namespace null {

/// One call: the function's name and its main argument (a handle's bits, a count, a size; 0 where there is none).
struct Call {
    const char* name = "";
    std::uint64_t argument = 0;
};

/// What device and command list share.
struct State {
    std::vector<Call> calls = {};
    std::uint64_t creations_until_failure = 0;  ///< 0: none fails
    bool lost = false;
    std::vector<std::vector<std::byte>> records = {};  ///< of this frame; reused by the next
    std::size_t records_used = 0;
    std::uint64_t uniform_bytes = 0;

    void note(const char* name, std::uint64_t argument = 0) { calls.push_back({name, argument}); }
    /// Counts a creation; the error when it is the one that must fail.
    Result<void> create(const char* name, const char* what) {
        note(name);
        if (lost) return Error{Errc::device_lost, std::string("null: the device is lost, so ") + what + " is not made"};
        if (creations_until_failure == 0 || --creations_until_failure != 0) return {};
        return Error{Errc::out_of_memory, std::string("null: told to fail at ") + what};
    }
};

/// Models `CommandList`.
class Commands {
public:
    explicit Commands(State& state) : state_(&state) {}

    void begin_render(const rhi::RenderPassDesc& pass) { state_->note("begin_render", pass.colors.size()); }
    void end_render() { state_->note("end_render"); }
    void begin_compute(const rhi::ComputePassDesc& pass) { state_->note("begin_compute", pass.uses.size()); }
    void end_compute() { state_->note("end_compute"); }
    void begin_copy(const rhi::CopyPassDesc& pass) { state_->note("begin_copy", pass.uses.size()); }
    void end_copy() { state_->note("end_copy"); }

    void bind_pipeline(rhi::Pipeline pipeline) { state_->note("bind_pipeline", pipeline.bits); }
    void bind_group(rhi::Group group) { state_->note("bind_group", group.bits); }
    void bind_frame(rhi::UniformSlice uniforms, const rhi::RecordSlice&) {
        state_->note("bind_frame", uniforms.offset);
    }
    void bind_index_buffer(rhi::Buffer indices) { state_->note("bind_index_buffer", indices.bits); }
    void push(std::span<const std::byte> bytes) { state_->note("push", bytes.size()); }
    void set_scissor(rhi::Rect rect) { state_->note("set_scissor", std::uint64_t{rect.width} * rect.height); }
    void set_stencil_reference(std::uint8_t value) { state_->note("set_stencil_reference", value); }

    void draw(const rhi::Draw& draw) { state_->note("draw", draw.vertex_count); }
    void draw_indexed(const rhi::DrawIndexed& draw) { state_->note("draw_indexed", draw.index_count); }
    void draw_indexed_indirect(rhi::Buffer, std::uint64_t, std::uint32_t count) {
        state_->note("draw_indexed_indirect", count);
    }
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        state_->note("dispatch", std::uint64_t{x} * y * z);
    }
    void dispatch_indirect(rhi::Buffer, std::uint64_t offset) { state_->note("dispatch_indirect", offset); }

    void copy(rhi::Buffer, rhi::Buffer, const rhi::BufferCopy& what) { state_->note("copy", what.size); }
    void copy(rhi::Texture from, rhi::Buffer, const rhi::TextureCopy&) {
        state_->note("copy_texture_to_buffer", from.bits);
    }
    void copy(rhi::Buffer, rhi::Texture to, const rhi::TextureCopy&) {
        state_->note("copy_buffer_to_texture", to.bits);
    }
    void update(rhi::Buffer, std::uint64_t, std::span<const std::byte> bytes) { state_->note("update", bytes.size()); }
    void fill(rhi::Buffer, std::uint64_t, std::uint64_t size, std::uint32_t) { state_->note("fill", size); }
    void generate_mips(rhi::Texture texture) { state_->note("generate_mips", texture.bits); }

    Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte> bytes) {
        PELLUCID_CHECK(state_->create("upload_uniforms", "uniforms of the frame"));
        const auto offset = static_cast<std::uint32_t>(state_->uniform_bytes);
        state_->uniform_bytes += (bytes.size() + 255) / 256 * 256;
        return rhi::UniformSlice{.block = 0, .offset = offset};
    }
    Result<rhi::RecordSlice> upload_records(std::uint32_t count, std::uint32_t stride) {
        PELLUCID_CHECK(state_->create("upload_records", "records of the frame"));
        if (state_->records_used == state_->records.size()) state_->records.emplace_back();
        std::vector<std::byte>& bytes = state_->records[state_->records_used++];
        bytes.resize(std::size_t{count} * stride);
        return rhi::RecordSlice{
            .block = static_cast<std::uint32_t>(state_->records_used - 1), .first = 0, .bytes = bytes};
    }

    void reset(rhi::Queries queries) { state_->note("reset", queries.bits); }
    void write_timestamp(rhi::Queries, std::uint32_t index) { state_->note("write_timestamp", index); }
    void begin_query(rhi::Queries, std::uint32_t index) { state_->note("begin_query", index); }
    void end_query(rhi::Queries, std::uint32_t index) { state_->note("end_query", index); }

private:
    State* state_;
};

/// Models `DeviceOf<Device, Commands>`.  Work is done when it is submitted; queries and readback memory hold zeros.
class Device {
public:
    Device() {
        info_.backend = info_.name = info_.driver = info_.api = "null";
        info_.max_texture_size = 16384;
        info_.max_array_layers = 2048;
        info_.max_storage_buffer_bytes = std::uint64_t{1} << 31;
        info_.float32_blending = true;
        info_.timestamp_ns = 1;
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    Result<rhi::Buffer> make_buffer(const rhi::BufferDesc& desc) {
        PELLUCID_CHECK(state_.create("make_buffer", desc.debug_name));
        if (desc.size == 0)
            return Error{Errc::invalid_argument, std::string("buffer '") + desc.debug_name + "' has size 0"};
        Memory memory{.size = desc.size};
        if (desc.memory != rhi::Memory::device) memory.mapped.resize(desc.size);
        if (!memory.mapped.empty()) std::copy(desc.initial.begin(), desc.initial.end(), memory.mapped.begin());
        return buffers_.insert(std::move(memory));
    }
    std::span<std::byte> mapped(rhi::Buffer buffer) {
        auto* memory = buffers_.find(buffer);
        return memory ? std::span<std::byte>(memory->mapped) : std::span<std::byte>{};
    }
    Result<rhi::Texture> make_texture(const rhi::TextureDesc& desc) {
        PELLUCID_CHECK(state_.create("make_texture", desc.debug_name));
        if (desc.size.width == 0 || desc.size.height == 0)
            return Error{Errc::invalid_argument, std::string("texture '") + desc.debug_name + "' has no texels"};
        return textures_.insert({.size = rhi::texture_bytes(desc), .mapped = {}});
    }
    Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc& desc) {
        PELLUCID_CHECK(state_.create("make_sampler", desc.debug_name));
        return samplers_.insert({});
    }
    Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc& desc) {
        PELLUCID_CHECK(state_.create("make_graphics_pipeline", desc.debug_name));
        return pipelines_.insert({});
    }
    Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc& desc) {
        PELLUCID_CHECK(state_.create("make_compute_pipeline", desc.debug_name));
        return pipelines_.insert({});
    }
    Result<rhi::Group> make_group(const rhi::GroupDesc& desc) {
        PELLUCID_CHECK(state_.create("make_group", desc.debug_name));
        return groups_.insert({});
    }
    Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc) {
        PELLUCID_CHECK(state_.create("make_queries", desc.debug_name));
        return queries_.insert({});
    }
    Result<void> results(rhi::Queries queries, std::uint32_t, std::span<std::uint64_t> out) {
        state_.note("results", queries.bits);
        std::fill(out.begin(), out.end(), 0);
        return {};
    }

    void destroy(rhi::Buffer object) { destroy("destroy_buffer", buffers_, object); }
    void destroy(rhi::Texture object) { destroy("destroy_texture", textures_, object); }
    void destroy(rhi::Sampler object) { destroy("destroy_sampler", samplers_, object); }
    void destroy(rhi::Pipeline object) { destroy("destroy_pipeline", pipelines_, object); }
    void destroy(rhi::Group object) { destroy("destroy_group", groups_, object); }
    void destroy(rhi::Queries object) { destroy("destroy_queries", queries_, object); }
    bool alive(rhi::Buffer object) const { return buffers_.find(object); }
    bool alive(rhi::Texture object) const { return textures_.find(object); }
    bool alive(rhi::Sampler object) const { return samplers_.find(object); }
    bool alive(rhi::Pipeline object) const { return pipelines_.find(object); }
    bool alive(rhi::Group object) const { return groups_.find(object); }
    bool alive(rhi::Queries object) const { return queries_.find(object); }

    Result<Commands*> begin_frame() {
        state_.note("begin_frame", frame_);
        if (state_.lost) return Error{Errc::device_lost, "null: the device is lost"};
        state_.records_used = 0;
        state_.uniform_bytes = 0;
        return &commands_;
    }
    Result<rhi::Ticket> submit() {
        state_.note("submit", frame_);
        if (state_.lost) return Error{Errc::device_lost, "null: the device is lost"};
        return rhi::Ticket{++frame_};
    }
    Result<void> wait(rhi::Ticket ticket) {
        state_.note("wait", static_cast<std::uint64_t>(ticket));
        if (state_.lost) return Error{Errc::device_lost, "null: the device is lost"};
        return {};
    }
    bool done(rhi::Ticket ticket) { return static_cast<std::uint64_t>(ticket) <= frame_; }
    const rhi::DeviceInfo& info() const { return info_; }
    std::uint64_t api_calls() const { return 0; }
    std::uint32_t live_objects() const {
        return buffers_.size() + textures_.size() + samplers_.size() + pipelines_.size() + groups_.size() +
               queries_.size();
    }

    // Beyond the concepts, for tests.
    [[nodiscard]] const std::vector<Call>& calls() const { return state_.calls; }
    void clear_calls() { state_.calls.clear(); }
    /// [byte] of the buffers and textures that there are.
    [[nodiscard]] std::uint64_t live_bytes() {
        std::uint64_t bytes = 0;
        buffers_.for_each([&](rhi::Buffer, const Memory& m) { bytes += m.size; });
        textures_.for_each([&](rhi::Texture, const Memory& m) { bytes += m.size; });
        return bytes;
    }
    /// From now on the device says that it is like this.
    void pretend(const rhi::DeviceInfo& info) { info_ = info; }
    /// The `n`-th creation from now (`make_*` and `upload_*` count) fails with `out_of_memory`; 0: none does.
    void fail_after(std::uint64_t n) { state_.creations_until_failure = n; }
    /// From now on every creation, `begin_frame`, `submit` and `wait` says `device_lost`; objects can still be
    /// destroyed.
    void lose() { state_.lost = true; }

private:
    friend class Surface;
    struct Nothing {};
    struct Memory {
        std::uint64_t size = 0;
        std::vector<std::byte> mapped;
    };
    template <class Tag, class T>
    void destroy(const char* name, SlotMap<Tag, T>& objects, Handle<Tag> object) {
        state_.note(name, object.bits);
        objects.erase(object);
    }

    State state_;
    Commands commands_{state_};
    rhi::DeviceInfo info_;
    SlotMap<rhi::BufferTag, Memory> buffers_;
    SlotMap<rhi::TextureTag, Memory> textures_;
    SlotMap<rhi::SamplerTag, Nothing> samplers_;
    SlotMap<rhi::PipelineTag, Nothing> pipelines_;
    SlotMap<rhi::GroupTag, Nothing> groups_;
    SlotMap<rhi::QueriesTag, Nothing> queries_;
    std::uint64_t frame_ = 0;
};

/// Models `SurfaceOf<Surface, Device>`: a window that shows nothing and remembers what it was given.
class Surface {
public:
    static Result<std::unique_ptr<Surface>> create(Device& device, const rhi::SurfaceDesc& desc) {
        PELLUCID_CHECK(device.state_.create("make_surface", desc.debug_name));
        return std::unique_ptr<Surface>(new Surface(device));
    }
    Result<bool> present(rhi::Texture texture, Extent2D size) {
        if (device_->state_.lost) return Error{Errc::device_lost, "null: the device is lost"};
        if (size.width == 0 || size.height == 0) return false;
        device_->state_.note("present", texture.bits);
        return true;
    }

private:
    explicit Surface(Device& device) : device_(&device) {}
    Device* device_;
};

}  // namespace null

/// The backend without a GPU.
struct Null {
    static constexpr const char* name = "null";
    using Device = null::Device;
    using Commands = null::Commands;
    using Surface = null::Surface;
    static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc&) { return std::make_unique<Device>(); }
    static std::vector<rhi::DeviceInfo> list() { return {Device{}.info()}; }
};

static_assert(rhi::PresentingBackend<Null>);

}  // namespace pellucid::inline v0_1
