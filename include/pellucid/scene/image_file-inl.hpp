// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of image_file.hpp.
#include <pellucid/scene/detail/jpeg.hpp>
#include <pellucid/scene/detail/netpbm.hpp>
#include <pellucid/scene/detail/png.hpp>
#include <pellucid/scene/detail/radiance_hdr.hpp>
#include <pellucid/scene/image_file.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <new>
#include <tinyexr.h>

namespace pellucid::inline v0_1 {

PELLUCID_INLINE Result<Image8> decode_image(std::span<const std::byte> bytes, const std::string& name,
                                            const ImageLimits& limits) {
    constexpr unsigned char png[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    constexpr unsigned char jpeg[] = {0xFF, 0xD8, 0xFF};
    try {
        if (bytes.size() >= sizeof png && std::memcmp(bytes.data(), png, sizeof png) == 0)
            return detail::decode_png(bytes, name, limits);
        if (bytes.size() >= sizeof jpeg && std::memcmp(bytes.data(), jpeg, sizeof jpeg) == 0)
            return detail::decode_jpeg(bytes, name, limits);
    } catch (const std::bad_alloc&) {
        return Error{Errc::out_of_memory, name + ": there is not enough memory to decode the picture"};
    }
    return Error{Errc::parse, name + ": the " + std::to_string(bytes.size()) +
                                  " bytes are neither a PNG nor a JPEG; convert the picture to one of them"};
}

PELLUCID_INLINE Result<Image8> read_image(const std::string& path, const ImageLimits& limits) {
    PELLUCID_TRY(const std::vector<std::byte> bytes, detail::read_file(path, limits.max_bytes));
    return decode_image(bytes, path, limits);
}

PELLUCID_INLINE Result<ImageF> decode_hdr(std::span<const std::byte> bytes, const std::string& name,
                                          const ImageLimits& limits) {
    try {
        return detail::HdrReader(bytes, name, limits).read();
    } catch (const std::bad_alloc&) {
        return Error{Errc::out_of_memory, name + ": there is not enough memory to decode the picture"};
    }
}

PELLUCID_INLINE Result<ImageF> read_hdr(const std::string& path, const ImageLimits& limits) {
    // Runs make a file at most 1/128 longer than its texels, the header comes to that.
    PELLUCID_TRY(const std::vector<std::byte> bytes,
                 detail::read_file(path, limits.max_bytes + limits.max_bytes / 64 + 65536));
    return decode_hdr(bytes, path, limits);
}

PELLUCID_INLINE Result<void> check_environment(const ImageF& image, const std::string& name) {
    const auto fail = [&](const std::string& what) { return Error{Errc::invalid_argument, name + ": " + what}; };
    const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height) + " texels with " +
                             std::to_string(image.channels) + " channels";
    if (image.height == 0 || image.width != std::uint64_t{image.height} * 2 || image.channels < 3)
        return fail("has " + size + ", but an environment must be equirectangular, with three channels and twice as " +
                    "wide as high, at least 2 x 1: make it one of that shape");
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            for (std::uint32_t c = 0; c < 3; ++c)
                if (const float value = image.texel(x, y)[c]; !(value >= 0) || !std::isfinite(value))
                    return fail("channel " + std::to_string(c) + " of texel (" + std::to_string(x) + ", " +
                                std::to_string(y) + ") is " + std::to_string(value) +
                                ", but an environment's radiance must be finite and at least 0: mend the picture");
    return {};
}

PELLUCID_INLINE Result<void> write_png(const std::string& path, const Image8& image) {
    if (image.width == 0 || image.height == 0 || (image.channels != 3 && image.channels != 4))
        return Error{Errc::invalid_argument, path + ": a PNG needs texels with 3 or 4 channels, this picture is " +
                                                 std::to_string(image.width) + " x " + std::to_string(image.height) +
                                                 " with " + std::to_string(image.channels)};
    PELLUCID_TRY(const std::vector<std::byte> bytes, detail::encode_png(image, path));
    return detail::write_file(path, bytes);
}

PELLUCID_INLINE Result<void> write_pfm(const std::string& path, const ImageF& image) {
    if (image.width == 0 || image.height == 0 || image.channels < 3)
        return Error{Errc::invalid_argument, path + ": a PFM needs texels with 3 channels, this picture is " +
                                                 std::to_string(image.width) + " x " + std::to_string(image.height) +
                                                 " with " + std::to_string(image.channels)};
    static_assert(std::endian::native == std::endian::little, "the scale written below says little-endian");
    const std::string header = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    std::vector<std::byte> bytes(header.size() + std::size_t{image.width} * image.height * 3 * sizeof(float));
    std::memcpy(bytes.data(), header.data(), header.size());
    std::byte* target = bytes.data() + header.size();
    for (std::uint32_t y = image.height; y-- > 0;)
        for (std::uint32_t x = 0; x < image.width; ++x, target += 3 * sizeof(float))
            std::memcpy(target, image.texel(x, y), 3 * sizeof(float));
    return detail::write_file(path, bytes);
}

PELLUCID_INLINE Result<void> write_exr(const std::string& path, const ImageF& image) {
    if (image.width == 0 || image.height == 0 || (image.channels != 3 && image.channels != 4))
        return Error{Errc::invalid_argument, path + ": an EXR needs texels with 3 or 4 channels, this picture is " +
                                                 std::to_string(image.width) + " x " + std::to_string(image.height) +
                                                 " with " + std::to_string(image.channels)};
    // OpenEXR lists channels by name in alphabetical order, each as a plane of its own.
    constexpr const char* names[4] = {"A", "B", "G", "R"};
    std::vector<float> planes[4];
    unsigned char* pointers[4];
    for (std::uint32_t c = 0; c < 4; ++c) {
        planes[c].resize(std::size_t{image.width} * image.height, 1.0f);
        const std::uint32_t source = 3 - c;
        for (std::size_t i = 0; source < image.channels && i < planes[c].size(); ++i)
            planes[c][i] = image.data[i * image.channels + source];
        pointers[c] = reinterpret_cast<unsigned char*>(planes[c].data());
    }
    EXRChannelInfo channels[4] = {};
    int types[4];
    for (std::size_t c = 0; c < 4; ++c) {
        std::strncpy(channels[c].name, names[c], sizeof channels[c].name - 1);
        types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 4;
    header.channels = channels;
    header.pixel_types = types;
    header.requested_pixel_types = types;
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage exr;
    InitEXRImage(&exr);
    exr.num_channels = 4;
    exr.images = pointers;
    exr.width = static_cast<int>(image.width);
    exr.height = static_cast<int>(image.height);
    unsigned char* memory = nullptr;
    const char* reason = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&exr, &header, &memory, &reason);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
    if (size == 0 || !memory) {
        const std::string text = reason ? reason : "no reason given";
        FreeEXRErrorMessage(reason);
        return Error{Errc::internal, path + ": the picture cannot be encoded as EXR: " + text};
    }
    return detail::write_file(path, {reinterpret_cast<const std::byte*>(memory), size});
}

PELLUCID_INLINE Result<ImageF> read_pfm(const std::string& path, const ImageLimits& limits) {
    PELLUCID_TRY(const std::vector<std::byte> bytes, detail::read_file(path, limits.max_bytes * 3 + 256));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    PELLUCID_TRY(const detail::NetpbmHeader header, detail::read_netpbm_header(text, path, limits));
    if ((header.kind != "PF" && header.kind != "Pf") || header.number == 0 || !std::isfinite(header.number))
        return Error{Errc::parse, path + ": is not a PFM: it starts with neither PF nor Pf, or its scale is 0"};
    const std::uint32_t channels = header.kind == "PF" ? 3 : 1;
    const std::size_t row = std::size_t{header.size.width} * channels;
    if (bytes.size() - header.data < row * header.size.height * sizeof(float))
        return Error{Errc::parse, path + ": holds " + std::to_string(bytes.size() - header.data) +
                                      " bytes of texels, its header asks for " +
                                      std::to_string(row * header.size.height * sizeof(float))};
    ImageF image(header.size.width, header.size.height, channels);
    for (std::uint32_t y = 0; y < image.height; ++y)
        std::memcpy(image.texel(0, image.height - 1 - y), bytes.data() + header.data + y * row * sizeof(float),
                    row * sizeof(float));
    if ((header.number < 0) != (std::endian::native == std::endian::little)) {
        for (float& value : image.data) {
            auto* four = reinterpret_cast<std::byte*>(&value);
            std::reverse(four, four + sizeof value);
        }
    }
    return image;
}

PELLUCID_INLINE Result<Image8> read_pgm(const std::string& path, const ImageLimits& limits) {
    PELLUCID_TRY(const std::vector<std::byte> bytes, detail::read_file(path, limits.max_bytes + 256));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    PELLUCID_TRY(const detail::NetpbmHeader header, detail::read_netpbm_header(text, path, limits));
    if (header.kind != "P5" || !(header.number >= 1 && header.number <= 255))
        return Error{Errc::parse, path +
                                      ": is not a binary 8-bit PGM: it does not start with P5, or its largest value "
                                      "is outside 1 to 255"};
    Image8 image(header.size.width, header.size.height, 1);
    if (bytes.size() - header.data < image.data.size())
        return Error{Errc::parse, path + ": holds " + std::to_string(bytes.size() - header.data) +
                                      " bytes of texels, its header asks for " + std::to_string(image.data.size())};
    std::memcpy(image.data.data(), bytes.data() + header.data, image.data.size());
    return image;
}

}  // namespace pellucid::inline v0_1
