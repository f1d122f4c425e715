// SPDX-License-Identifier: MIT
#include <pellucid/vulkan/device.hpp>
#include "convert.hpp"

namespace pellucid::inline v0_1::vulkan {
namespace {

/// The shader modules and specialisation constants of one pipeline; modules are destroyed with it.
class Stages {
public:
    explicit Stages(Context& context) : context_(context) {}
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;
    ~Stages() {
        for (std::uint32_t i = 0; i < count_; ++i)
            context_.vk.DestroyShaderModule(context_.device, stages_[i].module, nullptr);
    }

    [[nodiscard]] Result<void> constants(std::span<const rhi::SpecConstant> constants, const char* name) {
        if (constants.size() > max_constants)
            return Error{Errc::invalid_argument,
                         std::string("pipeline '") + name + "': " + std::to_string(constants.size()) +
                             " specialisation constants; at most " + std::to_string(max_constants) + " are possible"};
        for (const rhi::SpecConstant& constant : constants) {
            entries_[constant_count_] = {constant.id,
                                         static_cast<std::uint32_t>(constant_count_ * sizeof(std::uint32_t)),
                                         sizeof(std::uint32_t)};
            values_[constant_count_++] = constant.value;
        }
        specialization_ = {constant_count_, entries_, constant_count_ * sizeof(std::uint32_t), values_};
        return {};
    }

    [[nodiscard]] Result<void> add(const rhi::Shader* shader, rhi::ShaderStage stage, const char* name) {
        const auto wrong = [&](const std::string& what) {
            return Error{Errc::invalid_argument, std::string("pipeline '") + name + "': " + what};
        };
        constexpr const char* stage_names[] = {"vertex", "fragment", "compute"};
        const char* stage_name = stage_names[static_cast<int>(stage)];
        if (!shader) return wrong(std::string("its ") + stage_name + " shader is null");
        if (shader->stage != stage) return wrong(std::string(shader->name) + " is no " + stage_name + " shader");
        if (shader->spirv.empty()) return wrong(std::string(shader->name) + " was built without SPIR-V for Vulkan");
        VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        info.codeSize = shader->spirv.size_bytes();
        info.pCode = shader->spirv.data();
        VkPipelineShaderStageCreateInfo& out = stages_[count_];
        out = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        if (const VkResult r = context_.vk.CreateShaderModule(context_.device, &info, nullptr, &out.module))
            return context_.fail(r, "vkCreateShaderModule", shader->name);
        context_.set_name(VK_OBJECT_TYPE_SHADER_MODULE, out.module, shader->name);
        constexpr VkShaderStageFlagBits bits[] = {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT,
                                                  VK_SHADER_STAGE_COMPUTE_BIT};
        out.stage = bits[static_cast<int>(stage)];
        out.pName = "main";
        out.pSpecializationInfo = &specialization_;
        ++count_;
        return {};
    }

