// SPDX-License-Identifier: MIT
#include "pellucid/opengl/framebuffers.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

constexpr std::size_t depth_part = rhi::max_color_attachments;
constexpr std::uint64_t no_attachment = std::uint64_t{1} << 63u;

std::uint64_t part(const TextureObject& texture, std::uint32_t mip, std::uint32_t layer) {
    return texture.name | std::uint64_t{layer} << 32u | std::uint64_t{mip} << 56u;
}

void attach(GLuint framebuffer, GLenum point, const TextureObject& texture, std::uint32_t mip, std::uint32_t layer) {
    if (texture.kind == rhi::TextureKind::flat)
        glNamedFramebufferTexture(framebuffer, point, texture.name, static_cast<GLint>(mip));
    else
        glNamedFramebufferTextureLayer(framebuffer, point, texture.name, static_cast<GLint>(mip),
                                       static_cast<GLint>(layer));
}

}  // namespace

GLuint Framebuffers::find_or_make(Objects& objects, const rhi::RenderPassDesc& desc, bool label) {
    FramebufferKey key;
    for (std::size_t i = 0; i < desc.colors.size(); ++i)
        if (desc.colors[i].texture)
            key.parts[i] = part(objects.textures[desc.colors[i].texture], desc.colors[i].mip, desc.colors[i].layer);
    if (desc.depth.texture)
        key.parts[depth_part] = part(objects.textures[desc.depth.texture], desc.depth.mip, desc.depth.layer);
    else if (key == FramebufferKey{})
        key.parts[depth_part] = no_attachment | std::uint64_t{desc.size.height} << 32u | desc.size.width;
    if (last_ != 0 && key == last_key_) return last_;
    if (const auto found = made_.find(key); found != made_.end()) {
        last_key_ = key;
        return last_ = found->second;
    }

    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    GLenum targets[rhi::max_color_attachments] = {};
    for (std::size_t i = 0; i < desc.colors.size(); ++i) {
        targets[i] = GL_NONE;
        if (!desc.colors[i].texture) continue;
        targets[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        attach(framebuffer, targets[i], objects.textures[desc.colors[i].texture], desc.colors[i].mip,
               desc.colors[i].layer);
    }
    if (desc.colors.empty())
        glNamedFramebufferDrawBuffers(framebuffer, 0, nullptr);
    else
        glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(desc.colors.size()), targets);
    if (desc.depth.texture) {
        const TextureObject& depth = objects.textures[desc.depth.texture];
        attach(framebuffer, info(depth.format).stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth,
               desc.depth.mip, desc.depth.layer);
    }
    if (key.parts[depth_part] & no_attachment) {
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, static_cast<GLint>(desc.size.width));
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, static_cast<GLint>(desc.size.height));
    }
    if (glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        glDeleteFramebuffers(1, &framebuffer);
        return 0;
    }
    if (label) glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, desc.name);
    made_.emplace(key, framebuffer);
    last_key_ = key;
    return last_ = framebuffer;
}

bool Framebuffers::forget(GLuint texture, GLuint bound) {
    bool was_bound = false;
    for (auto i = made_.begin(); i != made_.end();) {
        bool uses = false;
        for (const std::uint64_t p : i->first.parts)
            uses = uses || (!(p & no_attachment) && static_cast<GLuint>(p) == texture);
        if (!uses) {
            ++i;
            continue;
        }
        was_bound = was_bound || i->second == bound;
        if (i->second == last_) last_ = 0;
        glDeleteFramebuffers(1, &i->second);
        i = made_.erase(i);
    }
    return was_bound;
}

void Framebuffers::clear() {
    for (const auto& [key, framebuffer] : made_) glDeleteFramebuffers(1, &framebuffer);
    made_.clear();
    last_ = 0;
}

}  // namespace pellucid::inline v0_1::opengl
