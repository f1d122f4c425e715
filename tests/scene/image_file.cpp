// SPDX-License-Identifier: MIT
/// \file
/// Pictures: what is written comes back, every PNG layout becomes RGBA, damage is an error.
#include <pellucid/scene/image_file.hpp>
#include <jpeglib.h>
#include <png.h>
#include <csetjmp>
#include <cstdlib>
#include <limits>
#include "scene/gltf_text.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

std::span<const std::byte> span_of(const std::string& bytes) {
    return {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
}

/// A PNG of any colour type and depth; `rows` are as libpng wants them.
std::string encode(std::uint32_t width, std::uint32_t height, int depth, int type, const std::string& rows,
                   const std::string& palette = {}, const std::string& transparency = {}, bool interlaced = false) {
    std::string out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep data, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), size);
        },
        nullptr);
    png_set_IHDR(png, info, width, height, depth, type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, 0, 0);
    std::vector<png_color> colors(palette.size() / 3);
    if (!colors.empty()) {
        std::memcpy(colors.data(), palette.data(), palette.size());
        png_set_PLTE(png, info, colors.data(), static_cast<int>(colors.size()));
    }
    if (type == PNG_COLOR_TYPE_PALETTE && !transparency.empty()) {
        png_set_tRNS(png, info, reinterpret_cast<png_const_bytep>(transparency.data()),
                     static_cast<int>(transparency.size()), nullptr);
    } else if (!transparency.empty()) {
        png_color_16 key{};
        key.gray = static_cast<unsigned char>(transparency[0]);
        png_set_tRNS(png, info, nullptr, 0, &key);
    }
    png_write_info(png, info);
    std::string copy = rows;
    std::vector<png_bytep> pointers;
    for (std::uint32_t y = 0; y < height; ++y)
        pointers.push_back(reinterpret_cast<png_bytep>(copy.data()) + y * (copy.size() / height));
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

std::string encode_jpeg(std::uint32_t width, std::uint32_t height, int channels, J_COLOR_SPACE space, int scans) {
    jpeg_compress_struct jpeg;
    jpeg_error_mgr manager;
    jpeg.err = jpeg_std_error(&manager);
    jpeg_create_compress(&jpeg);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &memory, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    std::vector<jpeg_scan_info> script;
    for (int i = 0; i < scans; ++i) {
        // One scan of the mean values, then one for each following coefficient.
        jpeg_scan_info scan{};
        scan.comps_in_scan = 1;
        scan.Ss = scan.Se = i;
        script.push_back(scan);
    }
    if (scans > 0) {
        jpeg.scan_info = script.data();
        jpeg.num_scans = scans;
    }
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<unsigned char> row(std::size_t{width} * static_cast<unsigned>(channels));
    while (jpeg.next_scanline < height) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = static_cast<unsigned char>(jpeg.next_scanline * 4 + i % static_cast<unsigned>(channels) * 40);
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&jpeg, &pointer, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string out(reinterpret_cast<char*>(memory), size);
    jpeg_destroy_compress(&jpeg);
    std::free(memory);
    return out;
}

std::vector<int> texel(const Image8& image, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* t = image.texel(x, y);
    return {t, t + image.channels};
}

std::string message(const Result<Image8>& result) {
    return result ? std::string() : result.error().message;
}

}  // namespace

TEST_CASE("PNG: 8-bit RGBA and RGB come back as they were written", "[cpu][image]") {
    const TemporaryFolder folder;
    for (const std::uint32_t channels : {3u, 4u}) {
        Image8 image(5, 3, channels);
        for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::uint8_t>(i * 37 + 11);
        REQUIRE(write_png(folder / "a.png", image));
        const auto back = read_image(folder / "a.png");
        REQUIRE(back);
        CHECK(back->channels == 4);
        for (std::uint32_t y = 0; y < 3; ++y)
            for (std::uint32_t x = 0; x < 5; ++x) {
                std::vector<int> expected = texel(image, x, y);
                expected.resize(4, 255);
                CHECK(texel(*back, x, y) == expected);
            }
    }
}

