// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Pictures in files: PNG and JPEG in; PNG, PFM and EXR out; PFM and PGM in, for references;
/// Radiance .hdr in, for environments.
/// Decoders are given bytes that nobody has checked: sizes are limited before anything is allocated, and damage of any
/// kind is an `Error`.  Writers replace the named file in one step, or leave it as it was and return Errc::io.
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pellucid::inline v0_1 {

/// What a picture may take before a decoder refuses it.
struct ImageLimits {
    std::uint32_t max_side = 16384;                     ///< [texel]
    std::uint64_t max_bytes = std::uint64_t{1} << 30u;  ///< [B] of the decoded picture, 4 a texel
    std::uint32_t max_scans = 64;                       ///< of a progressive JPEG: each costs a pass over the picture
};

/// Decodes a PNG or a JPEG, told apart by their first bytes, to `[h, w, 4]` RGBA, 8 bits a channel, straight alpha, as
/// stored (no colour management).  16-bit PNG channels are rounded to the nearest 8-bit value; grey, palette and tRNS
/// are expanded; alpha is 255 where there is none; four-channel (CMYK, YCCK) JPEG is refused.
/// `name` is what the picture is called in an error.  Errors: Errc::parse.
Result<Image8> decode_image(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

/// Reads and decodes a PNG or JPEG file.
Result<Image8> read_image(const std::string& path, const ImageLimits& limits = {});

/// Decodes a Radiance picture (.hdr, .pic) to `[h, w, 3]` linear radiance, finite and at least 0.  Scan lines are flat
/// or run-length encoded.  EXPOSURE and COLORCORR lines are divided out, so that values are those the picture was made
/// of, and a mantissa stands for the middle of its step, (m + 1/2)/256, as Ward defines both ("Radiance File Formats";
/// many readers do neither).  PRIMARIES, VIEW, PIXASPECT, GAMMA and remarks are passed over.  Refused: XYZE,
/// orientations other than "-Y h +X w", the runs of before 1991, bytes behind the last line, and a header that promises
/// more texels than the bytes could hold.  `name` is what the picture is called in an error.  Errors: Errc::parse.
Result<ImageF> decode_hdr(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

/// Reads and decodes a Radiance picture.
Result<ImageF> read_hdr(const std::string& path, const ImageLimits& limits = {});

/// Whether `image` can be an environment in equirectangular projection: twice as wide as high, at least 2 x 1, three
/// channels or more, the first three of each texel finite and at least 0.  `name` is what it is called in the error.
/// Errors: Errc::invalid_argument.
Result<void> check_environment(const ImageF& image, const std::string& name);

/// Writes `[h, w, 3]` or `[h, w, 4]`, straight alpha, values already sRGB-encoded: the file says so (sRGB chunk).
Result<void> write_png(const std::string& path, const Image8& image);

/// Writes `[h, w, 3]` float32 (a fourth channel is left out), little-endian; the format keeps the bottom row first.
Result<void> write_pfm(const std::string& path, const ImageF& image);

/// Writes `[h, w, 4]` float32 as a scan-line OpenEXR file, uncompressed floats in, ZIP on disk, channels R, G, B, A;
/// `[h, w, 3]` gets A = 1.
Result<void> write_exr(const std::string& path, const ImageF& image);

/// Reads a PFM of either byte order to `[h, w, 3]` ("PF") or `[h, w, 1]` ("Pf"), top row first.
Result<ImageF> read_pfm(const std::string& path, const ImageLimits& limits = {});

/// Reads a binary 8-bit PGM ("P5") to `[h, w, 1]`.
Result<Image8> read_pgm(const std::string& path, const ImageLimits& limits = {});

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/image_file-inl.hpp>
#endif
