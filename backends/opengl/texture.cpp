// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "formats.hpp"
#include "pellucid/opengl/device.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

std::uint64_t all_texels_bytes(const rhi::TextureDesc& desc) {
    std::uint64_t bytes = 0;
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip)
        bytes += std::uint64_t{std::max(desc.size.width >> mip, 1u)} * std::max(desc.size.height >> mip, 1u);
    return bytes * desc.layers * rhi::info(desc.format).bytes;
}

/// The sentence about what is wrong with `desc`, if anything is.
Result<void> check(const rhi::TextureDesc& desc, const rhi::DeviceInfo& limits) {
    auto wrong = [&](const std::string& what, Errc code = Errc::invalid_argument) {
        return Error{code, text("The texture '%s' %s", desc.debug_name, what.c_str())};
    };
    const auto& format = rhi::info(desc.format);
    const auto [width, height] = desc.size;
    if (desc.format == rhi::Format::undefined) return wrong("has no format");
    if (width == 0 || height == 0 || desc.layers == 0 || desc.mips == 0)
        return wrong(text("has %u×%u texels, %u layers and %u levels; each must be at least 1", width, height,
                          desc.layers, desc.mips));
    if (std::max(width, height) > limits.max_texture_size)
        return wrong(text("has %u×%u texels; %s takes at most %u a side", width, height, limits.name.c_str(),
                          limits.max_texture_size),
                     Errc::unsupported);
    if (desc.layers > limits.max_array_layers)
        return wrong(
            text("has %u layers; %s takes at most %u", desc.layers, limits.name.c_str(), limits.max_array_layers),
            Errc::unsupported);
    const auto max_mips = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
    if (desc.mips > max_mips)
        return wrong(text("has %u levels; %u×%u texels have at most %u", desc.mips, width, height, max_mips));
    if (desc.kind == rhi::TextureKind::flat && desc.layers != 1)
        return wrong(text("is flat and has %u layers; make it an array", desc.layers));
    if (desc.kind == rhi::TextureKind::cube && (desc.layers != 6 || width != height))
        return wrong(
            text("is a cube of %u layers and %u×%u texels; it needs 6 square ones", desc.layers, width, height));
    if (has(desc.usage, rhi::TextureUsage::storage) && !format.storage)
        return wrong(text("is for storage; the format %s cannot be stored to by shaders", format.name));
    if (!desc.initial.empty() && desc.initial.size() != all_texels_bytes(desc))
        return wrong(text("gets %zu initial bytes; all its levels and layers have %llu", desc.initial.size(),
                          static_cast<unsigned long long>(all_texels_bytes(desc))));
    return {};
}

void fill_texture(GLuint name, const rhi::TextureDesc& desc) {
    const GlFormat format = gl_format(desc.format);
    const std::byte* at = desc.initial.data();
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
        const auto width = static_cast<GLsizei>(std::max(desc.size.width >> mip, 1u));
        const auto height = static_cast<GLsizei>(std::max(desc.size.height >> mip, 1u));
        if (desc.kind == rhi::TextureKind::flat)
            glTextureSubImage2D(name, static_cast<GLint>(mip), 0, 0, width, height, format.transfer, format.type, at);
        else
            glTextureSubImage3D(name, static_cast<GLint>(mip), 0, 0, 0, width, height,
                                static_cast<GLsizei>(desc.layers), format.transfer, format.type, at);
        at += std::size_t{desc.layers} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
              rhi::info(desc.format).bytes;
    }
}

GLint gl(rhi::Wrap wrap) {
    constexpr GLint table[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
    return table[static_cast<std::size_t>(wrap)];
}

GLuint make_sampler_object(const rhi::SamplerDesc& desc) {
    GLuint name = 0;
    glCreateSamplers(1, &name);
    const bool linear = desc.min == rhi::Filter::linear;
    GLint min = linear ? GL_LINEAR : GL_NEAREST;
    if (desc.mipmapped && desc.mip == rhi::Filter::linear)
        min = linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    else if (desc.mipmapped)
        min = linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, min);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, desc.mag == rhi::Filter::linear ? GL_LINEAR : GL_NEAREST);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, gl(desc.wrap_u));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, gl(desc.wrap_v));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    return name;
}

}  // namespace

Result<rhi::Texture> Device::make_texture(const rhi::TextureDesc& desc) {
    PELLUCID_CHECK(enter());
    PELLUCID_CHECK(check(desc, info_));
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) continue;  // old errors are not ours
    constexpr GLenum targets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP};
    TextureObject made{.format = desc.format,
                       .kind = desc.kind,
                       .usage = desc.usage,
                       .size = desc.size,
                       .layers = desc.layers,
                       .mips = desc.mips};
    glCreateTextures(targets[static_cast<std::size_t>(desc.kind)], 1, &made.name);
    const auto mips = static_cast<GLsizei>(desc.mips);
    const auto width = static_cast<GLsizei>(desc.size.width), height = static_cast<GLsizei>(desc.size.height);
    if (desc.kind == rhi::TextureKind::array)
        glTextureStorage3D(made.name, mips, gl_format(desc.format).internal, width, height,
                           static_cast<GLsizei>(desc.layers));
    else
        glTextureStorage2D(made.name, mips, gl_format(desc.format).internal, width, height);
    if (glGetError() != GL_NO_ERROR) {
        glDeleteTextures(1, &made.name);
        return Error{Errc::out_of_memory,
                     text("No memory for the texture '%s' of %u×%u texels, %u layers, %s (%llu bytes)", desc.debug_name,
                          desc.size.width, desc.size.height, desc.layers, rhi::info(desc.format).name,
                          static_cast<unsigned long long>(all_texels_bytes(desc)))};
    }
    if (!desc.initial.empty()) {
        commands_.end_transfers();
        fill_texture(made.name, desc);
    }
    label(GL_TEXTURE, made.name, desc.debug_name);
    return objects_.textures.insert(made);
}

void Device::destroy(rhi::Texture texture) {
    if (!alive(texture)) return;
    context_->enter();
    commands_.forget(texture);
    const TextureObject object = objects_.textures.erase(texture);
    glDeleteTextures(1, &object.name);
}

Result<rhi::Sampler> Device::make_sampler(const rhi::SamplerDesc& desc) {
    PELLUCID_CHECK(enter());
    SamplerObject made;
    made.name = make_sampler_object(desc);
    rhi::SamplerDesc nearest = desc;
    nearest.min = nearest.mag = nearest.mip = rhi::Filter::nearest;
    made.nearest_name = nearest == desc ? made.name : make_sampler_object(nearest);
    label(GL_SAMPLER, made.name, desc.debug_name);
    return objects_.samplers.insert(made);
}

void Device::destroy(rhi::Sampler sampler) {
    if (!alive(sampler)) return;
    context_->enter();
    commands_.forget_groups();
    const SamplerObject object = objects_.samplers.erase(sampler);
    glDeleteSamplers(1, &object.name);
    if (object.nearest_name != object.name) glDeleteSamplers(1, &object.nearest_name);
}

}  // namespace pellucid::inline v0_1::opengl