    [[nodiscard]] const VkPipelineShaderStageCreateInfo* data() const { return stages_; }
    [[nodiscard]] std::uint32_t count() const { return count_; }

private:
    static constexpr std::uint32_t max_constants = 32;
    Context& context_;
    VkPipelineShaderStageCreateInfo stages_[2] = {};
    std::uint32_t count_ = 0;
    VkSpecializationMapEntry entries_[max_constants] = {};
    std::uint32_t values_[max_constants] = {};
    std::uint32_t constant_count_ = 0;
    VkSpecializationInfo specialization_ = {};
};

/// Fills the layout part of the object, from the shapes of groups 1 and 2.
Result<void> find_layout(Context& c, const rhi::GroupLayout& pass, const rhi::GroupLayout& scene,
                         std::uint32_t push_bytes, const char* name, PipelineObject& object) {
    if (push_bytes > rhi::max_push_bytes || push_bytes % 16 != 0)
        return Error{Errc::invalid_argument, std::string("pipeline '") + name + "': push_bytes is " +
                                                 std::to_string(push_bytes) + "; a multiple of 16 up to " +
                                                 std::to_string(rhi::max_push_bytes) + " is possible"};
    PELLUCID_TRY(object.pass, c.set_layout(pass, false, name));
    PELLUCID_TRY(object.scene, c.set_layout(scene, false, name));
    PELLUCID_TRY(const PipelineLayout* const layout, c.pipeline_layout(object.pass, object.scene, name));
    object.layout = layout->handle;
    return {};
}

VkStencilOpState stencil_state(const rhi::StencilFace& face, const rhi::DepthStencil& depth) {
    return {to_vulkan(face.fail),    to_vulkan(face.pass),     to_vulkan(face.depth_fail), to_vulkan(face.compare),
            depth.stencil_read_mask, depth.stencil_write_mask, depth.stencil_reference};
}

VkPipelineColorBlendAttachmentState blend_state(const rhi::ColorTarget& target) {
    const rhi::Blend& b = target.blend;
    return {b.enabled ? VK_TRUE : VK_FALSE, to_vulkan(b.src_color),
            to_vulkan(b.dst_color),         to_vulkan(b.color_op),
            to_vulkan(b.src_alpha),         to_vulkan(b.dst_alpha),
            to_vulkan(b.alpha_op),          VkColorComponentFlags{target.write_mask}};  // bit 0 is red in both
}

}  // namespace

Result<rhi::Pipeline> Device::make_pipeline(const rhi::GraphicsPipelineDesc& desc) {
    Context& c = context_;
    Stages stages(c);
    PELLUCID_CHECK(stages.constants(desc.constants, desc.debug_name));
    PELLUCID_CHECK(stages.add(desc.vertex, rhi::ShaderStage::vertex, desc.debug_name));
    if (desc.fragment) PELLUCID_CHECK(stages.add(desc.fragment, rhi::ShaderStage::fragment, desc.debug_name));
    PipelineObject object;
    PELLUCID_CHECK(find_layout(c, desc.pass_group, desc.scene_group, desc.push_bytes, desc.debug_name, object));
    object.stencil = desc.depth.stencil_test;
    object.stencil_reference = desc.depth.stencil_reference;

    VkPipelineVertexInputStateCreateInfo vertices = {VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly = {VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = to_vulkan(desc.topology);
    VkPipelineViewportStateCreateInfo viewport = {VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster = {VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.depthClampEnable = desc.depth_clamp;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = to_vulkan(desc.cull);
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples = {VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth = {VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = desc.depth.test || desc.depth.write;
    depth.depthWriteEnable = desc.depth.write;
    depth.depthCompareOp = desc.depth.test ? to_vulkan(desc.depth.compare) : VK_COMPARE_OP_ALWAYS;
    depth.stencilTestEnable = desc.depth.stencil_test;
    depth.front = stencil_state(desc.depth.front, desc.depth);
    depth.back = stencil_state(desc.depth.back, desc.depth);
    VkPipelineColorBlendAttachmentState targets[rhi::max_color_attachments] = {};
    VkFormat formats[rhi::max_color_attachments] = {};
    std::uint32_t count = 0;
    for (const rhi::ColorTarget& target : desc.colors) {
        if (target.blend.enabled && !rhi::info(target.format).blendable)
            return Error{Errc::invalid_argument, std::string("pipeline '") + desc.debug_name + "', colour " +
                                                     std::to_string(count) + ": the format " +
                                                     rhi::info(target.format).name + " cannot be blended"};
        formats[count] = to_vulkan(target.format);
        targets[count++] = blend_state(target);
    }
    VkPipelineColorBlendStateCreateInfo blend = {VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = count;
    blend.pAttachments = targets;
    constexpr VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                                 VK_DYNAMIC_STATE_STENCIL_REFERENCE};
    VkPipelineDynamicStateCreateInfo dynamic = {VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = desc.depth.stencil_test ? 3 : 2;
    dynamic.pDynamicStates = dynamic_states;
    VkPipelineRenderingCreateInfo rendering = {VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = count;
    rendering.pColorAttachmentFormats = formats;
    rendering.depthAttachmentFormat = to_vulkan(desc.depth.format);
    if (rhi::info(desc.depth.format).stencil) rendering.stencilAttachmentFormat = rendering.depthAttachmentFormat;

    VkGraphicsPipelineCreateInfo info = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = stages.count();
    info.pStages = stages.data();
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = object.layout;
    if (const VkResult r = c.vk.CreateGraphicsPipelines(c.device, c.pipeline_cache, 1, &info, nullptr, &object.handle))
        return c.fail(r, "vkCreateGraphicsPipelines", desc.debug_name);
    c.set_name(VK_OBJECT_TYPE_PIPELINE, object.handle, desc.debug_name);
    c.pipelines_made = true;
    return c.pipelines.insert(object);
}

Result<rhi::Pipeline> Device::make_pipeline(const rhi::ComputePipelineDesc& desc) {
    Context& c = context_;
    Stages stages(c);
    PELLUCID_CHECK(stages.constants(desc.constants, desc.debug_name));
    PELLUCID_CHECK(stages.add(desc.compute, rhi::ShaderStage::compute, desc.debug_name));
    PipelineObject object;
    object.point = VK_PIPELINE_BIND_POINT_COMPUTE;
    PELLUCID_CHECK(find_layout(c, desc.pass_group, desc.scene_group, desc.push_bytes, desc.debug_name, object));
    VkComputePipelineCreateInfo info = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = *stages.data();
    info.layout = object.layout;
    if (const VkResult r = c.vk.CreateComputePipelines(c.device, c.pipeline_cache, 1, &info, nullptr, &object.handle))
        return c.fail(r, "vkCreateComputePipelines", desc.debug_name);
    c.set_name(VK_OBJECT_TYPE_PIPELINE, object.handle, desc.debug_name);
    c.pipelines_made = true;
    return c.pipelines.insert(object);
}

void Device::destroy(rhi::Pipeline pipeline) {
    if (alive(pipeline)) context_.retire(VK_OBJECT_TYPE_PIPELINE, context_.pipelines.erase(pipeline).handle);
}

}  // namespace pellucid::inline v0_1::vulkan
