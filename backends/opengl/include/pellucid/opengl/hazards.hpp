// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which glMemoryBarrier bits a pass needs.  OpenGL orders everything by itself except what shaders store: a later use
/// of a stored resource needs the bit of *that use*, and a store needs the bit of the store after any earlier use
/// (glMemoryBarrier also keeps later stores behind earlier reads).
#include <array>
#include <bit>
#include <cstdint>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/rhi/desc.hpp>

namespace pellucid::inline v0_1::opengl {

/// Numbers of the last passes that stored to a resource from a shader and that used it at all; 0: none.
struct Touch {
    std::uint64_t stored = 0;
    std::uint64_t used = 0;
};

/// The barrier bits of one use of a buffer (or, with `texture`, of a texture).
[[nodiscard]] constexpr GLbitfield barrier_bits(rhi::Access access, bool texture) noexcept {
    switch (access) {
        case rhi::Access::sampled:
            return GL_TEXTURE_FETCH_BARRIER_BIT;
        case rhi::Access::uniform_read:
            return GL_UNIFORM_BARRIER_BIT;
        case rhi::Access::storage_read:
        case rhi::Access::storage_write:
        case rhi::Access::storage_read_write:
            return texture ? GL_SHADER_IMAGE_ACCESS_BARRIER_BIT : GL_SHADER_STORAGE_BARRIER_BIT;
        case rhi::Access::index_read:
            return GL_ELEMENT_ARRAY_BARRIER_BIT;
        case rhi::Access::indirect_read:
            return GL_COMMAND_BARRIER_BIT;
        case rhi::Access::copy_read:
        case rhi::Access::copy_write:
            // Mip generation samples and attaches; copies between textures and buffers are pixel transfers.
            return texture ? GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT
                           : GL_BUFFER_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT;
    }
    return 0;
}
[[nodiscard]] constexpr bool stores(rhi::Access access) noexcept {
    return access == rhi::Access::storage_write || access == rhi::Access::storage_read_write;
}

/// Per pass: `begin`, `need` for every use, `finish` (issue what it returns), then `mark` for every use.  A bit is
/// needed when the resource was stored to after the bit was last issued; bits not issued stay pending.
class Hazards {
public:
    void begin() noexcept {
        ++pass_;
        needed_ = 0;
    }
    void need(const Touch& touch, GLbitfield bits, bool store) noexcept {
        const std::uint64_t since = store && touch.used > touch.stored ? touch.used : touch.stored;
        for (GLbitfield rest = bits; rest != 0; rest &= rest - 1)
            if (since > issued_[static_cast<std::size_t>(std::countr_zero(rest))]) needed_ |= rest & (~rest + 1);
    }
    /// \returns the bits for glMemoryBarrier; 0: none is needed.
    [[nodiscard]] GLbitfield finish() noexcept {
        for (GLbitfield rest = needed_; rest != 0; rest &= rest - 1)
            issued_[static_cast<std::size_t>(std::countr_zero(rest))] = pass_ - 1;
        return needed_;
    }
    void mark(Touch& touch, bool store) const noexcept {
        touch.used = pass_;
        if (store) touch.stored = pass_;
    }

private:
    std::uint64_t pass_ = 0;
    GLbitfield needed_ = 0;
    std::array<std::uint64_t, 32> issued_{};  ///< by bit: everything up to this pass is covered
};

}  // namespace pellucid::inline v0_1::opengl
