// SPDX-License-Identifier: MIT
// Pipelines and groups.
#include <algorithm>

#include "formats.hpp"
#include "pellucid/opengl/device.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

Error wrong_pipeline(const char* debug_name, const std::string& what) {
    return {Errc::invalid_argument, text("The pipeline '%s' %s", debug_name, what.c_str())};
}

Result<void> check_push(const char* debug_name, std::uint32_t bytes) {
    if (bytes % 16 == 0 && bytes <= rhi::max_push_bytes) return {};
    return wrong_pipeline(debug_name, text("has a push block of %u bytes; it must be a multiple of 16 up to %zu", bytes,
                                           rhi::max_push_bytes));
}

Result<void> check(const rhi::GraphicsPipelineDesc& desc) {
    if (!desc.vertex || desc.vertex->stage != rhi::ShaderStage::vertex)
        return wrong_pipeline(desc.debug_name, "has no vertex shader");
    if (desc.fragment && desc.fragment->stage != rhi::ShaderStage::fragment)
        return wrong_pipeline(desc.debug_name, text("has '%s' as fragment shader, which is none", desc.fragment->name));
    for (std::size_t i = 0; i < desc.colors.size(); ++i) {
        const auto& format = rhi::info(desc.colors[i].format);
        if (format.depth || format.channels == 0)
            return wrong_pipeline(desc.debug_name, text("has the format %s as colour target %zu", format.name, i));
        if (desc.colors[i].blend.enabled && !format.blendable)
            return wrong_pipeline(desc.debug_name, text("blends into colour target %zu, whose format %s cannot be "
                                                        "blended",
                                                        i, format.name));
    }
    const auto& depth = rhi::info(desc.depth.format);
    if ((desc.depth.test || desc.depth.write) && !depth.depth)
        return wrong_pipeline(desc.debug_name, "tests or writes depth without a depth format");
    if (desc.depth.stencil_test && !depth.stencil)
        return wrong_pipeline(desc.debug_name, "tests stencil without a stencil format");
    return check_push(desc.debug_name, desc.push_bytes);
}

