// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The Vulkan command list.  What is called per draw is inline: the API call behind at most three comparisons.
#include <array>
#include <cstring>
#include <pellucid/rhi/desc.hpp>
#include <pellucid/vulkan/context.hpp>
#include <span>

namespace pellucid::inline v0_1::vulkan {

/// Models rhi::CommandList; see rhi/backend.hpp for what the functions mean.
class Commands {
public:
    explicit Commands(Context& context) : context_(context), vk_(context.vk) {}
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    // passes (commands.cpp)
    void begin_render(const rhi::RenderPassDesc& desc);
    void end_render();
    void begin_compute(const rhi::ComputePassDesc& desc);
    void end_compute();
    void begin_copy(const rhi::CopyPassDesc& desc);
    void end_copy();

    // state
    void bind_pipeline(rhi::Pipeline pipeline) {
        if (pipeline == pipeline_) return;
        const PipelineObject& object = context_.pipelines[pipeline];
        pipeline_ = pipeline;
        vk_.CmdBindPipeline(commands_, object.point, object.handle);
        if (object.layout != layout_) change_layout(object);
        if (object.stencil)
            vk_.CmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, object.stencil_reference);
    }
    void bind_group(rhi::Group group) {
        if (group != bound_[0] && group != bound_[1]) change_group(group);
    }
    void bind_frame(rhi::UniformSlice uniforms, const rhi::RecordSlice& records) {
        VkDescriptorSet set = context_.frame().sets[uniforms.block][records.block];
        if (!set && !(set = make_frame_set(uniforms.block, records.block))) return;
        vk_.CmdBindDescriptorSets(commands_, point_, context_.base_layout, 0, 1, &set, 1, &uniforms.offset);
    }
    void bind_index_buffer(rhi::Buffer indices) {
        if (indices == indices_) return;
        indices_ = indices;
        vk_.CmdBindIndexBuffer(commands_, context_.buffers[indices].handle, 0, VK_INDEX_TYPE_UINT32);
    }
    void push(std::span<const std::byte> bytes) {
        vk_.CmdPushConstants(commands_, context_.base_layout, push_stages, 0, static_cast<std::uint32_t>(bytes.size()),
                             bytes.data());
    }
    void set_scissor(rhi::Rect rect) {
        const VkRect2D area = {{static_cast<std::int32_t>(rect.x), static_cast<std::int32_t>(rect.y)},
                               {rect.width, rect.height}};
        vk_.CmdSetScissor(commands_, 0, 1, &area);
    }
    void set_stencil_reference(std::uint8_t value) {
        vk_.CmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, value);
    }

    // work
    void draw(const rhi::Draw& d) {
        vk_.CmdDraw(commands_, d.vertex_count, d.instance_count, d.first_vertex, d.first_instance);
    }
    void draw_indexed(const rhi::DrawIndexed& d) {
        vk_.CmdDrawIndexed(commands_, d.index_count, d.instance_count, d.first_index, d.vertex_offset,
                           d.first_instance);
    }
    void draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t count) {
        vk_.CmdDrawIndexedIndirect(commands_, context_.buffers[arguments].handle, offset, count,
                                   sizeof(rhi::DrawIndexed));
    }
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { vk_.CmdDispatch(commands_, x, y, z); }
    void dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset) {
        vk_.CmdDispatchIndirect(commands_, context_.buffers[arguments].handle, offset);
    }

    // copies (copy.cpp)
    void copy(rhi::Buffer source, rhi::Buffer destination, rhi::BufferCopy region);
    void copy(rhi::Texture source, rhi::Buffer destination, rhi::TextureCopy region);
    void copy(rhi::Buffer source, rhi::Texture destination, rhi::TextureCopy region);
    void update(rhi::Buffer destination, std::uint64_t offset, std::span<const std::byte> bytes);
    void fill(rhi::Buffer destination, std::uint64_t offset, std::uint64_t size, std::uint32_t word);
    void generate_mips(rhi::Texture texture);

    // this frame's data
    [[nodiscard]] Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte> bytes) {
        if (bytes.size() > uniform_slice_bytes) return uniforms_too_large(bytes.size());
        PELLUCID_TRY(const Ring::Slice slice, context_.frame().uniforms.allocate(context_, bytes.size(), 256));
        if (!bytes.empty()) std::memcpy(slice.data, bytes.data(), bytes.size());
        return rhi::UniformSlice{slice.block, static_cast<std::uint32_t>(slice.offset)};
    }
    [[nodiscard]] Result<rhi::RecordSlice> upload_records(std::uint32_t count, std::uint32_t stride) {
        if (!std::has_single_bit(stride) || stride > 256) return bad_stride(stride);
        const std::uint64_t size = std::uint64_t{count} * stride;
        PELLUCID_TRY(const Ring::Slice slice, context_.frame().records.allocate(context_, size, stride));
        return rhi::RecordSlice{slice.block, static_cast<std::uint32_t>(slice.offset / stride), {slice.data, size}};
    }

    // queries (query.cpp)
    void reset(rhi::Queries queries);
    void write_timestamp(rhi::Queries queries, std::uint32_t index);
    void begin_query(rhi::Queries queries, std::uint32_t index);
    void end_query(rhi::Queries queries, std::uint32_t index);

    /// The command buffer being recorded, for calls of one's own through `Device::native().table`.
    [[nodiscard]] VkCommandBuffer native() const noexcept { return commands_; }

