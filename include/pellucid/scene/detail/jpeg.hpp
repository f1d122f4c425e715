// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// JPEG through libjpeg-turbo.  It reports errors by longjmp: see png.hpp for how that is kept safe.
#include <pellucid/scene/image_file.hpp>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <jpeglib.h>
#include <jerror.h>

namespace pellucid::inline v0_1::detail {

struct JpegState {
    jpeg_decompress_struct decoder{};
    jpeg_error_mgr manager{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    char message[JMSG_LENGTH_MAX] = {};
    std::uint32_t max_scans = 0;

    JpegState() {
        decoder.err = jpeg_std_error(&manager);
        decoder.client_data = this;
        manager.error_exit = on_error;
        manager.emit_message = on_message;
        manager.output_message = [](j_common_ptr) {};
        progress.progress_monitor = on_progress;
    }
    JpegState(const JpegState&) = delete;
    JpegState& operator=(const JpegState&) = delete;
    ~JpegState() { jpeg_destroy_decompress(&decoder); }

    static JpegState& of(j_common_ptr common) { return *static_cast<JpegState*>(common->client_data); }
    [[noreturn]] static void on_error(j_common_ptr common) {
        common->err->format_message(common, of(common).message);
        std::longjmp(of(common).jump, 1);
    }
    /// Warnings (level below 0) are damage that libjpeg papers over: the picture is refused.  Stray bytes between two
    /// markers and odd version numbers lose nothing, and cameras write them.
    static void on_message(j_common_ptr common, int level) {
        const int code = common->err->msg_code;
        if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM)
            on_error(common);
    }
    static void on_progress(j_common_ptr common) {
        JpegState& state = of(common);
        const auto scan = static_cast<std::uint32_t>(reinterpret_cast<j_decompress_ptr>(common)->input_scan_number);
        if (scan <= state.max_scans) return;
        std::snprintf(state.message, sizeof state.message, "it has more than %u scans", state.max_scans);
        std::longjmp(state.jump, 1);
    }
};

/// Reads the header and chooses RGBA output.  False: `state.message` says why.
inline bool jpeg_read_size(JpegState& state, std::span<const std::byte> bytes) {
    if (setjmp(state.jump)) return false;
    jpeg_create_decompress(&state.decoder);
    state.decoder.client_data = &state;
    state.decoder.progress = &state.progress;
    jpeg_mem_src(&state.decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&state.decoder, TRUE);
    return true;
}

inline bool jpeg_read_rows(JpegState& state, Image8& image) {
    if (setjmp(state.jump)) return false;
    jpeg_start_decompress(&state.decoder);
    while (state.decoder.output_scanline < state.decoder.output_height) {
        JSAMPROW row = image.texel(0, state.decoder.output_scanline);
        jpeg_read_scanlines(&state.decoder, &row, 1);
    }
    jpeg_finish_decompress(&state.decoder);
    return true;
}

inline Result<Image8> decode_jpeg(std::span<const std::byte> bytes, const std::string& name,
                                  const ImageLimits& limits) {
    JpegState state;
    state.max_scans = limits.max_scans;
    const auto damaged = [&] {
        return Error{Errc::parse, name + ": the JPEG cannot be decoded: " + std::string(state.message)};
    };
    if (!jpeg_read_size(state, bytes)) return damaged();
    const std::uint32_t width = state.decoder.image_width, height = state.decoder.image_height;
    const J_COLOR_SPACE stored = state.decoder.jpeg_color_space;
    if (stored != JCS_GRAYSCALE && stored != JCS_YCbCr && stored != JCS_RGB)
        return Error{Errc::parse, name + ": the JPEG has " + std::to_string(state.decoder.num_components) +
                                      " channels in a colour space that is neither grey, YCbCr nor RGB; "
                                      "convert it to RGB"};
    if (width > limits.max_side || height > limits.max_side || std::uint64_t{width} * height * 4 > limits.max_bytes)
        return Error{Errc::parse, name + ": the JPEG is " + std::to_string(width) + " x " + std::to_string(height) +
                                      " texels, the limit is " + std::to_string(limits.max_side) + " a side and " +
                                      std::to_string(limits.max_bytes) + " bytes decoded"};
    state.decoder.out_color_space = JCS_EXT_RGBA;
    // The accurate integer transform: the same texels on every processor.
    state.decoder.dct_method = JDCT_ISLOW;
    Image8 image(width, height, 4);
    if (!jpeg_read_rows(state, image)) return damaged();
    return image;
}

}  // namespace pellucid::inline v0_1::detail
