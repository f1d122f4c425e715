// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Framebuffer objects, made once for every set of attachments that a pass uses.
#include <array>
#include <cstdint>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/opengl/objects.hpp>
#include <unordered_map>

namespace pellucid::inline v0_1::opengl {

/// What a framebuffer is made of: 0, or texture name | layer << 32 | mip << 56, for each colour and then for depth; for
/// a pass without attachments its size (height << 32 | width) instead of depth, and bit 63 set.
struct FramebufferKey {
    std::array<std::uint64_t, rhi::max_color_attachments + 1> parts = {};
    friend bool operator==(const FramebufferKey&, const FramebufferKey&) = default;
};

class Framebuffers {
public:
    /// The framebuffer of a pass, complete; 0 where the driver says it is not.
    [[nodiscard]] GLuint find_or_make(Objects& objects, const rhi::RenderPassDesc& desc, bool label);
    /// Deletes those that have `texture` attached.  \returns whether `bound` was one of them.
    bool forget(GLuint texture, GLuint bound);
    void clear();

private:
    struct Hash {
        std::size_t operator()(const FramebufferKey& key) const noexcept {
            std::uint64_t hash = 0xCBF29CE484222325u;
            for (const std::uint64_t part : key.parts) hash = (hash ^ part ^ hash >> 29u) * 0x100000001B3u;
            return static_cast<std::size_t>(hash);
        }
    };
    FramebufferKey last_key_ = {};
    GLuint last_ = 0;
    std::unordered_map<FramebufferKey, GLuint, Hash> made_;
};

}  // namespace pellucid::inline v0_1::opengl
