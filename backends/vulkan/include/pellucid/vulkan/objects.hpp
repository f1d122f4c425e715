// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the handles of the RHI stand for.
#include <vulkan/vulkan_core.h>
#include <cstdint>
#include <pellucid/rhi/desc.hpp>
#include <pellucid/vulkan/memory.hpp>
#include <vector>

namespace pellucid::inline v0_1::vulkan {

/// What the GPU last did with a buffer or a texture (all its levels and layers), in the order of submission: the last
/// write (or layout change), and the reads after it that see it already.
struct Sync {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< textures only
    VkPipelineStageFlags2 write_stages = 0;
    VkAccessFlags2 write_access = 0;
    VkPipelineStageFlags2 read_stages = 0;
    VkAccessFlags2 read_access = 0;
};

struct BufferObject {
    VkBuffer handle = VK_NULL_HANDLE;
    Allocation memory;
    std::uint64_t size = 0;  ///< [byte]
    rhi::Memory kind = rhi::Memory::device;
    Sync sync;
};

struct TextureObject {
    VkImage handle = VK_NULL_HANDLE;
    Allocation memory;
    VkImageView sampled = VK_NULL_HANDLE;  ///< all levels and layers, as the shader sees them; depth aspect of depth
    std::vector<VkImageView> storage;      ///< [mip] all layers
    std::vector<VkImageView> attachment;   ///< [mip * layers + layer]
    Extent2D size;
    std::uint32_t layers = 1, mips = 1;
    rhi::Format format = rhi::Format::undefined;
    VkImageAspectFlags aspects = VK_IMAGE_ASPECT_COLOR_BIT;
    Sync sync;

    [[nodiscard]] VkImageView target(std::uint32_t mip, std::uint32_t layer) const {
        return attachment[mip * layers + layer];
    }
    [[nodiscard]] VkExtent3D extent(std::uint32_t mip) const {
        const auto at = [mip](std::uint32_t full) { return full >> mip ? full >> mip : 1u; };
        return {at(size.width), at(size.height), 1};
    }
    /// The layout in which it is sampled.  That of depth-stencil keeps the stencil writable, so one pass may sample the
    /// depth, test against it and write the stencil.
    [[nodiscard]] VkImageLayout sampled_layout() const {
        if (aspects & VK_IMAGE_ASPECT_STENCIL_BIT) return VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL;
        if (aspects & VK_IMAGE_ASPECT_DEPTH_BIT) return VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    }
};

/// Textures with one level use a sampler of their own: the same values, but a linear filter between levels is not even
/// allowed for depth and integers, though there is nothing to filter.
struct SamplerObject {
    VkSampler mipmapped = VK_NULL_HANDLE;  ///< null where the description asks for level 0 only
    VkSampler one_level = VK_NULL_HANDLE;

    [[nodiscard]] VkSampler of(const TextureObject& texture) const {
        return mipmapped && texture.mips > 1 ? mipmapped : one_level;
    }
};

/// Where a descriptor set came from, to give it back.
struct DescriptorSet {
    VkDescriptorSet handle = VK_NULL_HANDLE;
    std::uint32_t layout = 0;  ///< index into Context::set_layouts
    std::uint32_t pool = 0;    ///< index into its pools
};

struct GroupObject {
    DescriptorSet set;
    rhi::GroupSlot slot = rhi::GroupSlot::pass;
};

/// One shape of a group, shared by all that are equal, and the pools its sets come from.
struct SetLayout {
    rhi::GroupLayout shape;
    bool frame = false;  ///< group 0: its uniform buffer has a dynamic offset
    VkDescriptorSetLayout handle = VK_NULL_HANDLE;
    struct Pool {
        VkDescriptorPool handle = VK_NULL_HANDLE;
        std::uint32_t free = 0;  ///< sets
    };
    std::vector<Pool> pools;
};

struct PipelineLayout {
    std::uint32_t pass = 0, scene = 0;  ///< set layouts of groups 1 and 2
    VkPipelineLayout handle = VK_NULL_HANDLE;
};

struct PipelineObject {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::uint32_t pass = 0, scene = 0;  ///< set layouts of groups 1 and 2
    VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_GRAPHICS;
    bool stencil = false;
    std::uint8_t stencil_reference = 0;
};

struct QueriesObject {
    VkQueryPool handle = VK_NULL_HANDLE;
    std::uint32_t count = 0;
    rhi::QueryKind kind = rhi::QueryKind::timestamp;
};

}  // namespace pellucid::inline v0_1::vulkan
