// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Every descriptor of the RHI: plain aggregates, a default on every field, filled by designated initialisers.
/// Nothing here is a template or knows an API.
///
/// Conventions on both backends: NDC y up, depth reversed (near 1, far 0, cleared to 0, compare greater), texture row
/// 0 is the top row, front faces are counter-clockwise, sRGB encoding follows the attachment's format.
#include <pellucid/core/flags.hpp>
#include <pellucid/core/handle.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/core/log.hpp>
#include <pellucid/core/small_vector.hpp>
#include <pellucid/rhi/format.hpp>
#include <pellucid/rhi/shader.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pellucid::inline v0_1::rhi {

/// A range of memory.
using Buffer = Handle<struct BufferTag>;
/// Texels with levels and layers.
using Texture = Handle<struct TextureTag>;
/// How texels are filtered.
using Sampler = Handle<struct SamplerTag>;
using Pipeline = Handle<struct PipelineTag>;  ///< graphics or compute
using Group = Handle<struct GroupTag>;        ///< an immutable set of bound resources
using Queries = Handle<struct QueriesTag>;    ///< a pool of queries of one kind

inline constexpr std::size_t max_color_attachments = 8;
inline constexpr std::size_t max_bindings = 24;     ///< in one group
inline constexpr std::size_t max_push_bytes = 128;  ///< smallest limit of Vulkan, met on both backends
inline constexpr std::size_t max_resources = 32;    ///< declared reads and writes of one pass

// ---------------------------------------------------------------------------------------------------- device

/// The windows that a device is to present to (rhi/surface.hpp).
enum class WindowSystem : std::uint8_t { none, x11 };
/// A connection to a window system, as a window library hands it out; it must outlive the device.
struct NativeDisplay {
    WindowSystem system = WindowSystem::none;
    void* connection = nullptr;  ///< X11: the `Display*`
};

/// Which device is opened, and how.
struct DeviceDesc {
    std::string device = {};             ///< index ("0") or a part of the name; empty: the best one
    bool validation = false;             ///< validation layer with synchronisation validation; GL debug output
    std::uint32_t frames_in_flight = 2;  ///< 1 … 4
    bool gl_spirv = false;               ///< OpenGL: load SPIR-V (GL_ARB_gl_spirv) instead of GLSL text
    std::string pipeline_cache = {};     ///< file of the driver's compiled pipelines; empty: none is kept
    bool count_api_calls = false;        ///< put a counting thunk before every API function: `Device::api_calls()`
    NativeDisplay display = {};          ///< where windows are, for rhi/surface.hpp; none: no windows
    LogSink log = {};
};

/// What a device can do beyond the floor (tiers T0 and T1 of the design are the floor).
struct DeviceInfo {
    std::string backend;                 ///< "vulkan", "opengl", "null"
    std::string name;                    ///< the device's own name
    std::string driver;                  ///< driver name and version
    std::string api;                     ///< API version
    bool software = false;               ///< a CPU implementation
    std::string missing;                 ///< empty, or what keeps this device from being used
    std::uint32_t max_texture_size = 0;  ///< [texel] 2D width and height
    std::uint32_t max_array_layers = 0;
    std::uint64_t max_storage_buffer_bytes = 0;
    bool float32_blending = false;     ///< 32-bit float colour targets can be blended into
    bool int64_atomics = false;        ///< tier T2
    bool pixel_ordering = false;       ///< tier T3: fragment shader interlock
    double timestamp_ns = 0;           ///< [ns] one timestamp tick; 0: no timestamps
    std::uint32_t max_loop_turns = 0;  ///< after so many of all loops a shader is ended, silently; 0: never
};
/// `DeviceInfo::max_loop_turns` of Mesa's CPU drivers, llvmpipe and lavapipe (LP_MAX_TGSI_LOOP_ITERATIONS).
inline constexpr std::uint32_t llvmpipe_loop_turns = 65535;

// ---------------------------------------------------------------------------------------------------- memory

/// What a buffer may be used as: flags.
enum class BufferUsage : std::uint8_t {
    none = 0,
    uniform = 1,
    storage = 2,
    index = 4,
    indirect = 8,
    copy_source = 16,
    copy_destination = 32
};
/// Where a buffer lives and who maps it.
enum class Memory : std::uint8_t {
    device,   ///< GPU only; filled by `initial` or by copies
    upload,   ///< mapped for writing by the CPU for the buffer's whole life
    readback  ///< mapped for reading by the CPU for the buffer's whole life
};

