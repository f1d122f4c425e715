// SPDX-License-Identifier: MIT
// The same calls give the same bits on both backends of one driver family.
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
    for (int i = 0; i < 200; ++i) {
        const float x = 2.2f * random() - 1.1f, y = 2.2f * random() - 1.1f;
        quads.push_back({.rect = {x, y, x + random(), y + random()},
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
    CHECK(vulkan.depth.data == opengl.depth.data);
    CHECK(vulkan.color.data == opengl.color.data);
    CHECK(vulkan.srgb.data == opengl.srgb.data);
}
#endif