const char* name(rhi::BindingKind kind) {
    constexpr const char* names[] = {"uniform buffer", "storage buffer", "sampled texture", "storage texture"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace

const RasterState* Device::share(const RasterState& state) {
    for (const RasterState& known : rasters_)
        if (known == state) return &known;
    return &rasters_.emplace_back(state);
}

Result<rhi::Pipeline> Device::make_pipeline(const rhi::GraphicsPipelineDesc& desc) {
    PELLUCID_CHECK(enter());
    PELLUCID_CHECK(check(desc));
    const rhi::Shader* shaders[] = {desc.vertex, desc.fragment};
    PELLUCID_TRY(const GLuint program,
                 make_program({shaders, desc.fragment ? 2u : 1u}, desc.constants, desc.debug_name));
    constexpr GLenum topologies[] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_LINES, GL_POINTS};
    return objects_.pipelines.insert({.program = program,
                                      .topology = topologies[static_cast<std::size_t>(desc.topology)],
                                      .raster = share(raster_state(desc))});
}

Result<rhi::Pipeline> Device::make_pipeline(const rhi::ComputePipelineDesc& desc) {
    PELLUCID_CHECK(enter());
    if (!desc.compute || desc.compute->stage != rhi::ShaderStage::compute)
        return wrong_pipeline(desc.debug_name, "has no compute shader");
    PELLUCID_CHECK(check_push(desc.debug_name, desc.push_bytes));
    PELLUCID_TRY(const GLuint program, make_program({&desc.compute, 1}, desc.constants, desc.debug_name));
    return objects_.pipelines.insert({.program = program});
}

void Device::destroy(rhi::Pipeline pipeline) {
    if (!alive(pipeline)) return;
    context_->enter();
    commands_.forget_program();
    glDeleteProgram(objects_.pipelines.erase(pipeline).program);
}

Result<rhi::Group> Device::make_group(const rhi::GroupDesc& desc) {
    PELLUCID_CHECK(enter());
    auto wrong = [&](const std::string& what) {
        return Error{Errc::invalid_argument, text("The group '%s' %s", desc.debug_name, what.c_str())};
    };
    if (desc.slot == rhi::GroupSlot::frame) return wrong("takes slot 0, which belongs to the device: use bind_frame");
    if (desc.bindings.size() != desc.layout.bindings.size())
        return wrong(text("fills %zu bindings of a layout of %zu", desc.bindings.size(), desc.layout.bindings.size()));

    SmallVector<rhi::BindingLayout, rhi::max_bindings> sorted = desc.layout.bindings;
    std::sort(sorted.begin(), sorted.end(), [](rhi::BindingLayout a, rhi::BindingLayout b) {
        return a.kind != b.kind ? a.kind < b.kind : a.binding < b.binding;
    });
    GroupObject made{.slot = desc.slot};
    for (std::uint8_t i = 0; i < sorted.size(); ++i) {
        const auto [binding, kind] = sorted[i];
        const rhi::Binding* given = nullptr;
        for (const rhi::Binding& b : desc.bindings)
            if (b.binding == binding) given = &b;
        if (!given) return wrong(text("leaves binding %u, a %s, empty", binding, name(kind)));

        if (kind == rhi::BindingKind::uniform_buffer || kind == rhi::BindingKind::storage_buffer) {
            const BufferObject* buffer = objects_.buffers.find(given->buffer);
            if (!buffer) return wrong(text("has no living buffer at binding %u", binding));
            if (kind == rhi::BindingKind::storage_buffer && buffer->size > info_.max_storage_buffer_bytes)
                return Error{Errc::unsupported,
                             text("The group '%s' has a buffer of %llu bytes at binding %u; %s takes at most %llu in a "
                                  "storage block",
                                  desc.debug_name, static_cast<unsigned long long>(buffer->size), binding,
                                  info_.name.c_str(), static_cast<unsigned long long>(info_.max_storage_buffer_bytes))};
            made.names[i] = buffer->name;
        } else {
            const TextureObject* texture = objects_.textures.find(given->texture);
            if (!texture) return wrong(text("has no living texture at binding %u", binding));
            if (kind == rhi::BindingKind::storage_texture) {
                if (given->mip >= texture->mips)
                    return wrong(text("binds level %u at binding %u of a texture of %u levels", given->mip, binding,
                                      texture->mips));
                if (!has(texture->usage, rhi::TextureUsage::storage))
                    return wrong(text("binds a texture without the usage storage at binding %u", binding));
                made.images.push_back({.unit = binding,
                                       .texture = texture->name,
                                       .mip = static_cast<GLint>(given->mip),
                                       .layered = texture->kind != rhi::TextureKind::flat,
                                       .format = gl_format(texture->format).internal});
                continue;
            }
            const SamplerObject* sampler = objects_.samplers.find(given->sampler);
            if (!sampler) return wrong(text("has no living sampler at binding %u", binding));
            made.names[i] = texture->name;
            // An integer texture under a filtering sampler is incomplete in OpenGL: even texelFetch would read nothing.
            made.samplers[i] =
                rhi::info(texture->format).kind == rhi::NumericKind::uint ? sampler->nearest_name : sampler->name;
        }
        BindRun* last = made.runs.empty() ? nullptr : &made.runs[made.runs.size() - 1];
        if (last && last->kind == kind && last->first + last->count == binding)
            ++last->count;
        else
            made.runs.push_back({.kind = kind, .first = binding, .count = 1, .at = i});
    }
    return objects_.groups.insert(made);
}

void Device::destroy(rhi::Group group) {
    if (!alive(group)) return;
    commands_.forget_groups();
    objects_.groups.erase(group);
}

}  // namespace pellucid::inline v0_1::opengl
