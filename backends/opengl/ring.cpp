// SPDX-License-Identifier: MIT
#include "pellucid/opengl/ring.hpp"

#include <bit>

namespace pellucid::inline v0_1::opengl {

bool Ring::start(const char* debug_name, bool label) {
    debug_name_ = debug_name;
    label_ = label;
    if (!add_block(first_block_bytes)) return false;
    begin_frame(0);
    return true;
}

void Ring::stop() {
    for (const Block& block : blocks_) {
        glUnmapNamedBuffer(block.buffer);
        glDeleteBuffers(1, &block.buffer);
    }
    blocks_.clear();
    for (auto& chain : chains_) chain.clear();
    open_ = {};
}

void Ring::enter_link() noexcept {
    offset_ = 0;
    const auto& chain = chains_[slot_];
    // A slot without blocks opens an empty one: the first `take` makes it.
    open_index_ = link_ < chain.size() ? chain[link_] : 0;
    open_ = link_ < chain.size() ? blocks_[open_index_] : Block{};
}

Ring::Slice Ring::take_from_next(std::uint32_t size) {
    auto& chain = chains_[slot_];
    std::uint32_t grown = first_block_bytes;
    if (link_ < chain.size()) {
        grown = blocks_[chain[link_]].size < max_slice_bytes / 2 ? blocks_[chain[link_]].size * 2 : max_slice_bytes;
        ++link_;
    }
    while (link_ < chain.size() && blocks_[chain[link_]].size < size) ++link_;
    if (link_ == chain.size() && !add_block(grown < size ? std::bit_ceil(size) : grown)) {
        link_ = chain.empty() ? 0 : chain.size() - 1;
        return {};
    }
    enter_link();
    offset_ = size;
    return {open_.map, open_index_, 0};
}

bool Ring::add_block(std::uint32_t size) {
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) continue;  // old errors are not ours
    Block block{.size = size};
    constexpr GLbitfield how = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glCreateBuffers(1, &block.buffer);
    glNamedBufferStorage(block.buffer, size, nullptr, how);
    if (glGetError() == GL_NO_ERROR)
        block.map = static_cast<std::byte*>(glMapNamedBufferRange(block.buffer, 0, size, how));
    if (!block.map) {
        glDeleteBuffers(1, &block.buffer);
        return false;
    }
    if (label_) glObjectLabel(GL_BUFFER, block.buffer, -1, debug_name_);
    chains_[slot_].push_back(static_cast<std::uint32_t>(blocks_.size()));
    blocks_.push_back(block);
    return true;
}

}  // namespace pellucid::inline v0_1::opengl
