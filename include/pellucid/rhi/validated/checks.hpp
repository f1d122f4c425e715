// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The rules of `Validated<B>`, apart from any backend.  Each function answers whether the call may be forwarded; where
/// it says no, it has said why.  A pass that may not begin takes its whole content with it.
#include <pellucid/rhi/validated/objects.hpp>
#include <span>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::validated {

/// Creation: what one descriptor cannot know by itself (the backends check the rest).
class CreationChecks {
public:
    explicit CreationChecks(Objects& objects) : objects_(&objects) {}

    bool pipeline(const rhi::GraphicsPipelineDesc& desc, PipelineInfo& out);
    bool pipeline(const rhi::ComputePipelineDesc& desc, PipelineInfo& out);
    /// `inner`: the descriptor with the backend's own handles.
    bool group(const rhi::GroupDesc& desc, rhi::GroupDesc& inner);
    bool results(rhi::Queries queries, std::uint32_t first, std::size_t count);

private:
    bool shader(const rhi::Shader* shader, const PipelineInfo& pipeline, PipelineInfo& out);
    Objects* objects_;
};

/// Recording: where in a frame and in a pass we are, and what is bound.
class RecordingChecks {
public:
    explicit RecordingChecks(Objects& objects) : objects_(&objects) {}

    bool begin_frame();
    bool submit();
    void abandon_frame() { recording_ = false; }  ///< the backend could not begin it
    bool recording() const { return recording_; }

    /// `inner`: the descriptor with the backend's own handles.
    bool begin(const rhi::RenderPassDesc& desc, rhi::RenderPassDesc& inner);
    bool begin(const rhi::ComputePassDesc& desc, rhi::ComputePassDesc& inner);
    bool begin(const rhi::CopyPassDesc& desc, rhi::CopyPassDesc& inner);
    bool end_render() { return end(Pass::render); }
    bool end_compute() { return end(Pass::compute); }
    bool end_copy() { return end(Pass::copy); }

    bool bind_pipeline(rhi::Pipeline pipeline);
    bool bind_group(rhi::Group group);
    bool bind_frame(const rhi::UniformSlice& uniforms, const rhi::RecordSlice& records);
    bool bind_index_buffer(rhi::Buffer indices);
    bool push(std::size_t bytes);
    bool set_scissor(rhi::Rect rect);
    bool set_stencil_reference();
    bool draw(const rhi::Draw& draw);
    bool draw_indexed(const rhi::DrawIndexed& draw);
    bool draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t count);
    bool dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z);
    bool dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset);

    bool copy(rhi::Buffer from, rhi::Buffer to, const rhi::BufferCopy& what);
    bool copy(rhi::Texture from, rhi::Buffer to, const rhi::TextureCopy& what);
    bool copy(rhi::Buffer from, rhi::Texture to, const rhi::TextureCopy& what);
    bool update(rhi::Buffer to, std::uint64_t offset, std::size_t bytes);
    bool fill(rhi::Buffer to, std::uint64_t offset, std::uint64_t bytes);
    bool generate_mips(rhi::Texture texture);

    bool upload_uniforms(std::size_t bytes);
    bool upload_records(std::uint32_t count, std::uint32_t stride);
    void uploaded(const rhi::UniformSlice& slice) { uniforms_.push_back(slice); }
    void uploaded(const rhi::RecordSlice& slice) { records_.push_back(slice); }

    bool reset(rhi::Queries queries);
    bool write_timestamp(rhi::Queries queries, std::uint32_t index);
    bool begin_query(rhi::Queries queries, std::uint32_t index);
    bool end_query(rhi::Queries queries, std::uint32_t index);
    /// Says that a query is still open where its pass ends, and which one the backend must be told to end.
    bool abandoned_query(rhi::Queries& queries, std::uint32_t& index);

private:
    enum class Pass : std::uint8_t { none, render, compute, copy };
    struct OpenQuery {
        rhi::Queries queries = {};
        std::uint32_t index = 0;
    };

    template <class Desc>
    bool begin(Pass kind, const Desc& desc, Desc& inner);
    bool end(Pass kind);
    /// Inside a pass of this kind that has begun well?
    bool inside(Pass kind, const char* call);
    bool uses(const rhi::Uses& uses, rhi::Uses& inner);
    bool attachment(rhi::Texture texture, std::uint32_t mip, std::uint32_t layer, Extent2D size, bool depth,
                    rhi::Texture& inner);
    bool attached_once();
    bool attached(rhi::Texture texture, bool& read_only) const;
    template <class H>
    bool declared(H resource, rhi::Access access) const;
    template <class H>
    bool declared_for(H resource, rhi::BindingKind kind) const;
    bool work(Pass kind, const char* call);
    bool bound_groups(const PipelineInfo& pipeline, const std::string& where);
    bool attachments_match(const PipelineInfo& pipeline, const std::string& where);
    bool index_range(const std::string& where, std::uint64_t first, std::uint64_t count);
    bool arguments(rhi::Buffer buffer, std::uint64_t offset, std::uint64_t bytes, const std::string& where);
    BufferInfo* copied(rhi::Buffer buffer, rhi::BufferUsage usage, rhi::Access access, std::uint64_t offset,
                       std::uint64_t bytes, const std::string& where);
    TextureInfo* copied(rhi::Texture texture, rhi::TextureUsage usage, rhi::Access access, const rhi::TextureCopy& what,
                        std::uint64_t& bytes, const std::string& where);
    QueriesInfo* query(rhi::Queries queries, std::uint32_t index, rhi::QueryKind kind, const std::string& where);
    [[nodiscard]] std::string where(const char* call) const;

    Objects* objects_;
    bool recording_ = false;
    Pass pass_ = Pass::none;
    bool refused_ = false;  ///< the pass could not begin: its content is not forwarded
    std::string name_;
    rhi::Uses uses_;
    rhi::RenderPassDesc render_;
    rhi::Pipeline pipeline_ = {};
    rhi::Group groups_[3] = {};
    bool frame_bound_ = false;
    bool records_bound_ = false;
    std::size_t pushed_ = 0;
    rhi::Buffer indices_ = {};
    OpenQuery open_query_ = {};
    std::vector<rhi::UniformSlice> uniforms_;  ///< of this frame
    std::vector<rhi::RecordSlice> records_;
};

}  // namespace pellucid::inline v0_1::validated

#if defined(PELLUCID_HEADER_ONLY)
#include <pellucid/rhi/validated/binding_checks-inl.hpp>
#include <pellucid/rhi/validated/copy_checks-inl.hpp>
#include <pellucid/rhi/validated/creation_checks-inl.hpp>
#include <pellucid/rhi/validated/pass_checks-inl.hpp>
#endif
