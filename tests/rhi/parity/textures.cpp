// SPDX-License-Identifier: MIT
// Textures: initial texels, copies both ways, the three kinds as shaders see them, samplers, generated levels.
#include <array>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {
/// Samples `texture` at every place of `where` (u, v, w or layer, level) in a compute pass.
template <class D>
std::vector<std::array<float, 4>> sample(D& device, const Shader& shader, Texture texture, const SamplerDesc& how,
                                         const std::vector<std::array<float, 4>>& where) {
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture},
                                          {13, BindingKind::storage_buffer},
                                          {14, BindingKind::storage_buffer}}};
    const auto pipeline = own(device, device.make_pipeline(ComputePipelineDesc{
                                          .compute = &shader, .pass_group = layout, .debug_name = "sample"}));
    const auto bytes = std::as_bytes(std::span(where));
    const auto places =
        own(device, device.make_buffer({.size = bytes.size(), .initial = bytes, .debug_name = "where"}));
    const auto found = own(device, device.make_buffer({.size = bytes.size(),
                                                       .usage = BufferUsage::storage | BufferUsage::copy_source,
                                                       .debug_name = "found"}));
    const auto sampler = own(device, device.make_sampler(how));
    const auto group =
        own(device, device.make_group({.layout = layout,
                                       .bindings = {{.binding = 12, .texture = texture, .sampler = sampler},
                                                    {13, places.get()},
                                                    {14, found.get()}},
                                       .debug_name = "sample"}));
    test::run(device, [&](auto& commands) {
        commands.begin_compute({.uses = {use(texture, Access::sampled), use(places.get(), Access::storage_read),
                                         use(found.get(), Access::storage_write)},
                                .name = "sample"});
        commands.bind_pipeline(pipeline);
        commands.bind_group(group);
        commands.dispatch(static_cast<std::uint32_t>(where.size()), 1, 1);
        commands.end_compute();
    });
    return test::read<std::array<float, 4>>(device, found.get(), where.size());
}

constexpr SamplerDesc nearest{.min = Filter::nearest,
                              .mag = Filter::nearest,
                              .mip = Filter::nearest,
                              .wrap_u = Wrap::clamp,
                              .wrap_v = Wrap::clamp};
}  // namespace

TEMPLATE_LIST_TEST_CASE("initial texels of every level and layer; row 0 is v = 0", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    // 4×2, 2 layers, 3 levels: each texel says where it is: (x, y, layer, level).
    std::vector<float> texels;
    for (std::uint32_t mip = 0; mip < 3; ++mip)
        for (std::uint32_t layer = 0; layer < 2; ++layer)
            for (std::uint32_t y = 0; y < std::max(2u >> mip, 1u); ++y)
                for (std::uint32_t x = 0; x < 4u >> mip; ++x)
                    for (const auto value : {x, y, layer, mip}) texels.push_back(static_cast<float>(value));
    const auto texture = own(*device, device->make_texture({.size = {4, 2},
                                                            .layers = 2,
                                                            .mips = 3,
                                                            .format = Format::rgba32_float,
                                                            .kind = TextureKind::array,
                                                            .usage = TextureUsage::sampled | TextureUsage::copy_source,
                                                            .initial = std::as_bytes(std::span(texels)),
                                                            .debug_name = "initial"}));
    const auto found =
        sample(*device, shaders::test_sample_array_comp, texture, nearest,
               {{0.1f, 0.1f, 0, 0}, {0.9f, 0.1f, 1, 0}, {0.1f, 0.9f, 1, 0}, {0.9f, 0.9f, 0, 1}, {0.5f, 0.5f, 1, 2}});
    CHECK(found[0] == std::array{0.0f, 0.0f, 0.0f, 0.0f});
    CHECK(found[1] == std::array{3.0f, 0.0f, 1.0f, 0.0f});
    CHECK(found[2] == std::array{0.0f, 1.0f, 1.0f, 0.0f});
    CHECK(found[3] == std::array{1.0f, 0.0f, 0.0f, 1.0f});
    CHECK(found[4] == std::array{0.0f, 0.0f, 1.0f, 2.0f});
    const auto level = test::read<float>(*device, texture, {2, 1}, 4, 1, 1);
    CHECK(level.texel(1, 0)[0] == 1.0f);
    CHECK(level.texel(1, 0)[2] == 1.0f);
    CHECK(level.texel(1, 0)[3] == 1.0f);
}