TEST_CASE("PNG: grey, palette, transparency keys, 1 and 16 bits, interlacing", "[cpu][image]") {
    const auto decode = [](const std::string& png) {
        auto image = decode_image(span_of(png), "test");
        INFO(message(image));
        REQUIRE(image);
        REQUIRE(image->channels == 4);
        return std::move(*image);
    };
    CHECK(texel(decode(encode(1, 1, 8, PNG_COLOR_TYPE_GRAY, "\x40")), 0, 0) == std::vector{64, 64, 64, 255});
    CHECK(texel(decode(encode(1, 1, 8, PNG_COLOR_TYPE_GRAY, "\x40", {}, "\x40")), 0, 0) == std::vector{64, 64, 64, 0});
    CHECK(texel(decode(encode(1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, "\x40\x20")), 0, 0) == std::vector{64, 64, 64, 32});
    const Image8 bits = decode(encode(2, 1, 1, PNG_COLOR_TYPE_GRAY, "\x40"));
    CHECK(texel(bits, 0, 0) == std::vector{0, 0, 0, 255});
    CHECK(texel(bits, 1, 0) == std::vector{255, 255, 255, 255});
    const Image8 palette = decode(encode(2, 1, 8, PNG_COLOR_TYPE_PALETTE, std::string("\0\1", 2), "abcdef", "\x10"));
    CHECK(texel(palette, 0, 0) == std::vector<int>{'a', 'b', 'c', 16});
    CHECK(texel(palette, 1, 0) == std::vector<int>{'d', 'e', 'f', 255});
    // 16 bits, big-endian: 0x807F / 257 = 127.998 -> 128, 0x0080 / 257 = 0.498 -> 0, 0xFF7E -> 254.5 - -> 254.
    const Image8 wide = decode(encode(1, 1, 16, PNG_COLOR_TYPE_RGB, std::string("\x80\x7F\x00\x80\xFF\x7E", 6)));
    CHECK(texel(wide, 0, 0) == std::vector{128, 0, 254, 255});
    std::string rows;
    for (int i = 0; i < 9 * 9 * 3; ++i) rows += static_cast<char>(i);
    const Image8 straight = decode(encode(9, 9, 8, PNG_COLOR_TYPE_RGB, rows));
    CHECK(decode(encode(9, 9, 8, PNG_COLOR_TYPE_RGB, rows, {}, {}, true)).data == straight.data);
}

TEST_CASE("PNG: every truncation is an error, every changed byte is survived", "[cpu][image]") {
    std::string rows;
    for (int i = 0; i < 8 * 8 * 4; ++i) rows += static_cast<char>(i * i);
    const std::string png = encode(8, 8, 8, PNG_COLOR_TYPE_RGB_ALPHA, rows);
    for (std::size_t size = 0; size + 12 < png.size(); ++size)  // the end mark's own 12 bytes may be missing
        REQUIRE_FALSE(decode_image(span_of(png.substr(0, size)), "test"));
    int refused = 0;
    for (std::size_t at = 0; at < png.size(); ++at)
        for (const char change : {'\x01', '\x80', '\xFF'}) {
            std::string changed = png;
            changed[at] = static_cast<char>(changed[at] ^ change);
            const auto image = decode_image(span_of(changed), "test");
            refused += image ? 0 : 1;
        }
    CHECK(refused > static_cast<int>(png.size()));
}

TEST_CASE("JPEG: colours, orientation, damage", "[cpu][image]") {
    const std::string jpeg = encode_jpeg(16, 40, 3, JCS_RGB, 0);
    const auto image = decode_image(span_of(jpeg), "test");
    REQUIRE(image);
    CHECK((image->width == 16 && image->height == 40 && image->channels == 4));
    for (const std::uint32_t y : {1u, 20u, 38u}) {
        CHECK(image->texel(8, y)[0] == Approx(y * 4).margin(4));
        CHECK(image->texel(8, y)[2] == Approx(y * 4 + 80).margin(4));
        CHECK(image->texel(8, y)[3] == 255);
    }
    const std::string grey = encode_jpeg(8, 8, 1, JCS_GRAYSCALE, 0);
    const auto grey_image = decode_image(span_of(grey), "test");
    REQUIRE(grey_image);
    CHECK(grey_image->texel(3, 3)[0] == grey_image->texel(3, 3)[2]);
    for (std::size_t size = 0; size + 2 < jpeg.size(); ++size)
        REQUIRE_FALSE(decode_image(span_of(jpeg.substr(0, size)), "test"));
    for (std::size_t at = 0; at < jpeg.size(); ++at)
        for (const char change : {'\x01', '\x80', '\xFF'}) {
            std::string changed = jpeg;
            changed[at] = static_cast<char>(changed[at] ^ change);
            const auto survived = decode_image(span_of(changed), "test", {.max_side = 4096});
            if (survived) CHECK(survived->channels == 4);
        }
}

TEST_CASE("JPEG: CMYK and too many scans are refused with a sentence", "[cpu][image]") {
    const std::string cmyk = encode_jpeg(8, 8, 4, JCS_CMYK, 0);
    CHECK(message(decode_image(span_of(cmyk), "print")).find("print: the JPEG has 4 channels") == 0);
    const std::string progressive = encode_jpeg(8, 8, 1, JCS_GRAYSCALE, 30);
    CHECK(decode_image(span_of(progressive), "bomb"));
    CHECK(message(decode_image(span_of(progressive), "bomb", {.max_scans = 10})) ==
          "bomb: the JPEG cannot be decoded: it has more than 10 scans");
}

