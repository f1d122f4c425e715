// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Blocking readback of one texture level, or of a buffer, through the concepts alone, so that it works on every
/// backend.
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <algorithm>
#include <cstring>
#include <vector>

namespace pellucid::inline v0_1::rhi {

/// Texels as they are stored: rows tightly packed, row 0 at the top.
struct Texels {
    Extent2D size = {};
    Format format = Format::undefined;
    std::vector<std::byte> bytes;  ///< size.width · size.height · info(format).bytes

    /// Texel (x, y) as a trivially copyable `T`.  Precondition: sizeof(T) == info(format).bytes.
    template <class T>
    [[nodiscard]] T at(std::uint32_t x, std::uint32_t y) const {
        T value;
        std::memcpy(&value, bytes.data() + (std::size_t{y} * size.width + x) * sizeof(T), sizeof(T));
        return value;
    }
};

namespace detail {

/// The bytes that `copy(commands, buffer)` puts into a buffer, in a copy pass that declares `source`; waits.
template <Backend B, class Copy>
[[nodiscard]] Result<std::vector<std::byte>> download(typename B::Device& device, ResourceUse source,
                                                      std::uint64_t bytes, Copy&& copy) {
    Unique<typename B::Device, Buffer> buffer;
    PELLUCID_OWN(buffer, device,
                 device.make_buffer({.size = bytes,
                                     .usage = BufferUsage::copy_destination,
                                     .memory = Memory::readback,
                                     .debug_name = "readback"}));
    typename B::Commands* cmd = nullptr;
    PELLUCID_TRY(cmd, device.begin_frame());
    cmd->begin_copy({.uses = {source, use(buffer, Access::copy_write)}, .name = "readback"});
    copy(*cmd, buffer.get());
    cmd->end_copy();
    Ticket ticket{};
    PELLUCID_TRY(ticket, device.submit());
    PELLUCID_CHECK(device.wait(ticket));
    const auto mapped = device.mapped(buffer);
    return std::vector<std::byte>(mapped.begin(), mapped.begin() + static_cast<std::ptrdiff_t>(bytes));
}

}  // namespace detail

/// Copies one level of `texture` (copy_source usage) and waits.  `desc` gives its level-0 size and its format.
/// Errors: memory, device loss.
template <Backend B>
[[nodiscard]] Result<Texels> download(typename B::Device& device, Texture texture, const TextureDesc& desc,
                                      std::uint32_t mip = 0, std::uint32_t layer = 0) {
    Texels out{.size = {std::max(1u, desc.size.width >> mip), std::max(1u, desc.size.height >> mip)},
               .format = desc.format,
               .bytes = {}};
    const std::uint64_t bytes = std::uint64_t{out.size.width} * out.size.height * info(desc.format).bytes;
    PELLUCID_TRY(out.bytes, detail::download<B>(device, use(texture, Access::copy_read), bytes,
                                                [&](typename B::Commands& cmd, Buffer buffer) {
                                                    cmd.copy(texture, buffer, TextureCopy{.mip = mip, .layer = layer});
                                                }));
    return out;
}

/// The same of level 0 of a texture of this size and format, as a picture `[h, w, info(format).bytes / sizeof(T)]`.
template <Backend B, class T>
[[nodiscard]] Result<Image<T>> download_image(typename B::Device& device, Texture texture, Extent2D size,
                                              Format format) {
    Texels texels;
    PELLUCID_TRY(texels, download<B>(device, texture, {.size = size, .format = format}));
    Image<T> out(size.width, size.height, info(format).bytes / static_cast<std::uint32_t>(sizeof(T)));
    std::memcpy(out.data.data(), texels.bytes.data(), texels.bytes.size());
    return out;
}

/// Copies the first `count` values of `buffer` (copy_source usage) and waits.  Errors: memory, device loss.
template <Backend B, class T>
[[nodiscard]] Result<std::vector<T>> download(typename B::Device& device, Buffer source, std::size_t count) {
    if (count == 0) return std::vector<T>{};
    std::vector<std::byte> bytes;
    PELLUCID_TRY(bytes, detail::download<B>(device, use(source, Access::copy_read), count * sizeof(T),
                                            [&](typename B::Commands& cmd, Buffer buffer) {
                                                cmd.copy(source, buffer, BufferCopy{.size = count * sizeof(T)});
                                            }));
    std::vector<T> out(count);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
}

}  // namespace pellucid::inline v0_1::rhi