/// A buffer to be made.
struct BufferDesc {
    std::uint64_t size = 0;  ///< [byte] > 0
    BufferUsage usage = BufferUsage::storage;
    Memory memory = Memory::device;
    std::span<const std::byte> initial = {};  ///< empty, or at most `size` bytes copied at creation
    const char* debug_name = "buffer";
};

/// What a texture may be used as: flags.
enum class TextureUsage : std::uint8_t {
    none = 0,
    sampled = 1,
    storage = 2,
    attachment = 4,
    copy_source = 8,
    copy_destination = 16
};
/// One picture, several of a size, or the six faces of a cube.
enum class TextureKind : std::uint8_t { flat, array, cube };

/// A texture to be made.
struct TextureDesc {
    Extent2D size = {};        ///< [texel] both > 0
    std::uint32_t layers = 1;  ///< array layers; 6 for a cube
    std::uint32_t mips = 1;    ///< 1 … floor(log2(max(size))) + 1
    Format format = Format::rgba8_unorm;
    TextureKind kind = TextureKind::flat;  ///< what the shader sees: sampler2D, sampler2DArray, samplerCube; image2D, …
    TextureUsage usage = TextureUsage::sampled;
    /// Empty, or all texels: mip 0 (all layers, row 0 = top, tightly packed), then mip 1, …
    std::span<const std::byte> initial = {};
    const char* debug_name = "texture";
};
/// [byte] what the levels and layers of a texture hold.
[[nodiscard]] constexpr std::uint64_t texture_bytes(const TextureDesc& desc) {
    std::uint64_t bytes = 0;
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
        const std::uint64_t w = desc.size.width >> mip, h = desc.size.height >> mip;
        bytes += (w ? w : 1) * (h ? h : 1) * desc.layers * info(desc.format).bytes;
    }
    return bytes;
}

/// Between texels, or the nearest.
enum class Filter : std::uint8_t { nearest, linear };
/// What is beyond the border.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };
/// How texels are filtered: trilinear and repeating by default.
struct SamplerDesc {
    Filter min = Filter::linear;
    Filter mag = Filter::linear;
    Filter mip = Filter::linear;
    bool mipmapped = true;  ///< false: only level 0
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    const char* debug_name = "sampler";
    friend constexpr bool operator==(const SamplerDesc& a, const SamplerDesc& b) {
        return a.min == b.min && a.mag == b.mag && a.mip == b.mip && a.mipmapped == b.mipmapped &&
               a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v;
    }
};

// ---------------------------------------------------------------------------------------------------- binding

/// Three groups by frequency.  Group 0 belongs to the device (see `Commands::bind_frame`); 1 and 2 are made by passes.
enum class GroupSlot : std::uint8_t { frame = 0, pass = 1, scene = 2 };

/// What a shader finds at a binding.
enum class BindingKind : std::uint8_t { uniform_buffer, storage_buffer, sampled_texture, storage_texture };

/// One binding of a group's shape.
struct BindingLayout {
    std::uint32_t binding = 0;  ///< number in the shader; unique in the whole program (gpu/bindings.h)
    BindingKind kind = BindingKind::storage_buffer;
    friend constexpr bool operator==(BindingLayout, BindingLayout) = default;
};
/// The shape of one group.  Every stage sees every binding.
struct GroupLayout {
    SmallVector<BindingLayout, max_bindings> bindings = {};
    friend constexpr bool operator==(const GroupLayout&, const GroupLayout&) = default;
};

/// What is bound to a number.
struct Binding {
    std::uint32_t binding = 0;
    Buffer buffer = {};     ///< for buffers: the whole of it
    Texture texture = {};   ///< for textures
    Sampler sampler = {};   ///< for sampled textures: combined with the texture
    std::uint32_t mip = 0;  ///< storage textures: the level that is bound (all its layers)
};
/// Resources that are bound together, and the shape that pipelines expect.
struct GroupDesc {
    GroupSlot slot = GroupSlot::pass;
    GroupLayout layout = {};
    SmallVector<Binding, max_bindings> bindings = {};  ///< one for each of the layout's, in any order
    const char* debug_name = "group";
};

// ---------------------------------------------------------------------------------------------------- pipelines