TEMPLATE_LIST_TEST_CASE("sampled 2D textures: filters, wraps and levels", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const std::uint8_t texels[] = {0, 255, 255, 0, 64};  // 2×2, then 1×1
    const auto texture = own(*device, device->make_texture({.size = {2, 2},
                                                            .mips = 2,
                                                            .format = Format::r8_unorm,
                                                            .initial = std::as_bytes(std::span(texels)),
                                                            .debug_name = "checker"}));
    const auto& shader = shaders::test_sample_2d_comp;
    auto red = [&](const SamplerDesc& how, std::array<float, 4> at) {
        return sample(*device, shader, texture, how, {at})[0][0];
    };
    CHECK(red(nearest, {0.25f, 0.25f, 0, 0}) == 0.0f);
    CHECK(red(nearest, {0.75f, 0.25f, 0, 0}) == 1.0f);
    CHECK(red(nearest, {1.75f, 0.25f, 0, 0}) == 1.0f);   // clamped to the right column
    CHECK(red(nearest, {-0.75f, 0.25f, 0, 0}) == 0.0f);  // clamped to the left column
    SamplerDesc how = nearest;
    how.wrap_u = Wrap::repeat;
    CHECK(red(how, {1.25f, 0.25f, 0, 0}) == 0.0f);
    CHECK(red(how, {-0.25f, 0.25f, 0, 0}) == 1.0f);
    how.wrap_u = Wrap::mirror;
    CHECK(red(how, {1.25f, 0.25f, 0, 0}) == 1.0f);
    CHECK(red(nearest, {0.25f, 0.25f, 0, 1}) == Approx(64.0 / 255.0).margin(1e-6));
    how = nearest;
    how.mipmapped = false;
    CHECK(red(how, {0.25f, 0.25f, 0, 1}) == 0.0f);  // only level 0
    how = {.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    CHECK(red(how, {0.5f, 0.5f, 0, 0}) == Approx(0.5).margin(0.004));
    CHECK(red(how, {0.5f, 0.25f, 0, 0}) == Approx(0.5).margin(0.004));
    CHECK(red(how, {0.25f, 0.25f, 0, 0.5f}) == Approx(32.0 / 255.0).margin(0.004));
}

TEMPLATE_LIST_TEST_CASE("sRGB textures are decoded when they are sampled", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const std::uint8_t texel[] = {188, 0, 255, 64};
    const auto texture = own(*device, device->make_texture({.size = {1, 1},
                                                            .format = Format::rgba8_srgb,
                                                            .initial = std::as_bytes(std::span(texel)),
                                                            .debug_name = "colour"}));
    const auto found = sample(*device, shaders::test_sample_2d_comp, texture, nearest, {{0.5f, 0.5f, 0, 0}})[0];
    CHECK(found[0] == Approx(0.5029).margin(0.004));
    CHECK(found[1] == 0.0f);
    CHECK(found[2] == Approx(1.0).margin(1e-6));
    CHECK(found[3] == Approx(64.0 / 255.0).margin(1e-6));
}

TEMPLATE_LIST_TEST_CASE("cube faces are +x −x +y −y +z −z, as layers 0 … 5", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    // Faces of 2×2; the value is 10·face + 2·row + column.
    std::vector<float> texels;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < 4; ++i) texels.push_back(static_cast<float>(10 * face + i));
    const auto texture = own(*device, device->make_texture({.size = {2, 2},
                                                            .layers = 6,
                                                            .format = Format::r32_float,
                                                            .kind = TextureKind::cube,
                                                            .initial = std::as_bytes(std::span(texels)),
                                                            .debug_name = "cube"}));
    // Directions near a face's corner tell rows and columns: on +x, s runs along −z and t along −y (both APIs' table).
    const auto found = sample(*device, shaders::test_sample_cube_comp, texture, nearest,
                              {{1, 0.5f, 0.5f, 0},
                               {1, -0.5f, 0.5f, 0},
                               {-1, 0.5f, 0.5f, 0},
                               {0.5f, 1, 0.5f, 0},
                               {0.5f, -1, 0.5f, 0},
                               {0.5f, 0.5f, 1, 0},
                               {0.5f, 0.5f, -1, 0}});
    const float expected[] = {0, 2, 11, 23, 31, 41, 50};
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i][0] == expected[i]);
}

