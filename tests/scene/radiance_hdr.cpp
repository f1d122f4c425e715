// SPDX-License-Identifier: MIT
/// \file
/// Radiance pictures: every way a scan line is stored, every line of the header that is heeded, every kind of damage.
#include <pellucid/scene/image_file.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include "scene/gltf_text.hpp"
#include "support/assets.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

std::string text(std::initializer_list<int> bytes) {
    std::string out;
    for (const int b : bytes) out += static_cast<char>(b);
    return out;
}
std::string resolution(int width, int height) {
    return "\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
}
Result<ImageF> decode(const std::string& bytes, const ImageLimits& limits = {}) {
    return decode_hdr({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}, "sky.hdr", limits);
}
/// The refusal without the file's name; the test fails where there is none, or where it is not one sentence.
std::string refusal_of(const std::string& bytes, const ImageLimits& limits = {}) {
    const auto image = decode(bytes, limits);
    if (image) return "decoded";
    const Error& error = image.error();
    CHECK(error.code == Errc::parse);
    CHECK(error.message.find('\n') == std::string::npos);
    REQUIRE(error.message.substr(0, 9) == "sky.hdr: ");
    return error.message.substr(9);
}
bool starts(const std::string& text, const std::string& with) {
    INFO(text << " | " << with);
    CHECK(text.substr(0, with.size()) == with);
    return text.substr(0, with.size()) == with;
}
/// A picture of one scan line of 8 texels of runs; `channels` are the bytes of its runs.
std::string packed_line(const std::string& channels) {
    return head + resolution(8, 1) + text({2, 2, 0, 8}) + channels;
}
const std::string run_of_8 = text({136, 64});

}  // namespace

TEST_CASE("HDR: flat texels are mantissas in the middle of their step", "[cpu][image]") {
    const auto image =
        decode(head + resolution(2, 2) + text({128, 64, 0, 129, 255, 255, 255, 1, 9, 9, 9, 0, 128, 200, 30, 255}));
    REQUIRE(image);
    CHECK((image->width == 2 && image->height == 2 && image->channels == 3));
    CHECK(image->texel(0, 0)[0] == 128.5f / 128);  // exponent 129: 2^(129 - 136)
    CHECK(image->texel(0, 0)[1] == 64.5f / 128);
    CHECK(image->texel(0, 0)[2] == 0.5f / 128);
    CHECK(image->texel(1, 0)[0] == std::ldexp(255.5f, -135));
    for (int c = 0; c < 3; ++c) CHECK(image->texel(0, 1)[c] == 0.0f);
    CHECK(image->texel(1, 1)[1] == std::ldexp(200.5f, 119));
}

TEST_CASE("HDR: runs and literals, channel by channel", "[cpu][image]") {
    const std::string literal = text({8, 10, 11, 12, 13, 14, 15, 16, 17});
    const std::string mixed = text({131, 7, 2, 1, 2, 131, 9});
    const auto image = decode(packed_line(literal + mixed + run_of_8 + text({136, 136})));
    REQUIRE(image);
    const int green[] = {7, 7, 7, 1, 2, 9, 9, 9};
    for (std::uint32_t x = 0; x < 8; ++x) {
        CHECK(image->texel(x, 0)[0] == static_cast<float>(x) + 10.5f);
        CHECK(image->texel(x, 0)[1] == static_cast<float>(green[x]) + 0.5f);
        CHECK(image->texel(x, 0)[2] == 64.5f);
    }
    // A line may be flat though others are not; one that starts 2 2 and a byte from 128 on is flat.
    std::string flat;
    for (int x = 0; x < 8; ++x) flat += text({2, 2, 128 + x, 136});
    const auto both =
        decode(head + resolution(8, 2) + flat + text({2, 2, 0, 8}) + run_of_8 + run_of_8 + run_of_8 + run_of_8);
    REQUIRE(both);
    CHECK(both->texel(3, 0)[2] == 131.5f);
    CHECK(both->texel(3, 1)[2] == std::ldexp(64.5f, 64 - 136));
    // Widths that runs cannot announce are flat, whatever the texels look like.
    std::string seven;
    for (int x = 0; x < 7; ++x) seven += text({2, 2, 0, 7});
    CHECK(decode(head + resolution(7, 1) + seven));
    std::string wide;
    for (int x = 0; x < 32768; ++x) wide += text({2, 2, 128, 136});
    CHECK(decode(head + resolution(32768, 1) + wide, {.max_side = 40000}));
}

