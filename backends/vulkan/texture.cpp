// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <pellucid/vulkan/device.hpp>
#include "convert.hpp"

namespace pellucid::inline v0_1::vulkan {
namespace {

using rhi::TextureUsage;

VkImageUsageFlags to_usage(const rhi::TextureDesc& desc) {
    const bool depth = rhi::info(desc.format).depth;
    VkImageUsageFlags flags = 0;
    if (has(desc.usage, TextureUsage::sampled)) flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (has(desc.usage, TextureUsage::storage)) flags |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (has(desc.usage, TextureUsage::attachment))
        flags |= depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (has(desc.usage, TextureUsage::copy_source)) flags |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (has(desc.usage, TextureUsage::copy_destination) || !desc.initial.empty())
        flags |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return flags;
}

std::uint64_t content_bytes(const rhi::TextureDesc& desc) {
    std::uint64_t texels = 0;
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip)
        texels += std::uint64_t{std::max(desc.size.width >> mip, 1u)} * std::max(desc.size.height >> mip, 1u);
    return texels * desc.layers * rhi::info(desc.format).bytes;
}

/// What is wrong with the description by itself; empty where nothing is.
std::string fault(const rhi::TextureDesc& desc) {
    const auto [width, height] = desc.size;
    if (desc.format == rhi::Format::undefined || desc.format >= rhi::Format::count) return "its format is undefined";
    if (width == 0 || height == 0) return "its size is " + std::to_string(width) + "x" + std::to_string(height);
    const auto levels = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
    if (desc.mips == 0 || desc.mips > levels)
        return std::to_string(desc.mips) + " mips; its size has 1 to " + std::to_string(levels);
    if (desc.layers == 0) return "0 layers; give at least 1";
    if (desc.kind == rhi::TextureKind::flat && desc.layers != 1)
        return std::to_string(desc.layers) + " layers; a flat texture has 1, use TextureKind::array";
    if (desc.kind == rhi::TextureKind::cube && (desc.layers != 6 || width != height))
        return "a cube has 6 square layers, not " + std::to_string(desc.layers) + " of " + std::to_string(width) + "x" +
               std::to_string(height);
    if (has(desc.usage, TextureUsage::storage) && !rhi::info(desc.format).storage)
        return std::string("the format ") + rhi::info(desc.format).name + " cannot be a storage image";
    if (desc.usage == TextureUsage::none) return "its usage is empty";
    if (!desc.initial.empty() && desc.initial.size() != content_bytes(desc))
        return std::to_string(desc.initial.size()) + " bytes of initial data; all texels have " +
               std::to_string(content_bytes(desc));
    return {};
}

Result<void> supported(const Context& c, const rhi::TextureDesc& desc, const VkImageCreateInfo& info) {
    VkImageFormatProperties limits = {};
    const VkResult r = c.instance->vk.GetPhysicalDeviceImageFormatProperties(
        c.physical, info.format, info.imageType, info.tiling, info.usage, info.flags, &limits);
    const std::string what = std::string("texture '") + desc.debug_name + "' of format " + rhi::info(desc.format).name;
    if (r == VK_ERROR_FORMAT_NOT_SUPPORTED)
        return Error{Errc::unsupported, what + ": this device has it not for this usage"};
    if (r != VK_SUCCESS) return api_error(r, "vkGetPhysicalDeviceImageFormatProperties", desc.debug_name);
    if (desc.size.width > limits.maxExtent.width || desc.size.height > limits.maxExtent.height)
        return Error{Errc::unsupported, what + ": " + std::to_string(desc.size.width) + "x" +
                                            std::to_string(desc.size.height) + " texels; this device has at most " +
                                            std::to_string(limits.maxExtent.width) + "x" +
                                            std::to_string(limits.maxExtent.height)};
    if (desc.layers > limits.maxArrayLayers)
        return Error{Errc::unsupported, what + ": " + std::to_string(desc.layers) +
                                            " layers; this device has at most " +
                                            std::to_string(limits.maxArrayLayers)};
    return {};
}

Result<VkImageView> make_view(Context& c, const TextureObject& texture, VkImageViewType type, VkImageAspectFlags aspect,
                              VkImageUsageFlags usage, VkImageSubresourceRange range, const char* name) {
    VkImageViewUsageCreateInfo as = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO, nullptr, usage};
    VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.pNext = &as;
    info.image = texture.handle;
    info.viewType = type;
    info.format = to_vulkan(texture.format);
    info.subresourceRange = range;
    info.subresourceRange.aspectMask = aspect;
    VkImageView view = VK_NULL_HANDLE;
    if (const VkResult r = c.vk.CreateImageView(c.device, &info, nullptr, &view))
        return c.fail(r, "vkCreateImageView", name);
    c.set_name(VK_OBJECT_TYPE_IMAGE_VIEW, view, name);
    return view;
}

Result<void> make_views(Context& c, TextureObject& texture, const rhi::TextureDesc& desc) {
    const VkImageViewType seen = desc.kind == rhi::TextureKind::flat    ? VK_IMAGE_VIEW_TYPE_2D
                                 : desc.kind == rhi::TextureKind::array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                                        : VK_IMAGE_VIEW_TYPE_CUBE;
    if (has(desc.usage, TextureUsage::sampled)) {
        PELLUCID_TRY(texture.sampled,
                     make_view(c, texture, seen, readable_aspect(desc.format), VK_IMAGE_USAGE_SAMPLED_BIT,
                               {0, 0, texture.mips, 0, texture.layers}, desc.debug_name));
    }
    if (has(desc.usage, TextureUsage::storage)) {
        for (std::uint32_t mip = 0; mip < texture.mips; ++mip) {
            PELLUCID_TRY(const VkImageView view,
                         make_view(c, texture, seen, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_USAGE_STORAGE_BIT,
                                   {0, mip, 1, 0, texture.layers}, desc.debug_name));
            texture.storage.push_back(view);
        }
    }
    if (has(desc.usage, TextureUsage::attachment)) {
        const VkImageUsageFlags usage = rhi::info(desc.format).depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                                     : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        for (std::uint32_t mip = 0; mip < texture.mips; ++mip) {
            for (std::uint32_t layer = 0; layer < texture.layers; ++layer) {
                PELLUCID_TRY(const VkImageView view, make_view(c, texture, VK_IMAGE_VIEW_TYPE_2D, texture.aspects,
                                                               usage, {0, mip, 1, layer, 1}, desc.debug_name));
                texture.attachment.push_back(view);
            }
        }
    }
    return {};
}

