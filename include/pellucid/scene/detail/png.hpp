// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// PNG through libpng.  libpng reports errors by longjmp: each function that sets the jump holds nothing in its own
/// frame but references to objects of its caller, so no destructor is jumped over.
#include <pellucid/scene/detail/file.hpp>
#include <pellucid/scene/image_file.hpp>
#include <bit>
#include <csetjmp>
#include <png.h>

namespace pellucid::inline v0_1::detail {

struct PngState {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const std::byte> input;  ///< what is still to be read
    std::vector<std::byte>* output = nullptr;
    std::string message;  ///< libpng's error
    std::vector<png_bytep> rows;
    std::vector<std::uint16_t> wide;  ///< `[h, w, 4]` of a 16-bit file
    bool writing = false;

    explicit PngState(bool writes) : writing(writes) {}
    PngState(const PngState&) = delete;
    PngState& operator=(const PngState&) = delete;
    ~PngState() {
        if (writing)
            png_destroy_write_struct(&png, &info);
        else
            png_destroy_read_struct(&png, &info, nullptr);
    }
    [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
        static_cast<PngState*>(png_get_error_ptr(png))->message = text;
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_read(png_structp png, png_bytep target, std::size_t size) {
        auto& state = *static_cast<PngState*>(png_get_io_ptr(png));
        if (size > state.input.size()) png_error(png, "the data ends too early");
        std::memcpy(target, state.input.data(), size);
        state.input = state.input.subspan(size);
    }
    static void on_write(png_structp png, png_bytep source, std::size_t size) {
        auto& state = *static_cast<PngState*>(png_get_io_ptr(png));
        const auto* bytes = reinterpret_cast<const std::byte*>(source);
        state.output->insert(state.output->end(), bytes, bytes + size);
    }
};

/// Reads the header and sets the conversions to RGBA.  False: `state.message` says why.
inline bool png_read_header(PngState& state, const ImageLimits& limits, Extent2D& size, bool& wide) {
    if (setjmp(png_jmpbuf(state.png))) return false;
    png_set_user_limits(state.png, limits.max_side, limits.max_side);
    png_set_chunk_malloc_max(state.png, 16u << 20u);
    png_set_chunk_cache_max(state.png, 64);
    png_set_read_fn(state.png, &state, PngState::on_read);
    png_read_info(state.png, state.info);
    size = {png_get_image_width(state.png, state.info), png_get_image_height(state.png, state.info)};
    wide = png_get_bit_depth(state.png, state.info) == 16;
    png_set_expand(state.png);
    png_set_gray_to_rgb(state.png);
    png_set_add_alpha(state.png, wide ? 0xFFFFu : 0xFFu, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little) png_set_swap(state.png);
    png_set_interlace_handling(state.png);
    png_read_update_info(state.png, state.info);
    return true;
}

inline bool png_read_rows(PngState& state) {
    if (setjmp(png_jmpbuf(state.png))) return false;
    png_read_image(state.png, state.rows.data());
    png_read_end(state.png, nullptr);
    return true;
}

inline Result<Image8> decode_png(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
    PngState state(false);
    state.input = bytes;
    state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, PngState::on_error, PngState::on_warning);
    if (state.png) state.info = png_create_info_struct(state.png);
    if (!state.info) return Error{Errc::out_of_memory, name + ": libpng could not be started"};
    const auto damaged = [&] { return Error{Errc::parse, name + ": the PNG cannot be decoded: " + state.message}; };
    Extent2D size;
    bool wide = false;
    if (!png_read_header(state, limits, size, wide)) return damaged();
    const std::uint64_t texels = std::uint64_t{size.width} * size.height;
    if (texels * 4 > limits.max_bytes)
        return Error{Errc::parse, name + ": the PNG is " + std::to_string(size.width) + " x " +
                                      std::to_string(size.height) + " texels, the limit is " +
                                      std::to_string(limits.max_bytes) + " bytes decoded"};
    if (png_get_rowbytes(state.png, state.info) != std::size_t{size.width} * (wide ? 8u : 4u))
        return Error{Errc::parse, name + ": the PNG's rows have a size that its header does not explain"};
    Image8 image(size.width, size.height, 4);
    if (wide) state.wide.resize(texels * 4);
    state.rows.resize(size.height);
    for (std::uint32_t y = 0; y < size.height; ++y)
        state.rows[y] =
            wide ? reinterpret_cast<png_bytep>(state.wide.data() + std::size_t{y} * size.width * 4) : image.texel(0, y);
    if (!png_read_rows(state)) return damaged();
    // v / 257 to the nearest integer: 65535 = 255 * 257, so 8-bit values that were widened come back exactly.
    for (std::size_t i = 0; i < state.wide.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>((state.wide[i] + 128u) / 257u);
    return image;
}

inline bool png_write_all(PngState& state, const Image8& image) {
    if (setjmp(png_jmpbuf(state.png))) return false;
    png_set_write_fn(state.png, &state, PngState::on_write, nullptr);
    png_set_IHDR(state.png, state.info, image.width, image.height, 8,
                 image.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(state.png, state.info, PNG_sRGB_INTENT_RELATIVE);
    png_write_info(state.png, state.info);
    for (std::uint32_t y = 0; y < image.height; ++y) png_write_row(state.png, image.texel(0, y));
    png_write_end(state.png, state.info);
    return true;
}

inline Result<std::vector<std::byte>> encode_png(const Image8& image, const std::string& name) {
    std::vector<std::byte> bytes;
    PngState state(true);
    state.output = &bytes;
    state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, PngState::on_error, PngState::on_warning);
    if (state.png) state.info = png_create_info_struct(state.png);
    if (!state.info) return Error{Errc::out_of_memory, name + ": libpng could not be started"};
    if (!png_write_all(state, image))
        return Error{Errc::invalid_argument, name + ": the picture cannot be encoded: " + state.message};
    return bytes;
}

}  // namespace pellucid::inline v0_1::detail
