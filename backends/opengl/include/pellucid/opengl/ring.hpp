// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Memory for data of one frame: persistently mapped blocks, one chain of blocks per frame in flight.  A chain starts
/// at 1 MiB, grows by doubling, and is written again only when its frame is done.  Nothing is allocated once it has
/// grown.
#include <array>
#include <cstddef>
#include <cstdint>
#include <pellucid/opengl/calls.hpp>
#include <vector>

namespace pellucid::inline v0_1::opengl {

class Ring {
public:
    struct Block {
        GLuint buffer = 0;
        std::byte* map = nullptr;
        std::uint32_t size = 0;  ///< [byte]
    };
    struct Slice {
        std::byte* bytes = nullptr;  ///< null: out of memory
        std::uint32_t block = 0;     ///< for `block()`
        std::uint32_t offset = 0;    ///< [byte] in the block
    };
    static constexpr std::uint32_t first_block_bytes = 1u << 20u;
    static constexpr std::uint32_t max_slice_bytes = 1u << 30u;

    /// Makes block 0, so that it may be bound before anything was written.
    [[nodiscard]] bool start(const char* debug_name, bool label);
    /// Precondition: the GPU uses no block.
    void stop();
    /// Precondition: the frame that last used `slot` is done.
    void begin_frame(std::uint32_t slot) noexcept {
        slot_ = slot;
        link_ = 0;
        enter_link();
    }
    /// Room for `size` bytes (≤ `max_slice_bytes`) at a multiple of `alignment`, a power of two.
    [[nodiscard]] Slice take(std::uint32_t size, std::uint32_t alignment) {
        const std::uint64_t at = (std::uint64_t{offset_} + alignment - 1) & ~(std::uint64_t{alignment} - 1);
        if (at + size > open_.size) [[unlikely]]
            return take_from_next(size);
        offset_ = static_cast<std::uint32_t>(at) + size;
        return {open_.map + at, open_index_, static_cast<std::uint32_t>(at)};
    }
    [[nodiscard]] const Block& block(std::uint32_t index) const noexcept { return blocks_[index]; }

private:
    Slice take_from_next(std::uint32_t size);
    void enter_link() noexcept;
    bool add_block(std::uint32_t size);

    Block open_ = {};
    std::uint32_t open_index_ = 0;
    std::uint32_t offset_ = 0;  ///< [byte] first free one of the open block
    std::uint32_t slot_ = 0;
    std::size_t link_ = 0;  ///< place of the open block in the slot's chain
    std::vector<Block> blocks_;
    std::array<std::vector<std::uint32_t>, 4> chains_;
    const char* debug_name_ = "";
    bool label_ = false;
};

}  // namespace pellucid::inline v0_1::opengl