Result<void> make_image(Context& c, TextureObject& texture, const VkImageCreateInfo& info, const char* name) {
    if (const VkResult r = c.vk.CreateImage(c.device, &info, nullptr, &texture.handle))
        return c.fail(r, "vkCreateImage", name);
    c.set_name(VK_OBJECT_TYPE_IMAGE, texture.handle, name);
    VkMemoryDedicatedRequirements dedicated = {VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 requirements = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, &dedicated, {}};
    const VkImageMemoryRequirementsInfo2 of = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2, nullptr,
                                               texture.handle};
    c.vk.GetImageMemoryRequirements2(c.device, &of, &requirements);
    VkMemoryDedicatedAllocateInfo own = {VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
    own.image = texture.handle;
    MemoryRequest request;
    request.requirements = requirements.memoryRequirements;
    request.linear = false;
    request.debug_name = name;
    if (dedicated.prefersDedicatedAllocation || dedicated.requiresDedicatedAllocation) request.dedicated = &own;
    PELLUCID_TRY(texture.memory, c.allocate(request));
    if (const VkResult r = c.vk.BindImageMemory(c.device, texture.handle, texture.memory.memory, texture.memory.offset))
        return c.fail(r, "vkBindImageMemory", name);
    return {};
}

void retire(Context& c, const TextureObject& texture) {
    c.retire(VK_OBJECT_TYPE_IMAGE_VIEW, texture.sampled);
    for (VkImageView view : texture.storage) c.retire(VK_OBJECT_TYPE_IMAGE_VIEW, view);
    for (VkImageView view : texture.attachment) c.retire(VK_OBJECT_TYPE_IMAGE_VIEW, view);
    c.retire(VK_OBJECT_TYPE_IMAGE, texture.handle, texture.memory);
}

}  // namespace

Result<rhi::Texture> Device::make_texture(const rhi::TextureDesc& desc) {
    Context& c = context_;
    if (const std::string wrong = fault(desc); !wrong.empty())
        return Error{Errc::invalid_argument, std::string("texture '") + desc.debug_name + "': " + wrong};
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = desc.kind == rhi::TextureKind::cube ? VkImageCreateFlags{VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT} : 0u;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = to_vulkan(desc.format);
    info.extent = {desc.size.width, desc.size.height, 1};
    info.mipLevels = desc.mips;
    info.arrayLayers = desc.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = to_usage(desc);
    PELLUCID_CHECK(supported(c, desc, info));

    TextureObject texture;
    texture.size = desc.size;
    texture.layers = desc.layers;
    texture.mips = desc.mips;
    texture.format = desc.format;
    texture.aspects = aspects(desc.format);
    Result<void> made = make_image(c, texture, info, desc.debug_name);
    if (made) made = make_views(c, texture, desc);
    if (made && !desc.initial.empty()) made = c.upload_texture(texture, desc.initial);
    if (!made) {
        retire(c, texture);
        return made.error();
    }
    return c.textures.insert(std::move(texture));
}

void Device::destroy(rhi::Texture texture) {
    if (alive(texture)) retire(context_, context_.textures.erase(texture));
}

Result<rhi::Sampler> Device::make_sampler(const rhi::SamplerDesc& desc) {
    Context& c = context_;
    VkSamplerCreateInfo info = {VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = to_vulkan(desc.mag);
    info.minFilter = to_vulkan(desc.min);
    info.mipmapMode = desc.mip == rhi::Filter::linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = to_vulkan(desc.wrap_u);
    info.addressModeV = to_vulkan(desc.wrap_v);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    SamplerObject object;
    if (desc.mipmapped) {
        info.maxLod = VK_LOD_CLAMP_NONE;
        if (const VkResult r = c.vk.CreateSampler(c.device, &info, nullptr, &object.mipmapped))
            return c.fail(r, "vkCreateSampler", desc.debug_name);
        c.set_name(VK_OBJECT_TYPE_SAMPLER, object.mipmapped, desc.debug_name);
    }
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    // Level 0 only: not 0, or every sample would count as magnified and `min` would never be used.
    info.maxLod = 0.25f;
    if (const VkResult r = c.vk.CreateSampler(c.device, &info, nullptr, &object.one_level)) {
        c.retire(VK_OBJECT_TYPE_SAMPLER, object.mipmapped);
        return c.fail(r, "vkCreateSampler", desc.debug_name);
    }
    c.set_name(VK_OBJECT_TYPE_SAMPLER, object.one_level, desc.debug_name);
    return c.samplers.insert(object);
}

void Device::destroy(rhi::Sampler sampler) {
    if (!alive(sampler)) return;
    const SamplerObject object = context_.samplers.erase(sampler);
    context_.retire(VK_OBJECT_TYPE_SAMPLER, object.mipmapped);
    context_.retire(VK_OBJECT_TYPE_SAMPLER, object.one_level);
}

}  // namespace pellucid::inline v0_1::vulkan