TEMPLATE_LIST_TEST_CASE("generated levels are means of 2×2 for even sizes, in every layer", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 8;
    std::vector<float> level(2 * n * n);
    for (std::size_t i = 0; i < level.size(); ++i) level[i] = static_cast<float>((i * 2654435761u >> 8) % 256);
    std::vector<float> texels = level;
    texels.resize(2 * (64 + 16 + 4 + 1));
    const auto texture =
        own(*device, device->make_texture({.size = {n, n},
                                           .layers = 2,
                                           .mips = 4,
                                           .format = Format::r32_float,
                                           .kind = TextureKind::array,
                                           .usage = TextureUsage::sampled | TextureUsage::copy_source |
                                                    TextureUsage::copy_destination | TextureUsage::attachment,
                                           .initial = std::as_bytes(std::span(texels)),
                                           .debug_name = "levels"}));
    test::run(*device, [&](auto& commands) {
        commands.begin_copy({.uses = {use(texture.get(), Access::copy_write)}, .name = "levels"});
        commands.generate_mips(texture);
        commands.end_copy();
    });
    for (std::uint32_t layer = 0; layer < 2; ++layer) {
        std::vector<float> above(level.begin() + layer * n * n, level.begin() + (layer + 1) * n * n);
        for (std::uint32_t mip = 1; mip < 4; ++mip) {
            const std::uint32_t width = n >> mip;
            const auto found = test::read<float>(*device, texture, {width, width}, 1, mip, layer);
            std::vector<float> here(width * width);
            for (std::uint32_t y = 0; y < width; ++y)
                for (std::uint32_t x = 0; x < width; ++x) {
                    const float* at = &above[2 * y * 2 * width + 2 * x];
                    here[y * width + x] = (at[0] + at[1] + at[2 * width] + at[2 * width + 1]) / 4;
                    CHECK(*found.texel(x, y) == Approx(here[y * width + x]).epsilon(2e-3));
                }
            above = here;
        }
    }
}

TEMPLATE_LIST_TEST_CASE("copies between buffers and textures keep rows, levels, layers and offsets", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    std::vector<std::uint32_t> words(4 + 15);  // level 1 is 5×3: rows of 20 bytes, so no alignment helps
    for (std::uint32_t i = 0; i < 15; ++i) words[4 + i] = 0x01020304u * (i + 1);
    const auto source = own(*device, device->make_buffer({.size = words.size() * 4,
                                                          .usage = BufferUsage::copy_source,
                                                          .initial = std::as_bytes(std::span(words)),
                                                          .debug_name = "source"}));
    for (auto format : {Format::rgba8_unorm, Format::r32_uint, Format::r32_float}) {
        const auto texture =
            own(*device, device->make_texture({.size = {10, 6},
                                               .layers = 2,
                                               .mips = 2,
                                               .format = format,
                                               .kind = TextureKind::array,
                                               .usage = TextureUsage::copy_source | TextureUsage::copy_destination |
                                                        TextureUsage::sampled,
                                               .debug_name = "copied"}));
        const auto target = own(*device, device->make_buffer({.size = 32 + 60,
                                                              .usage = BufferUsage::copy_destination,
                                                              .memory = Memory::readback,
                                                              .debug_name = "target"}));
        test::run(*device, [&](auto& commands) {
            commands.begin_copy({.uses = {use(source.get(), Access::copy_read), use(texture.get(), Access::copy_write)},
                                 .name = "to the texture"});
            commands.copy(source.get(), texture.get(), TextureCopy{.mip = 1, .layer = 1, .buffer_offset = 16});
            commands.end_copy();
            commands.begin_copy({.uses = {use(texture.get(), Access::copy_read), use(target.get(), Access::copy_write)},
                                 .name = "from the texture"});
            commands.copy(texture.get(), target.get(), TextureCopy{.mip = 1, .layer = 1, .buffer_offset = 32});
            commands.end_copy();
        });
        CHECK(std::memcmp(device->mapped(target).data() + 32, words.data() + 4, 60) == 0);
    }
}
