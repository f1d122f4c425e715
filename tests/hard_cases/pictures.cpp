// SPDX-License-Identifier: MIT
// Pictures of awkward sizes, of nothing, and alpha that comes from textures.
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

constexpr std::uint32_t layers_of_sheets = 7;

/// Seven sheets over a picture of any size.
KnownScene sheets(Extent2D size) {
    std::vector<Sheet> out;
    std::vector<Layer> layers;
    for (std::uint32_t i = 0; i < layers_of_sheets; ++i) {
        const glm::vec4 color{static_cast<float>(i) / 8.0f, 1 - static_cast<float>(i) / 8.0f, 0.5f, 0.375f};
        out.push_back({.slot = 10 + 20 * i, .color = color});
        layers.insert(layers.begin(), straight(color));
    }
    return uniform_scene(std::to_string(size.width) + "x" + std::to_string(size.height), make_sheets(out), size,
                         known_pixel(std::move(layers)));
}

/// Three sheets of a texture of 4 x 4 alphas, turned, moved and repeated by their texture transforms, sampled at texel
/// centres and between.
KnownScene textured(std::uint32_t n) {
    constexpr std::uint8_t alphas[16] = {0, 255, 1, 254, 17, 34, 51, 68, 85, 102, 119, 136, 153, 170, 187, 204};
    Image8 image(4, 4, 4);
    for (std::size_t i = 0; i < 16; ++i) {
        std::fill_n(image.data.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, std::uint8_t{255});  // linear 1
        image.data[4 * i + 3] = alphas[i];
    }
    Scene scene;
    scene.images.push_back({std::move(image), "alphas"});
    scene.textures.push_back({.image = 0,
                              .sampler = {.min = TextureFilter::nearest,
                                          .mag = TextureFilter::nearest,
                                          .mip = TextureFilter::nearest,
                                          .mipmapped = false}});
    const glm::vec3 colors[] = {{1, 0.25f, 0.5f}, {0.25f, 1, 0.5f}, {0.5f, 0.25f, 1}};
    for (int i = 0; i < 3; ++i) {
        Material m = flat({colors[i], 1}, AlphaMode::blend);
        m.base_color_texture = {.texture = 0, .offset = {0.25f * static_cast<float>(i), 0.0f}};
        m.premultiplied = i == 1;
        add(scene, quad(), m, at(0, 0, i));
    }
    scene.cameras.push_back(flat_camera());
    KnownScene known = uniform_scene("alpha from textures", std::move(scene), {n, n}, {});
    known.settings.background = {0.25f, 0.5f, 0.125f};
    known.pixels.clear();
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t column = 0; column < 4; ++column) {
            std::vector<Layer> layers;
            for (int i = 2; i >= 0; --i) {
                const double alpha = alphas[4 * row + (column + static_cast<std::uint32_t>(i)) % 4] / 255.0;
                layers.push_back({glm::dvec3(colors[i]) * (i == 1 ? 1.0 : alpha), alpha});
            }
            known.pixels.push_back(known_pixel(std::move(layers), glm::dvec3(known.settings.background)));
        }
    known.at = [n](std::uint32_t x, std::uint32_t y) { return std::size_t{4 * y / n} * 4 + 4 * x / n; };
    return known;
}

/// A scene with a translucent instance that has no triangle.
KnownScene nothing() {
    KnownScene known{
        .name = "translucent instances without triangles", .camera = flat_camera(), .settings = settings_for(16)};
    known.settings.background = {0.25f, 0.5f, 0.125f};
    Mesh mesh = quad();
    mesh.indices.clear();
    add(known.scene, mesh, flat({1, 1, 1, 0.5f}, AlphaMode::blend));
    known.pixels = {known_pixel({}, {0.25, 0.5, 0.125})};
    known.at = [](std::uint32_t, std::uint32_t) { return std::size_t{0}; };
    return known;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: pictures whose sides are no multiple of 8", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Extent2D size : {Extent2D{1, 1}, {7, 5}, {1, 9}, {257, 66}}) {
        const KnownScene known = sheets(size);
        check_known(known);
        check_exact<TestType>(*device, known);
        check_within<TestType>(*device, known, Transparency::dual_peel);
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: alpha from textures", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = textured(64);
    check_known(known);
    check_exact<TestType>(*device, known);
    check_as_if_lit<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
}

TEMPLATE_LIST_TEST_CASE("hard cases: no translucent surface, though one might be", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    KnownScene known = nothing();
    check_exact<TestType>(*device, known);
    for (const Transparency method : all_methods())
        if (facts(method).exact < Exactness::without_light) check_within<TestType>(*device, known, method);
    // Something opaque, and every pass built whether it is needed or not.
    known.name = "nothing translucent, everything built";
    known.scene = {};
    add(known.scene, quad(), flat({0.5f, 0.25f, 1, 1}));
    known.pixels = {known_pixel({}, {0.5, 0.25, 1})};
    known.settings.every_need = true;
    check_known(known);
    check_exact<TestType>(*device, known);
    for (const Transparency method : all_methods())
        if (facts(method).exact < Exactness::without_light) check_within<TestType>(*device, known, method);
}

TEST_CASE("hard cases: awkward pictures are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{sheets({65, 33}), textured(64)});
}
