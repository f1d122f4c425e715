// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the handles of an OpenGL device name.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <pellucid/core/handle.hpp>
#include <pellucid/core/small_vector.hpp>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/opengl/hazards.hpp>
#include <pellucid/opengl/raster_state.hpp>
#include <pellucid/rhi/desc.hpp>

namespace pellucid::inline v0_1::opengl {

struct BufferObject {
    GLuint name = 0;
    std::uint64_t size = 0;  ///< [byte]
    rhi::BufferUsage usage = rhi::BufferUsage::none;
    std::byte* map = nullptr;  ///< upload and readback memory: for the buffer's whole life
    Touch touch = {};
};

struct TextureObject {
    GLuint name = 0;
    rhi::Format format = rhi::Format::undefined;
    rhi::TextureKind kind = rhi::TextureKind::flat;
    rhi::TextureUsage usage = rhi::TextureUsage::none;
    Extent2D size = {};
    std::uint32_t layers = 0, mips = 0;
    Touch touch = {};
};

struct SamplerObject {
    GLuint name = 0;
    GLuint nearest_name = 0;  ///< the same without filtering: what integer formats are complete with
};

struct PipelineObject {
    GLuint program = 0;
    GLenum topology = GL_TRIANGLES;
    const RasterState* raster = nullptr;  ///< shared by all pipelines with the same state; null: compute
};

/// One call of a group: consecutive binding numbers of one kind.
struct BindRun {
    rhi::BindingKind kind = rhi::BindingKind::storage_buffer;
    GLuint first = 0;
    std::uint8_t count = 0;
    std::uint8_t at = 0;  ///< first entry of the group's names
};
struct ImageBind {
    GLuint unit = 0, texture = 0;
    GLint mip = 0;
    GLboolean layered = GL_FALSE;
    GLenum format = GL_R32UI;
};
struct GroupObject {
    rhi::GroupSlot slot = rhi::GroupSlot::pass;
    SmallVector<BindRun, rhi::max_bindings> runs = {};
    SmallVector<ImageBind, rhi::max_bindings> images = {};
    GLuint names[rhi::max_bindings] = {};     ///< buffers or textures
    GLuint samplers[rhi::max_bindings] = {};  ///< beside textures
};

struct QueriesObject {
    rhi::QueryKind kind = rhi::QueryKind::timestamp;
    std::uint32_t count = 0;
    std::unique_ptr<GLuint[]> names;
};

struct Objects {
    SlotMap<rhi::BufferTag, BufferObject> buffers;
    SlotMap<rhi::TextureTag, TextureObject> textures;
    SlotMap<rhi::SamplerTag, SamplerObject> samplers;
    SlotMap<rhi::PipelineTag, PipelineObject> pipelines;
    SlotMap<rhi::GroupTag, GroupObject> groups;
    SlotMap<rhi::QueriesTag, QueriesObject> queries;
};

}  // namespace pellucid::inline v0_1::opengl
