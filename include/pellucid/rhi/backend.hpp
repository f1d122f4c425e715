// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a backend is: a type with a `Device` and a `Commands`, written down as small concepts so that a compiler names
/// what is missing.  `rhi::Null` models exactly this and nothing more; every pass is instantiated with it in a test, so
/// no pass can use what only one API has.
///
/// Threads: a device and everything made by it belong to one thread at a time.
/// Lifetime: `destroy` may be called while the GPU still uses the object; memory is freed when it no longer does.
/// Errors: creation, submission and waiting return `Result`; recording never fails (wrong use is undefined; wrap the
/// backend in `Validated<B>` to have it found and explained).
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/desc.hpp>
#include <concepts>
#include <memory>
#include <vector>

namespace pellucid::inline v0_1::rhi {

/// Buffers: creation, the mapped bytes of upload and readback memory (empty for device memory), destruction.
template <class D>
concept CreatesBuffers = requires(D d, const D c, const BufferDesc& desc, Buffer buffer) {
    { d.make_buffer(desc) } -> std::same_as<Result<Buffer>>;
    { d.mapped(buffer) } -> std::same_as<std::span<std::byte>>;
    { d.destroy(buffer) } -> std::same_as<void>;
    { c.alive(buffer) } -> std::same_as<bool>;
};

template <class D>
concept CreatesTextures = requires(D d, const D c, const TextureDesc& desc, const SamplerDesc& how, Texture t,
                                   Sampler s) {
    { d.make_texture(desc) } -> std::same_as<Result<Texture>>;
    { d.make_sampler(how) } -> std::same_as<Result<Sampler>>;
    { d.destroy(t) } -> std::same_as<void>;
    { d.destroy(s) } -> std::same_as<void>;
    { c.alive(t) } -> std::same_as<bool>;
    { c.alive(s) } -> std::same_as<bool>;
};

/// Pipelines are complete when they are returned: nothing is compiled later, inside a frame.
template <class D>
concept CreatesPipelines = requires(D d, const D c, const GraphicsPipelineDesc& g, const ComputePipelineDesc& k,
                                    const GroupDesc& group, Pipeline pipeline, Group made) {
    { d.make_pipeline(g) } -> std::same_as<Result<Pipeline>>;
    { d.make_pipeline(k) } -> std::same_as<Result<Pipeline>>;
    { d.make_group(group) } -> std::same_as<Result<Group>>;
    { d.destroy(pipeline) } -> std::same_as<void>;
    { d.destroy(made) } -> std::same_as<void>;
    { c.alive(pipeline) } -> std::same_as<bool>;
    { c.alive(made) } -> std::same_as<bool>;
};

/// `results` needs the queries' work to be done (wait for its ticket first).  Timestamps are in ticks of
/// `DeviceInfo::timestamp_ns`, occlusion counts in samples that passed.
template <class D>
concept CreatesQueries = requires(D d, const D c, const QueriesDesc& desc, Queries q, std::span<std::uint64_t> out) {
    { d.make_queries(desc) } -> std::same_as<Result<Queries>>;
    { d.results(q, std::uint32_t{}, out) } -> std::same_as<Result<void>>;
    { d.destroy(q) } -> std::same_as<void>;
    { c.alive(q) } -> std::same_as<bool>;
};

/// `begin_frame` waits until the oldest of `frames_in_flight` frames is done and returns the one command list, ready to
/// record; `submit` ends it.  Work runs in the order of submission.  `api_calls` counts calls into the API since
/// creation when `DeviceDesc::count_api_calls` is set, else 0.  `live_objects` counts objects made and not destroyed.
template <class D, class C>
concept Submits = requires(D d, const D c, Ticket ticket) {
    { d.begin_frame() } -> std::same_as<Result<C*>>;
    { d.submit() } -> std::same_as<Result<Ticket>>;
    { d.wait(ticket) } -> std::same_as<Result<void>>;
    { d.done(ticket) } -> std::same_as<bool>;
    { c.info() } -> std::same_as<const DeviceInfo&>;
    { c.api_calls() } -> std::same_as<std::uint64_t>;
    { c.live_objects() } -> std::same_as<std::uint32_t>;
};

/// Passes do not nest.  Barriers happen where a pass begins, from what it declares.
template <class C>
concept RecordsPasses = requires(C c, const RenderPassDesc& r, const ComputePassDesc& k, const CopyPassDesc& p) {
    c.begin_render(r);
    c.end_render();
    c.begin_compute(k);
    c.end_compute();
    c.begin_copy(p);
    c.end_copy();
};

/// Bind the pipeline first.  Groups stay bound while the next pipelines declare the same layouts; push data and the
/// frame group always stay bound within a pass.  `bind_frame` binds group 0: the frame's uniforms and its records.
template <class C>
concept RecordsState = requires(C c, Pipeline pipeline, Group group, Buffer indices, UniformSlice u,
                                const RecordSlice& r, std::span<const std::byte> bytes, Rect rect) {
    c.bind_pipeline(pipeline);
    c.bind_group(group);
    c.bind_frame(u, r);
    c.bind_index_buffer(indices);  // 32-bit indices
    c.push(bytes);
    c.set_scissor(rect);
    c.set_stencil_reference(std::uint8_t{});
};

/// Indirect records have the members of `DrawIndexed` and (x, y, z), in order, as 32-bit words.
template <class C>
concept RecordsWork = requires(C c, const Draw& d, const DrawIndexed& i, Buffer arguments, std::uint32_t n,
                               std::uint64_t at) {
    c.draw(d);
    c.draw_indexed(i);
    c.draw_indexed_indirect(arguments, at, n);
    c.dispatch(n, n, n);
    c.dispatch_indirect(arguments, at);
};

/// Inside a copy pass.  `update` writes up to 64 KiB from the CPU through the device's staging ring (larger data is
/// split); `fill` writes 32-bit words.  `generate_mips` halves from level 0 with a linear filter: 2×2 means for even
/// sizes, the driver's own weights for odd ones.
template <class C>
concept RecordsCopies = requires(C c, Buffer b, Texture t, BufferCopy bc, TextureCopy tc,
                                 std::span<const std::byte> bytes) {
    c.copy(b, b, bc);
    c.copy(t, b, tc);
    c.copy(b, t, tc);
    c.update(b, std::uint64_t{}, bytes);
    c.fill(b, std::uint64_t{}, std::uint64_t{}, std::uint32_t{});
    c.generate_mips(t);
};

/// Data of this frame, in the device's ring, which grows by itself.  `upload_records(count, stride)`: stride is a power
/// of two up to 256 bytes.
template <class C>
concept UploadsFrameData = requires(C c, std::span<const std::byte> bytes, std::uint32_t n) {
    { c.upload_uniforms(bytes) } -> std::same_as<Result<UniformSlice>>;
    { c.upload_records(n, n) } -> std::same_as<Result<RecordSlice>>;
};

/// `reset` before a pool is written again, outside passes.  Occlusion queries inside a render pass, one at a time.
template <class C>
concept RecordsQueries = requires(C c, Queries queries, std::uint32_t index) {
    c.reset(queries);
    c.write_timestamp(queries, index);
    c.begin_query(queries, index);
    c.end_query(queries, index);
};

template <class C>
concept CommandList = RecordsPasses<C> && RecordsState<C> && RecordsWork<C> && RecordsCopies<C> &&
    UploadsFrameData<C> && RecordsQueries<C>;

template <class D, class C>
concept DeviceOf = CreatesBuffers<D> && CreatesTextures<D> && CreatesPipelines<D> && CreatesQueries<D> && Submits<D, C>;

/// A backend: `B::name`, `B::Device` (made by `B::create`), `B::Commands`; `B::list` tells what devices there are.
template <class B>
concept Backend = DeviceOf<typename B::Device, typename B::Commands> && CommandList<typename B::Commands> &&
    requires(const DeviceDesc& desc) {
    { B::name } -> std::convertible_to<const char*>;
    { B::create(desc) } -> std::same_as<Result<std::unique_ptr<typename B::Device>>>;
    { B::list() } -> std::same_as<std::vector<DeviceInfo>>;
};

/// The device type of a backend.
template <Backend B>
using DeviceFor = typename B::Device;
/// The command list type of a backend.
template <Backend B>
using CommandsFor = typename B::Commands;

/// The bytes of one trivially copyable value, for `push`, `upload_uniforms` and `update`.
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const T& value) noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}
/// The bytes of a contiguous range of trivially copyable values.
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(std::span<T> values) noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(values);
}

}  // namespace pellucid::inline v0_1::rhi
