// SPDX-License-Identifier: MIT
// Clears of every format, load and store of attachments, layers and levels as attachments.
#include <bit>
#include <cmath>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {
constexpr Extent2D size{5, 3};

/// Clears a texture of `format` and reads it as `channels` values of `T`.
template <class T, class D>
Image<T> cleared(D& device, Format format, ColorAttachment attachment) {
    const auto target = test::make_target(device, size, format);
    attachment.texture = target;
    test::run(device, [&](auto& commands) {
        commands.begin_render({.colors = {attachment}, .size = size, .name = "clear"});
        commands.end_render();
    });
    return test::read<T>(device, target, size, info(format).channels);
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("clear colours arrive in every colour format", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const ColorAttachment color{.clear = {0.5f, 0.25f, 1.0f, 0.125f}};
    const ColorAttachment integer{.clear_uint = {0xDEADBEEFu, 7, 0xFFFFFFFFu, 1}};
    for (auto format : {Format::r8_unorm, Format::rgba8_unorm}) {
        const auto picture = cleared<std::uint8_t>(*device, format, color);
        const int expected[] = {128, 64, 255, 32};
        for (std::size_t i = 0; i < picture.data.size(); ++i)
            CHECK(std::abs(picture.data[i] - expected[i % picture.channels]) <= 1);  // 127.5 may round either way
    }
    for (auto format : {Format::r32_uint, Format::rg32_uint, Format::rgba32_uint}) {
        const auto picture = cleared<std::uint32_t>(*device, format, integer);
        for (std::size_t i = 0; i < picture.data.size(); ++i)
            CHECK(picture.data[i] == integer.clear_uint[i % picture.channels]);
    }
    for (auto format : {Format::r16_float, Format::rg16_float, Format::rgba16_float}) {
        const auto picture = cleared<std::uint16_t>(*device, format, color);
        const std::uint16_t expected[] = {0x3800, 0x3400, 0x3C00, 0x3000};
        for (std::size_t i = 0; i < picture.data.size(); ++i) CHECK(picture.data[i] == expected[i % picture.channels]);
    }
    for (auto format : {Format::r32_float, Format::rg32_float, Format::rgba32_float}) {
        const auto picture = cleared<float>(*device, format, color);
        for (std::size_t i = 0; i < picture.data.size(); ++i)
            CHECK(picture.data[i] == color.clear[i % picture.channels]);
    }
}

TEMPLATE_LIST_TEST_CASE("clear colours are linear: 0.5 becomes 188 in sRGB, alpha stays linear", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto picture = cleared<std::uint8_t>(*device, Format::rgba8_srgb, {.clear = {0.5f, 0.0f, 1.0f, 0.25f}});
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) CHECK(test::rgba(picture, x, y) == 0xBC00FF40u);
}

TEMPLATE_LIST_TEST_CASE("depth is cleared to what is asked for", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (auto format : {Format::d32_float, Format::d32_float_s8_uint}) {
        const auto depth = test::make_depth(*device, size, format);
        for (const float value : {0.0f, 0.75f, 1.0f}) {
            test::run(*device, [&](auto& commands) {
                commands.begin_render({.depth = {.texture = depth, .clear = value}, .size = size, .name = "clear"});
                commands.end_render();
            });
            const auto read = test::read<float>(*device, depth, size, 1);
            for (const float found : read.data) CHECK(found == value);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("loaded attachments keep what an earlier pass stored", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const test::Quad right{.rect = {0.2f, -1, 1, 1}, .color = {0, 0, 1, 1}};
    test::run(*device, [&](auto& commands) {
        commands.begin_render({.colors = {{.texture = target, .clear = {1, 0, 0, 1}}}, .size = size, .name = "red"});
        commands.end_render();
    });
    test::draw(*device, {.colors = {{.texture = target, .load = Load::load}}, .size = size, .name = "blue"}, pipeline,
               std::span(&right, 1));
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x)
            CHECK(test::rgba(picture, x, y) == (x < 3 ? 0xFF0000FFu : 0x0000FFFFu));
}

TEMPLATE_LIST_TEST_CASE("a clear fills the whole render area although the last scissor was small", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto target = test::make_target(*device, size);
    auto desc = test::quad_desc();
    desc.colors[0].write_mask = 0x1;
    const auto pipeline = own(*device, device->make_pipeline(desc));
    const test::Quad white{};
    test::run(*device, [&](auto& commands) {
        const auto records = test::upload(commands, std::span(&white, 1));
        commands.begin_render({.colors = {{.texture = target}}, .size = size, .name = "masked"});
        commands.set_scissor({0, 0, 1, 1});
        test::draw(commands, pipeline, std::span(&white, 1), records);
        commands.end_render();
        commands.begin_render({.colors = {{.texture = target, .clear = {0, 1, 1, 1}}}, .size = size, .name = "clear"});
        commands.end_render();
    });
    const auto picture = test::read<std::uint8_t>(*device, target, size, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) CHECK(test::rgba(picture, x, y) == 0x00FFFFFFu);
}

TEMPLATE_LIST_TEST_CASE("one layer and one level of a texture can be attached", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto texture =
        own(*device, device->make_texture({.size = {8, 4},
                                           .layers = 3,
                                           .mips = 3,
                                           .format = Format::rgba8_unorm,
                                           .kind = TextureKind::array,
                                           .usage = TextureUsage::attachment | TextureUsage::copy_source,
                                           .debug_name = "layers"}));
    test::run(*device, [&](auto& commands) {
        for (std::uint32_t mip = 0; mip < 3; ++mip)
            for (std::uint32_t layer = 0; layer < 3; ++layer) {
                const float red = static_cast<float>(mip * 3 + layer) / 255.0f;
                commands.begin_render(
                    {.colors = {{.texture = texture, .mip = mip, .layer = layer, .clear = {red, 0, 0, 1}}},
                     .size = {8u >> mip, 4u >> mip},
                     .name = "layer"});
                commands.end_render();
            }
    });
    for (std::uint32_t mip = 0; mip < 3; ++mip)
        for (std::uint32_t layer = 0; layer < 3; ++layer) {
            const auto picture = test::read<std::uint8_t>(*device, texture, {8u >> mip, 4u >> mip}, 4, mip, layer);
            CHECK(picture.texel(0, 0)[0] == mip * 3 + layer);
            CHECK(picture.texel((8u >> mip) - 1, (4u >> mip) - 1)[0] == mip * 3 + layer);
        }
}