/// When a test passes: new value against old.
enum class Compare : std::uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
/// Which faces are left out.
enum class Cull : std::uint8_t { none, back, front };
/// What colours are multiplied by before they are added.
enum class BlendFactor : std::uint8_t {
    zero,
    one,
    src_alpha,
    one_minus_src_alpha,
    dst_alpha,
    one_minus_dst_alpha,
    src_color,
    one_minus_src_color,
    dst_color
};
/// How the two products are put together.
enum class BlendOp : std::uint8_t { add, min, max, reverse_subtract };

/// How a colour target blends; off by default.
struct Blend {
    bool enabled = false;
    BlendFactor src_color = BlendFactor::one;
    BlendFactor dst_color = BlendFactor::zero;
    BlendOp color_op = BlendOp::add;
    BlendFactor src_alpha = BlendFactor::one;
    BlendFactor dst_alpha = BlendFactor::zero;
    BlendOp alpha_op = BlendOp::add;
};
/// `C = src.rgb + (1 - src.a) dst.rgb`: compositing of premultiplied colour (Porter and Duff 1984, "over").
inline constexpr Blend blend_premultiplied = {true,         BlendFactor::one, BlendFactor::one_minus_src_alpha,
                                              BlendOp::add, BlendFactor::one, BlendFactor::one_minus_src_alpha,
                                              BlendOp::add};

/// Format and blending of a colour attachment, as a pipeline is built for it.
struct ColorTarget {
    Format format = Format::rgba8_unorm;
    Blend blend = {};
    std::uint8_t write_mask = 0xF;  ///< bit 0 red … bit 3 alpha
};
/// The stencil test of front or back faces.
struct StencilFace {
    Compare compare = Compare::always;
    enum class Op : std::uint8_t {
        keep,
        zero,
        replace,
        increment_clamp,
        decrement_clamp,
        invert,
        increment_wrap,
        decrement_wrap
    };
    Op fail = Op::keep, depth_fail = Op::keep, pass = Op::keep;
};
/// Depth and stencil tests, as a pipeline is built for them.
struct DepthStencil {
    Format format = Format::undefined;  ///< undefined: no depth attachment
    bool test = false;
    bool write = false;
    Compare compare = Compare::greater;  ///< reversed depth
    bool stencil_test = false;
    StencilFace front = {}, back = {};
    std::uint8_t stencil_read_mask = 0xFF, stencil_write_mask = 0xFF, stencil_reference = 0;
};
/// What vertices make.
enum class Topology : std::uint8_t { triangles, triangle_strip, lines, points };

/// Shaders and all state that drawing needs.
struct GraphicsPipelineDesc {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr;  ///< null: depth only
    std::span<const SpecConstant> constants = {};
    GroupLayout pass_group = {};   ///< shape of group 1; empty: none is bound
    GroupLayout scene_group = {};  ///< shape of group 2; empty: none is bound
    std::uint32_t push_bytes = 0;  ///< size of the push block, a multiple of 16 up to `max_push_bytes`
    SmallVector<ColorTarget, max_color_attachments> colors = {};
    DepthStencil depth = {};
    Cull cull = Cull::back;
    bool depth_clamp = false;
    Topology topology = Topology::triangles;
    const char* debug_name = "graphics pipeline";
};
/// A compute shader, its constants and its groups.
struct ComputePipelineDesc {
    const Shader* compute = nullptr;
    std::span<const SpecConstant> constants = {};
    GroupLayout pass_group = {};
    GroupLayout scene_group = {};
    std::uint32_t push_bytes = 0;
    const char* debug_name = "compute pipeline";
};

// ---------------------------------------------------------------------------------------------------- passes

/// How a pass uses a resource it does not attach.  Barriers follow from these declarations and from nothing else.
enum class Access : std::uint8_t {
    sampled,        ///< textures: texture(), texelFetch()
    uniform_read,   ///< buffers
    storage_read,   ///< buffers and storage textures
    storage_write,  ///< the same; earlier content may be dropped by nobody, but is not read
    storage_read_write,
    index_read,
    indirect_read,
    copy_read,
    copy_write
};
/// One buffer or one texture (all its levels and layers) and its use.
struct ResourceUse {
    Buffer buffer = {};
    Texture texture = {};
    Access access = Access::sampled;
};
/// What a pass reads and writes, beside its attachments.
using Uses = SmallVector<ResourceUse, max_resources>;
/// A buffer and what a pass does with it.
[[nodiscard]] constexpr ResourceUse use(Buffer buffer, Access access) {
    return {.buffer = buffer, .access = access};
}
/// A texture and what a pass does with it.
[[nodiscard]] constexpr ResourceUse use(Texture texture, Access access) {
    return {.texture = texture, .access = access};
}