TEST_CASE("HDR: exposure and colour correction are divided out, other lines passed over", "[cpu][image]") {
    const std::string texel = text({128, 64, 32, 136});
    const auto with_lines = [&](const std::string& lines) {
        return decode("#?RGBE\n# FORMAT=nonsense in a remark\n" + lines +
                      "GAMMA=2.2\nPRIMARIES=0 0 0 0 0 0 0 0\nVIEW= -vtv\nrpict -vf x\n\tEXPOSURE=nonsense\n"
                      "FORMAT=  32-bit_rle_rgbe \n" +
                      resolution(1, 1) + texel);
    };
    const auto plain = with_lines("");
    REQUIRE(plain);
    CHECK(plain->texel(0, 0)[0] == 128.5f);
    const auto lines = with_lines("EXPOSURE=   4.0\nCOLORCORR= 1 0.5\t2 \nEXPOSURE=0.5\n");
    REQUIRE(lines);
    CHECK(lines->texel(0, 0)[0] == 128.5f / 2);
    CHECK(lines->texel(0, 0)[1] == 64.5f);
    CHECK(lines->texel(0, 0)[2] == 32.5f / 4);
    const auto refused = [&](const std::string& line, const char* says) {
        return starts(refusal_of(head + line + "\n" + resolution(1, 1) + texel), says);
    };
    CHECK(refused("EXPOSURE=bright", "line 3: EXPOSURE is \"bright\", but must be a number"));
    CHECK(refused("EXPOSURE=", "line 3: EXPOSURE is \"\", but must be a number"));
    CHECK(refused("EXPOSURE=1 2", "line 3: EXPOSURE is \"1 2\", but must be a number"));
    CHECK(refused("EXPOSURE=1x", "line 3: EXPOSURE is \"1x\", but must be a number"));
    CHECK(refused("EXPOSURE=0", "line 3: EXPOSURE is \"0\", but must be above 0"));
    CHECK(refused("EXPOSURE=-1", "line 3: EXPOSURE is \"-1\", but must be above 0"));
    CHECK(refused("EXPOSURE=nan", "line 3: EXPOSURE is \"nan\", but must be above 0"));
    CHECK(refused("EXPOSURE=inf", "line 3: EXPOSURE is \"inf\", but must be above 0"));
    CHECK(refused("EXPOSURE=1e300\nEXPOSURE=1e300", "line 4: EXPOSURE is \"1e300\", but must be above 0"));
    CHECK(refused("COLORCORR=1 1", "line 3: COLORCORR is \"1 1\", but must be three numbers"));
    CHECK(refused("COLORCORR=1 0 1", "line 3: COLORCORR is \"1 0 1\", but must be above 0"));
    CHECK(refused("EXPOSURE=1e-37", "texel (0, 0) is beyond what a float holds"));
}