private:
    friend class Device;
    static constexpr VkShaderStageFlags push_stages =
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

    /// One resource of the pass that begins, all its uses taken together.
    struct Use {
        Sync* sync = nullptr;
        const TextureObject* texture = nullptr;  ///< null: a buffer
        VkPipelineStageFlags2 stages = 0;
        VkAccessFlags2 access = 0;
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        bool write = false;
        bool discard = false;  ///< the former content is not needed
    };
    static constexpr std::size_t max_uses = rhi::max_resources + rhi::max_color_attachments + 1;

    void start(VkCommandBuffer commands);  ///< forgets the former frame
    void begin_pass(const char* name, VkPipelineBindPoint point);
    void end_pass();
    void declare(const Use& use);
    void declare(const rhi::Uses& uses, VkPipelineStageFlags2 shader_stages);
    void barriers();      ///< one call for all that was declared
    void host_barrier();  ///< makes what was written to readback buffers visible to the CPU
    void change_layout(const PipelineObject& pipeline);
    void change_group(rhi::Group group);
    [[nodiscard]] VkDescriptorSet make_frame_set(std::uint32_t uniform_block, std::uint32_t record_block);
    [[nodiscard]] Error uniforms_too_large(std::size_t size) const;
    [[nodiscard]] Error bad_stride(std::uint32_t stride) const;
    /// Recording never fails: the first error is kept and `submit` returns it.
    void keep(const Error& error);

    Context& context_;
    const DeviceTable& vk_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkPipelineBindPoint point_ = VK_PIPELINE_BIND_POINT_GRAPHICS;
    rhi::Pipeline pipeline_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::uint32_t pass_layout_ = 0, scene_layout_ = 0;  ///< set layouts of the bound pipeline
    rhi::Group bound_[2];                               ///< groups 1 and 2 as the next draw sees them
    std::uint32_t pass_bound_ = ~0u;                    ///< set layout of what is bound at 1
    std::uint32_t scene_under_ = ~0u;                   ///< set layout of group 1 under which group 2 was bound
    rhi::Buffer indices_;
    std::array<Use, max_uses> uses_;
    std::size_t use_count_ = 0;
    bool readback_written_ = false;
    bool in_pass_ = false;
    bool failed_ = false;
    Error error_;
};

}  // namespace pellucid::inline v0_1::vulkan