/// What an attachment holds when a pass begins.
enum class Load : std::uint8_t { load, clear, discard };
/// Whether it is kept when the pass ends.
enum class Store : std::uint8_t { store, discard };

/// A colour texture that a render pass draws into.
struct ColorAttachment {
    Texture texture = {};
    std::uint32_t mip = 0, layer = 0;
    Load load = Load::clear;
    Store store = Store::store;
    float clear[4] = {0, 0, 0, 0};               ///< linear, also for sRGB formats
    std::uint32_t clear_uint[4] = {0, 0, 0, 0};  ///< used instead for *_uint formats
};
/// A depth texture that a render pass tests against and may write.
struct DepthAttachment {
    Texture texture = {};  ///< null: no depth attachment
    std::uint32_t mip = 0, layer = 0;
    Load load = Load::clear;
    Store store = Store::store;
    float clear = 0.0f;  ///< reversed depth: 0 is infinitely far
    std::uint32_t clear_stencil = 0;
    bool read_only = false;  ///< tested, never written; the pass may then also declare it `sampled`
};
/// Attachments, declared uses, size and name of a render pass.
struct RenderPassDesc {
    SmallVector<ColorAttachment, max_color_attachments> colors = {};
    DepthAttachment depth = {};
    Uses uses = {};
    Extent2D size = {};  ///< [texel] render area, viewport and scissor, from the top left; both > 0
    const char* name = "render pass";
};
/// Declared uses and name of a compute pass.
struct ComputePassDesc {
    Uses uses = {};
    const char* name = "compute pass";
};
/// Declared uses and name of a copy pass.
struct CopyPassDesc {
    Uses uses = {};
    const char* name = "copy pass";
};

/// A draw without indices.
struct Draw {
    std::uint32_t vertex_count = 0;
    std::uint32_t instance_count = 1;
    std::uint32_t first_vertex = 0;
    std::uint32_t first_instance = 0;  ///< base instance: index of the draw's record
};
/// A draw of indices; indirect draws have the same members.
struct DrawIndexed {
    std::uint32_t index_count = 0;
    std::uint32_t instance_count = 1;
    std::uint32_t first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;  ///< base instance: index of the draw's record
};
/// A rectangle of texels, from the top left.
struct Rect {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;  ///< [texel], from the top left
};

/// A range that is copied from buffer to buffer.
struct BufferCopy {
    std::uint64_t source_offset = 0, destination_offset = 0, size = 0;  ///< [byte]
};
/// One level and layer of a texture ↔ tightly packed rows in a buffer, row 0 at the top.
struct TextureCopy {
    std::uint32_t mip = 0, layer = 0;
    std::uint64_t buffer_offset = 0;  ///< [byte] a multiple of 16
};

/// Data written this frame: where `Commands::upload_*` put it in the device's ring.
struct UniformSlice {
    std::uint32_t block = 0;   ///< which block of the ring
    std::uint32_t offset = 0;  ///< [byte]
};
/// Records of this frame in the device's ring.
struct RecordSlice {
    std::uint32_t block = 0;
    std::uint32_t first = 0;          ///< index of record 0: add it to `first_instance`
    std::span<std::byte> bytes = {};  ///< write-combined memory: write it once, in order, and never read it
};

/// What queries measure.
enum class QueryKind : std::uint8_t { timestamp, occlusion };
/// A pool of queries of one kind.
struct QueriesDesc {
    QueryKind kind = QueryKind::timestamp;
    std::uint32_t count = 0;
    const char* debug_name = "queries";
};

/// A point in the device's work; `Device::wait` and `Device::done` take it.  0 is always done.
enum class Ticket : std::uint64_t { none = 0 };

}  // namespace pellucid::inline v0_1::rhi

template <>
inline constexpr bool pellucid::enable_flags<pellucid::rhi::BufferUsage> = true;
template <>
inline constexpr bool pellucid::enable_flags<pellucid::rhi::TextureUsage> = true;