TEST_CASE("HDR: headers that are none", "[cpu][image]") {
    const std::string texel = text({128, 64, 32, 136});
    CHECK(starts(refusal_of(""), "is no Radiance picture: it starts with \"\", not with \"#?\""));
    CHECK(starts(refusal_of("\x89PNG\r\n"), "is no Radiance picture: it starts with \"?PNG??\""));
    CHECK(starts(refusal_of("#?RADIANCE"), "its header does not end: no empty line in its first 10 bytes"));
    CHECK(starts(refusal_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"), "its header does not end"));
    CHECK(starts(refusal_of("#?RADIANCE\n" + std::string(100'000, 'x')), "its header does not end: no empty line in"));
    std::string lines = "#?RADIANCE\n";
    for (int i = 0; i < 40'000; ++i) lines += "a\n";
    CHECK(
        starts(refusal_of(lines + resolution(1, 1) + texel), "its header does not end: no empty line in its first 6"));
    CHECK(starts(refusal_of("#?RADIANCE\n" + resolution(1, 1) + texel), "its header has no FORMAT line"));
    CHECK(starts(refusal_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n" + resolution(1, 1) + texel),
                 "line 2: FORMAT is \"32-bit_rle_xyze\", CIE XYZ, only 32-bit_rle_rgbe can be read"));
    CHECK(starts(refusal_of(head + "FORMAT=ascii\n" + resolution(1, 1) + texel), "line 3: FORMAT is \"ascii\", only"));
    CHECK(starts(refusal_of("#?RADIANCE\nFORMAT=\n" + resolution(1, 1) + texel), "line 2: FORMAT is \"\", only"));
    CHECK(starts(refusal_of(head + "\n"), "ends behind its header"));
    CHECK(starts(refusal_of(head + "\n-Y 1 +X 1"), "ends behind its header"));
    for (const char* line : {"", "-Y 1", "-Y 1 +X", "-Y 1 +X ", "-Y 1 +X 1 ", "-Y 1 +X 1 x", "-Y  1 +X 1", "-Y 1  +X 1",
                             "-Y -1 +X 1", "-Y 1 +X 1.5", "-Y 1 -Y 1", "Y 1 X 1", "-Y 1 +Z 1", "-Y 99999999999 +X 1",
                             "-Y 1 +X 1\r", "-Y 0x1 +X 1", "1 1"})
        CHECK(starts(refusal_of(head + "\n" + line + "\n" + texel),
                     "its size is given as \"" + std::string(line == std::string("-Y 1 +X 1\r") ? "-Y 1 +X 1?" : line) +
                         "\", but must be \"-Y height +X width\""));
    for (const char* line : {"+Y 1 +X 1", "-Y 1 -X 1", "+X 1 -Y 1", "-X 1 +Y 1"})
        CHECK(starts(refusal_of(head + "\n" + line + "\n" + texel),
                     "its size is given as \"" + std::string(line) + "\", another orientation than"));
}

TEST_CASE("HDR: sizes are limited before memory is taken", "[cpu][image]") {
    const std::string texel = text({128, 64, 32, 136});
    CHECK(starts(refusal_of(head + resolution(0, 1) + texel), "0 x 1 texels is outside 1 to 16384 a side"));
    CHECK(starts(refusal_of(head + resolution(1, 0)), "1 x 0 texels is outside"));
    CHECK(starts(refusal_of(head + resolution(16385, 1) + texel), "16385 x 1 texels is outside"));
    CHECK(starts(refusal_of(head + resolution(2, 2) + texel, {.max_bytes = 15}),
                 "2 x 2 texels is outside 1 to 16384 a side, 15 bytes in all at 4 a texel"));
    // Within the limits, but no file of this length holds so much: nothing is allocated.
    CHECK(starts(refusal_of(head + resolution(16384, 16384) + texel),
                 "holds 4 bytes of scan lines, 16384 x 16384 texels take at least 17104896"));
    CHECK(starts(refusal_of(head + resolution(7, 2) + texel),
                 "holds 4 bytes of scan lines, 7 x 2 texels take at least 56"));
    CHECK(starts(refusal_of(head + resolution(127, 1) + text({2, 2, 0, 127})),
                 "holds 4 bytes of scan lines, 127 x 1 texels "
                 "take at least 12"));
    CHECK(decode(head + resolution(127, 1) + text({2, 2, 0, 127, 255, 1, 255, 1, 255, 1, 255, 1})));
    CHECK(starts(refusal_of(head + resolution(128, 1) + text({2, 2, 0, 128, 255, 1, 255, 1, 255, 1, 255, 1})),
                 "holds 12 bytes of scan lines, 128 x 1 texels take at least 20"));
}

TEST_CASE("HDR: scan lines that are damaged", "[cpu][image]") {
    const std::string data = "byte " + std::to_string((head + resolution(8, 1)).size() + 4);
    CHECK(decode(packed_line(run_of_8 + run_of_8 + run_of_8 + run_of_8)));
    CHECK(starts(refusal_of(packed_line(text({0, 1}) + run_of_8 + run_of_8 + run_of_8)),
                 "scan line 0, " + data + ": a run has no texels"));
    CHECK(starts(refusal_of(packed_line(text({137, 1}) + run_of_8 + run_of_8 + run_of_8)),
                 "scan line 0, " + data + ": a run of 9 texels starts at texel 0 of 8, beyond the end of the line"));
    CHECK(starts(refusal_of(packed_line(text({132, 1, 133, 1}) + run_of_8 + run_of_8 + run_of_8)),
                 "scan line 0, byte " + std::to_string((head + resolution(8, 1)).size() + 6) +
                     ": a run of 5 texels starts at texel 4 of 8"));
    CHECK(starts(refusal_of(packed_line(text({9, 1, 1, 1, 1, 1, 1, 1, 1, 1}))),
                 "scan line 0, " + data + ": a run of 9 texels"));
    CHECK(starts(
        refusal_of(packed_line(run_of_8 + run_of_8 + text({132, 1, 132, 1}))),
        "scan line 0, byte " + std::to_string((packed_line("").size() + 8)) + ": the file ends inside the line"));
    CHECK(starts(refusal_of(packed_line(run_of_8 + run_of_8 + run_of_8 + text({8, 1, 2, 3}))), "scan line 0"));
    CHECK(refusal_of(packed_line(run_of_8 + run_of_8 + run_of_8 + text({8, 1, 2, 3}))).find("ends inside a run") !=
          std::string::npos);
    CHECK(starts(refusal_of(packed_line(run_of_8 + run_of_8 + run_of_8 + text({136}) + "")), "holds 11 bytes"));
    CHECK(refusal_of(head + resolution(8, 1) + text({2, 2, 0, 9}) + run_of_8 + run_of_8 + run_of_8 + run_of_8)
              .find("says that it has 9 texels, the picture is 8 wide") != std::string::npos);
    std::string flat;
    for (int x = 0; x < 8; ++x) flat += text({128, 1, 1, 136});
    CHECK(refusal_of(head + resolution(8, 2) + flat + flat.substr(0, 31)).find("ends after 31 bytes of 32") !=
          std::string::npos);
    CHECK(starts(refusal_of(head + resolution(8, 1) + flat + "xyz"), "holds 3 bytes after its last scan line"));
    CHECK(refusal_of(head + resolution(8, 1) + flat.substr(0, 4) + text({1, 1, 1, 7}) + flat.substr(8))
              .find("texel 1 is a run of the old kind") != std::string::npos);
}

TEST_CASE("HDR: files that are not there, folders, files that are too long", "[cpu][image]") {
    const TemporaryFolder folder;
    const auto missing = read_hdr(folder / "none.hdr");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().message == (folder / "none.hdr") + ": there is no such file");
    CHECK_FALSE(read_hdr(folder / "."));
    write_bytes(folder / "a.hdr", head + resolution(1, 1) + text({128, 64, 32, 136}));
    const auto image = read_hdr(folder / "a.hdr");
    REQUIRE(image);
    CHECK(image->texel(0, 0)[0] == 128.5f);
    write_bytes(folder / "long.hdr", std::string(70'000, 'x'));
    const auto refused = read_hdr(folder / "long.hdr", {.max_bytes = 4000});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find("long.hdr: holds 70000 bytes, the limit is 69598") != std::string::npos);
}

TEST_CASE("an environment is twice as wide as high, finite and not negative", "[cpu][image]") {
    CHECK(check_environment(ImageF(2, 1, 3), "sky"));
    CHECK(check_environment(ImageF(8, 4, 4), "sky"));
    for (const ImageF& wrong :
         {ImageF(), ImageF(1, 1, 3), ImageF(4, 4, 3), ImageF(1, 2, 3), ImageF(5, 2, 3), ImageF(4, 2, 1)}) {
        const auto result = check_environment(wrong, "sky");
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        CHECK(result.error().message.find("sky: has " + std::to_string(wrong.width) + " x " +
                                          std::to_string(wrong.height) + " texels") == 0);
        CHECK(result.error().message.find("twice as wide as high") != std::string::npos);
    }
    for (const float value : {-0.5f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        ImageF image(4, 2, 3);
        image.texel(3, 1)[2] = value;
        const auto result = check_environment(image, "sky");
        REQUIRE_FALSE(result);
        CHECK(result.error().message.find("sky: channel 2 of texel (3, 1) is ") == 0);
    }
}

namespace {
/// The real picture's bytes, or nothing with a sentence.
std::string real_picture() {
    const auto folder = assets();
    if (!folder) return {};
    const auto path = *folder / "env" / "spiaggia_di_mondello_1k.hdr";
    if (!std::filesystem::exists(path)) {
        skip(path.string() + " is not there", "PELLUCID_REQUIRE_ASSETS");
        return {};
    }
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}
}  // namespace

TEST_CASE("HDR: a real picture, its first line decoded once more", "[cpu][image]") {
    const std::string bytes = real_picture();
    if (bytes.empty()) return;
    const auto image = decode(bytes);
    REQUIRE(image);
    CHECK((image->width == 1024 && image->height == 512));
    CHECK(check_environment(*image, "real"));
    // The first line by a loop of its own, which knows nothing but codes.
    const std::string size_line = "\n\n-Y 512 +X 1024\n";
    std::size_t at = bytes.find(size_line) + size_line.size() + 4;
    std::vector<int> planes;
    while (planes.size() < 4096) {
        const int code = static_cast<unsigned char>(bytes[at++]);
        for (int i = 0; i < code - (code > 128 ? 128 : 0); ++i)
            planes.push_back(static_cast<unsigned char>(bytes[code > 128 ? at : at++]));
        at += code > 128;
    }
    for (std::size_t x = 0; x < 1024; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = (planes[c * 1024 + x] + 0.5) * std::exp2(planes[3072 + x] - 136);
            if (image->texel(static_cast<std::uint32_t>(x), 0)[c] != static_cast<float>(expected))
                FAIL("texel " << x << ", channel " << c);
        }
    // The sun is far above what a display shows; nothing is black.
    float largest = 0, smallest = 1;
    for (const float value : image->data) {
        largest = std::max(largest, value);
        smallest = std::min(smallest, value);
    }
    CHECK(largest > 100);
    CHECK(smallest >= 0);
}

TEST_CASE("HDR: every truncation of a real picture is refused, every changed byte is survived", "[cpu][image]") {
    const std::string bytes = real_picture();
    if (bytes.empty()) return;
    // Only the first 12 lines, so that thousands of variants take no time; the size is put right.
    const std::string size_line = "-Y 512 +X 1024\n";
    const std::size_t size_at = bytes.find(size_line), data = size_at + size_line.size();
    std::size_t at = data;
    for (int line = 0; line < 12; ++line) {
        at += 4;
        for (std::size_t got = 0; got < 4096;) {
            const auto code = static_cast<unsigned char>(bytes[at]);
            got += code > 128 ? code - 128u : code;
            at += code > 128 ? 2u : code + 1u;
        }
    }
    const std::string small = bytes.substr(0, size_at) + "-Y 12 +X 1024\n" + bytes.substr(data, at - data);
    REQUIRE(decode(small));
    for (std::size_t size = 0; size < small.size(); size += size < 200 ? 1 : 13)
        REQUIRE_FALSE(decode(small.substr(0, size)));
    std::size_t refused = 0, decoded = 0;
    for (std::size_t place = 0; place < small.size(); place += place < 200 ? 1 : 7)
        for (const int change : {0x01, 0x80, 0xFF}) {
            std::string changed = small;
            changed[place] = static_cast<char>(static_cast<unsigned char>(changed[place]) ^ change);
            const auto image = decode(changed);
            ++(image ? decoded : refused);
            if (image) CHECK(image->data.size() == 12u * 1024 * 3);
        }
    CHECK(refused > 100);
    CHECK(decoded > 100);
    for (std::size_t size = 0; size < bytes.size(); size += 50'021) REQUIRE_FALSE(decode(bytes.substr(0, size)));
}
