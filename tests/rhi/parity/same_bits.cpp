// SPDX-License-Identifier: MIT
// The same calls give the same bits on both backends of one driver family.
#include <algorithm>
#include <cmath>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {
struct Pictures {
    Image<std::uint16_t> color;
    ImageF depth;
    Image8 srgb;
    bool software = false;
};

/// 200 rectangles of pseudo-random place, depth and colour: blended into RGBA16F, depth-tested into sRGB.
template <Backend B>
bool render(Pictures& out) {
    const auto device = test::make_device<B>();
    if (!device) return false;
    constexpr Extent2D size{61, 47};
    std::vector<test::Quad> quads;
    std::uint32_t seed = 1;
    auto random = [&] {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<float>(seed >> 8) * 0x1p-24f;
    };
    // Never through a pixel's centre: which of two rows a tie belongs to is the API's own affair (see raster.cpp).
    auto place = [&](std::uint32_t texels) {
        const float at = (random() * 1.2f - 0.1f) * static_cast<float>(texels);
        const float off = std::abs(at - std::floor(at) - 0.5f) < 0.01f ? at + 0.03f : at;
        return 2.0f * off / static_cast<float>(texels) - 1.0f;
    };
    for (int i = 0; i < 200; ++i) {
        const float x[] = {place(size.width), place(size.width)}, y[] = {place(size.height), place(size.height)};
        quads.push_back(
            {.rect = {std::min(x[0], x[1]), std::min(y[0], y[1]), std::max(x[0], x[1]), std::max(y[0], y[1])},
             .color = {random() / 2, random() / 2, random() / 2, random()},
             .depth = {random()}});
    }
    const auto color = test::make_target(*device, size, Format::rgba16_float);
    const auto srgb = test::make_target(*device, size, Format::rgba8_srgb);
    const auto depth = test::make_depth(*device, size);
    auto desc = test::quad_desc(Format::rgba16_float);
    desc.colors[0].blend = blend_premultiplied;
    const auto blend = own(*device, device->make_pipeline(desc));
    desc = test::quad_desc(Format::rgba8_srgb);
    desc.depth = {.format = Format::d32_float, .test = true, .write = true};
    const auto opaque = own(*device, device->make_pipeline(desc));
    test::draw(*device, {.colors = {{.texture = color}}, .size = size}, blend, quads);
    test::draw(*device, {.colors = {{.texture = srgb}}, .depth = {.texture = depth}, .size = size}, opaque, quads);
    out.color = test::read<std::uint16_t>(*device, color, size, 4);
    out.srgb = test::read<std::uint8_t>(*device, srgb, size, 4);
    out.depth = test::read<float>(*device, depth, size, 1);
    out.software = device->info().software;
    return true;
}
/// How many values differ.
template <class T>
std::size_t differing(const Image<T>& a, const Image<T>& b) {
    REQUIRE(a.data.size() == b.data.size());
    std::size_t out = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) out += std::memcmp(&a.data[i], &b.data[i], sizeof(T)) != 0;
    return out;
}
}  // namespace

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("both backends give the same bits: blended colour, depth, sRGB", "[gpu]") {
    Pictures vulkan, opengl;
    if (!render<Vulkan>(vulkan) || !render<OpenGL>(opengl)) return;
    if (vulkan.software != opengl.software)
        return test::skip("the two backends run on different drivers here", "PELLUCID_REQUIRE_DEVICES");
    std::size_t covered = 0;
    for (const float z : vulkan.depth.data) covered += z > 0;
    CHECK(covered > vulkan.depth.data.size() / 2);  // the comparison is about something
    CHECK(differing(vulkan.depth, opengl.depth) == 0);
    CHECK(differing(vulkan.color, opengl.color) == 0);
    CHECK(differing(vulkan.srgb, opengl.srgb) == 0);
}
#endif
