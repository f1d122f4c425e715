// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The RHI's enumerations in Vulkan's words.
#include <vulkan/vulkan_core.h>
#include <pellucid/rhi/desc.hpp>

namespace pellucid::inline v0_1::vulkan {

[[nodiscard]] constexpr VkFormat to_vulkan(rhi::Format format) {
    constexpr VkFormat table[] = {VK_FORMAT_UNDEFINED,           VK_FORMAT_R8_UNORM,   VK_FORMAT_R8G8B8A8_UNORM,
                                  VK_FORMAT_R8G8B8A8_SRGB,       VK_FORMAT_R32_UINT,   VK_FORMAT_R32G32_UINT,
                                  VK_FORMAT_R32G32B32A32_UINT,   VK_FORMAT_R16_SFLOAT, VK_FORMAT_R16G16_SFLOAT,
                                  VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                  VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT};
    static_assert(sizeof table / sizeof table[0] == static_cast<std::size_t>(rhi::Format::count));
    return table[static_cast<std::size_t>(format)];
}
[[nodiscard]] constexpr VkImageAspectFlags aspects(rhi::Format format) {
    const rhi::FormatInfo& f = rhi::info(format);
    if (!f.depth) return VK_IMAGE_ASPECT_COLOR_BIT;
    return VK_IMAGE_ASPECT_DEPTH_BIT | (f.stencil ? VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT} : 0u);
}
/// What copies and samplers see: the depth of a depth-stencil format.
[[nodiscard]] constexpr VkImageAspectFlags readable_aspect(rhi::Format format) {
    return rhi::info(format).depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}
// The two enumerations count alike.
[[nodiscard]] constexpr VkCompareOp to_vulkan(rhi::Compare compare) {
    static_assert(static_cast<int>(rhi::Compare::always) == VK_COMPARE_OP_ALWAYS &&
                  static_cast<int>(rhi::Compare::greater) == VK_COMPARE_OP_GREATER);
    return static_cast<VkCompareOp>(compare);
}
[[nodiscard]] constexpr VkStencilOp to_vulkan(rhi::StencilFace::Op op) {
    static_assert(static_cast<int>(rhi::StencilFace::Op::invert) == VK_STENCIL_OP_INVERT &&
                  static_cast<int>(rhi::StencilFace::Op::decrement_wrap) == VK_STENCIL_OP_DECREMENT_AND_WRAP);
    return static_cast<VkStencilOp>(op);
}
[[nodiscard]] constexpr VkCullModeFlags to_vulkan(rhi::Cull cull) {
    return cull == rhi::Cull::none   ? VkCullModeFlags{VK_CULL_MODE_NONE}
           : cull == rhi::Cull::back ? VkCullModeFlags{VK_CULL_MODE_BACK_BIT}
                                     : VkCullModeFlags{VK_CULL_MODE_FRONT_BIT};
}
[[nodiscard]] constexpr VkBlendFactor to_vulkan(rhi::BlendFactor factor) {
    constexpr VkBlendFactor table[] = {VK_BLEND_FACTOR_ZERO,      VK_BLEND_FACTOR_ONE,
                                       VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                       VK_BLEND_FACTOR_DST_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA,
                                       VK_BLEND_FACTOR_SRC_COLOR, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR,
                                       VK_BLEND_FACTOR_DST_COLOR};
    return table[static_cast<std::size_t>(factor)];
}
[[nodiscard]] constexpr VkBlendOp to_vulkan(rhi::BlendOp op) {
    constexpr VkBlendOp table[] = {VK_BLEND_OP_ADD, VK_BLEND_OP_MIN, VK_BLEND_OP_MAX, VK_BLEND_OP_REVERSE_SUBTRACT};
    return table[static_cast<std::size_t>(op)];
}
[[nodiscard]] constexpr VkPrimitiveTopology to_vulkan(rhi::Topology topology) {
    constexpr VkPrimitiveTopology table[] = {VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                             VK_PRIMITIVE_TOPOLOGY_LINE_LIST, VK_PRIMITIVE_TOPOLOGY_POINT_LIST};
    return table[static_cast<std::size_t>(topology)];
}
[[nodiscard]] constexpr VkFilter to_vulkan(rhi::Filter filter) {
    return filter == rhi::Filter::nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
}
[[nodiscard]] constexpr VkSamplerAddressMode to_vulkan(rhi::Wrap wrap) {
    constexpr VkSamplerAddressMode table[] = {VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                                              VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    return table[static_cast<std::size_t>(wrap)];
}
[[nodiscard]] constexpr VkDescriptorType to_vulkan(rhi::BindingKind kind) {
    constexpr VkDescriptorType table[] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                          VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    return table[static_cast<std::size_t>(kind)];
}

}  // namespace pellucid::inline v0_1::vulkan
