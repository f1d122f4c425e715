// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Scenes with answers in closed form.  Many small cases share one picture: a grid of patches, each with sheets of its
/// own, square to the view.
#include <cmath>
#include <pellucid/scene/sample_scenes.hpp>
#include <utility>
#include "support/scene.hpp"
#include "support/transparency.hpp"

namespace pellucid::test {

/// Depth as in `make_sheets`: the camera sees distances from 0 to 1, slot k lies at distance 1 - k 2^-bits, and its
/// depth is k 2^-bits to the bit.
class Patches {
public:
    static constexpr std::uint32_t side = 8;

    Patches(std::string name, std::uint32_t columns, std::uint32_t rows, std::uint32_t bits = 8,
            const glm::vec3& background = {0, 0, 0})
        : columns_(columns), rows_(rows), bits_(bits) {
        known_.name = std::move(name);
        known_.settings = settings_for(1);
        known_.settings.size = {columns * side, rows * side};
        known_.settings.background = background;
        known_.camera = {
            .projection = Projection::orthographic, .half_width = 1, .half_height = 1, .near = 0, .far = 1};
        known_.pixels.assign(std::size_t{columns} * rows, known_pixel({}, glm::dvec3(background)));
        known_.at = [columns](std::uint32_t x, std::uint32_t y) { return std::size_t{y / side} * columns + x / side; };
    }

    /// Draws one more sheet over patch `p`.  Slot 2^bits is the near plane, 0 the far one.
    std::uint32_t add(std::size_t p, std::uint32_t slot, const Material& material) {
        const auto column = static_cast<double>(p % columns_), row = static_cast<double>(p / columns_);
        const double aspect = static_cast<double>(columns_) / rows_;
        const double left = aspect * (2 * column / columns_ - 1), right = aspect * (2 * (column + 1) / columns_ - 1);
        const double top = 1 - 2 * row / rows_, bottom = 1 - 2 * (row + 1) / rows_;
        const double z = -std::ldexp(static_cast<double>((std::int64_t{1} << bits_) - slot), -static_cast<int>(bits_));
        Mesh mesh;
        for (const glm::dvec2 corner :
             {glm::dvec2(left, top), glm::dvec2(left, bottom), glm::dvec2(right, bottom), glm::dvec2(right, top)})
            mesh.positions.push_back(glm::vec3(glm::dvec3(corner, z)));
        mesh.normals.assign(4, {0, 0, 1});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        update_bounds(mesh);
        return test::add(known_.scene, std::move(mesh), material);
    }
    /// The same, of an unlit translucent material.
    std::uint32_t add(std::size_t p, std::uint32_t slot, const glm::vec4& color) {
        return add(p, slot, flat(color, AlphaMode::blend));
    }
    /// What patch `p` must show.
    void expect(std::size_t p, KnownPixel pixel) { known_.pixels[p] = std::move(pixel); }
    void expect(std::size_t p, std::vector<Layer> nearest_first) {
        known_.pixels[p] = known_pixel(std::move(nearest_first), glm::dvec3(known_.settings.background));
    }

    [[nodiscard]] const KnownScene& known() const { return known_; }
    [[nodiscard]] Scene& scene() { return known_.scene; }
    [[nodiscard]] std::size_t count() const { return known_.pixels.size(); }

private:
    KnownScene known_;
    std::uint32_t columns_, rows_, bits_;
};

/// A scene that looks the same at every pixel.
[[nodiscard]] inline KnownScene uniform_scene(std::string name, Scene scene, Extent2D size, KnownPixel pixel) {
    KnownScene known{.name = std::move(name), .scene = std::move(scene), .settings = settings_for(1)};
    known.settings.size = size;
    known.camera = known.scene.cameras.front();
    known.pixels.push_back(std::move(pixel));
    known.at = [](std::uint32_t, std::uint32_t) { return std::size_t{0}; };
    return known;
}

/// Checks that every pixel of a picture of `scene` shows `layers`, the nearest first, over `behind`.
inline void check_layers(const ImageF& hdr, const Scene& scene, std::vector<Layer> layers, const glm::dvec3& behind,
                         Transparency method, bool software) {
    const KnownScene known =
        uniform_scene("layers", scene, {hdr.width, hdr.height}, known_pixel(std::move(layers), behind));
    const Verdict verdict = judge(hdr, known, method, software);
    INFO(verdict.first);
    CHECK(verdict.outside == 0);
}

/// A surface of any radiance, not lit.
[[nodiscard]] inline Material shining(const glm::vec3& radiance, float alpha = 1, AlphaMode mode = AlphaMode::blend) {
    Material m = matte({0, 0, 0});
    m.base_color.a = alpha;
    m.emissive = radiance;
    m.alpha_mode = mode;
    return m;
}
/// What adds its radiance and hides nothing.
[[nodiscard]] inline Material glowing(const glm::vec3& radiance) {
    Material m = shining(radiance, 0);
    m.premultiplied = true;
    return m;
}

/// Colours and alphas of three kinds of sheets.
inline constexpr glm::vec4 sheet_kinds[] = {
    {1, 0.25f, 0.5f, 0.25f}, {0.25f, 1, 0.75f, 0.125f}, {0.5f, 0.125f, 1, 0.375f}};

/// `count` sheets, sheet i in slot 1 + i and of kind i mod 3, as triangles of one mesh; `layers`: what they are,
/// nearest first.
[[nodiscard]] inline Scene stacked_sheets(std::uint32_t count, std::vector<Layer>& layers) {
    std::vector<Sheet> out;
    layers.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        out.push_back({.slot = 1 + i, .color = sheet_kinds[i % 3]});
        layers.insert(layers.begin(), straight(sheet_kinds[i % 3]));
    }
    return make_sheets(out);
}

}  // namespace pellucid::test