TEST_CASE("sizes are limited before memory is taken", "[cpu][image]") {
    // A header that asks for 2^31 - 1 a side; its checksum is right.
    std::string png = encode(1, 1, 8, PNG_COLOR_TYPE_GRAY, "\x40");
    const std::string ihdr = std::string("IHDR\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x08\x00\x00\x00\x00", 17);
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : ihdr) {
        crc ^= static_cast<unsigned char>(c);
        for (int i = 0; i < 8; ++i) crc = crc >> 1u ^ (crc & 1u ? 0xEDB88320u : 0u);
    }
    crc = ~crc;
    png.replace(12, 17, ihdr);
    for (int i = 0; i < 4; ++i) png[29 + static_cast<std::size_t>(i)] = static_cast<char>(crc >> (24 - 8 * i));
    CHECK_FALSE(decode_image(span_of(png), "bomb"));
    const std::string large = encode(100, 100, 8, PNG_COLOR_TYPE_GRAY, std::string(10000, '\0'));
    CHECK(message(decode_image(span_of(large), "large", {.max_bytes = 39999})) ==
          "large: the PNG is 100 x 100 texels, the limit is 39999 bytes decoded");
    CHECK(decode_image(span_of(large), "large", {.max_bytes = 40000}));
    CHECK_FALSE(decode_image(span_of(large), "large", {.max_side = 99}));
    CHECK(message(decode_image(span_of("GIF89a"), "x")).find("x: the 6 bytes are neither") == 0);
}

TEST_CASE("PFM: floats come back, whichever way up and whichever byte order", "[cpu][image]") {
    const TemporaryFolder folder;
    ImageF image(3, 2, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.1f * static_cast<float>(i) - 0.5f;
    image.data[4] = std::numeric_limits<float>::infinity();
    REQUIRE(write_pfm(folder / "a.pfm", image));
    const auto back = read_pfm(folder / "a.pfm");
    REQUIRE(back);
    CHECK(back->channels == 3);
    CHECK(back->data == image.data);
    // The file's first row is the bottom one.
    std::string bytes;
    std::ifstream stream(folder / "a.pfm", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    float first = 0;
    std::memcpy(&first, bytes.data() + bytes.size() - 3 * 2 * 3 * sizeof(float), sizeof first);
    CHECK(first == image.texel(0, 1)[0]);
    write_bytes(folder / "big.pfm", "Pf\n# a remark\n1 1\n1.0\n" + std::string("\x3F\x80\x00\x00", 4));
    const auto big = read_pfm(folder / "big.pfm");
    REQUIRE(big);
    CHECK(big->channels == 1);
    CHECK(big->data[0] == 1.0f);
    for (const char* wrong : {"PF\n1 1\n-1.0\n123", "PF\n0 1\n-1\n", "PF\n99999 99999\n-1\n",
                              "PF\n1 1\n0\n123456789012", "P6\n1 1\n255\n123", "PF", ""}) {
        write_bytes(folder / "wrong.pfm", wrong);
        CHECK_FALSE(read_pfm(folder / "wrong.pfm"));
    }
}

TEST_CASE("PGM: 8-bit grey", "[cpu][image]") {
    const TemporaryFolder folder;
    write_bytes(folder / "a.pgm", "P5\n2 2\n255\nabcd");
    const auto image = read_pgm(folder / "a.pgm");
    REQUIRE(image);
    CHECK(texel(*image, 1, 1) == std::vector<int>{'d'});
    write_bytes(folder / "short.pgm", "P5\n2 2\n255\nabc");
    CHECK_FALSE(read_pgm(folder / "short.pgm"));
    write_bytes(folder / "wide.pgm", "P5\n1 1\n65535\nab");
    CHECK_FALSE(read_pgm(folder / "wide.pgm"));
}

TEST_CASE("EXR: a float file with four channels is written", "[cpu][image]") {
    const TemporaryFolder folder;
    ImageF image(20, 10, 4);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i);
    REQUIRE(write_exr(folder / "a.exr", image));
    std::ifstream stream(folder / "a.exr", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    REQUIRE(bytes.size() > 100);
    CHECK(bytes.substr(0, 4) == "\x76\x2F\x31\x01");
    CHECK(bytes.find("channels") != std::string::npos);
}

TEST_CASE("a file that cannot be written is an error and leaves nothing behind", "[cpu][image]") {
    const TemporaryFolder folder;
    const Image8 image(2, 2, 4);
    const auto missing = write_png(folder / "none/a.png", image);
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == Errc::io);
    CHECK(missing.error().message == (folder / "none/a.png") + ": cannot be written: No such file or directory");
    const auto full = write_png("/dev/full", image);
    REQUIRE_FALSE(full);
    CHECK(full.error().code == Errc::io);
    CHECK(write_png("/dev/null", image));
    // A folder stands in the way: the temporary file is gone again.
    std::filesystem::create_directory(folder / "b.png");
    write_bytes(folder / "b.png/content", "x");
    REQUIRE_FALSE(write_png(folder / "b.png", image));
    CHECK_FALSE(std::filesystem::exists(folder / "b.png.part0"));
    // An existing file is replaced.
    write_bytes(folder / "c.png", "old");
    REQUIRE(write_png(folder / "c.png", image));
    CHECK(read_image(folder / "c.png"));
    CHECK_FALSE(write_png(folder / "d.png", Image8(2, 2, 1)));
    CHECK_FALSE(write_pfm(folder / "d.pfm", ImageF()));
}
