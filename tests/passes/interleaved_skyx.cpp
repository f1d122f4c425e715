// SPDX-License-Identifier: MIT
// SkyXEngine's interleaved translucency against a model of it on the CPU, and each of its defects by name.
#include <algorithm>
#include <array>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <set>
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// What a pixel of the shared G-buffer holds.
struct Held {
    glm::dvec3 radiance{0, 0, 0};
    double alpha = 1;
    float depth = 0;
    std::uint32_t id = 0;
    bool translucent = false;
};

/// The surface that the pixel keeps: what is opaque, or the last of as many translucent ones, in draw order, as its
/// place in the 2×2 quad is entitled to.
Held held(const Scene& scene, const RenderSettings& settings, std::uint32_t x, std::uint32_t y) {
    auto fragments = must(reference::fragments_at(
        scene, scene.cameras.front(),
        {.size = settings.size, .background = glm::dvec3(settings.background), .lights = scene.lights}, x, y));
    Held out{.radiance = glm::dvec3(settings.background)};
    if (!fragments.empty() && fragments.back().opaque) {
        const auto& f = fragments.back();
        out = {.radiance = f.radiance, .depth = static_cast<float>(f.depth), .id = 1};
        fragments.pop_back();
    }
    std::sort(fragments.begin(), fragments.end(),
              [](const auto& a, const auto& b) { return a.primitive < b.primitive; });
    std::uint32_t entitled = 2 * (x % 2) + y % 2;
    for (const auto& f : fragments) {
        if (f.alpha < 8 / 255.0 || entitled == 0) continue;
        --entitled;
        out = {f.radiance, f.alpha, static_cast<float>(f.depth), 2 + f.instance % 126, true};
    }
    return out;
}

/// The picture at (x, y), from the four pixels of its window.
glm::dvec3 united(std::array<Held, 4> window) {
    if (std::none_of(window.begin(), window.end(), [](const Held& h) { return h.translucent; }))
        return window[0].radiance;
    std::stable_sort(window.begin(), window.end(), [](const Held& a, const Held& b) { return a.depth > b.depth; });
    glm::dvec3 color = window[3].radiance;
    std::set<std::uint32_t> used{window[3].id};
    for (int i = 2; i >= 0; --i) {
        const Held& h = window[static_cast<std::size_t>(i)];
        if (used.insert(h.id).second || h.id == 0) color = h.radiance * h.alpha + color * (1 - h.alpha);
    }
    return color;
}

/// Radiance goes through the G-buffer as emitted light, in binary16; base colours would have 8 bits.
Scene glowing(Scene scene) {
    for (Material& m : scene.materials) {
        m.emissive = glm::vec3(m.base_color);
        m.base_color = {0, 0, 0, m.base_color.a};
        m.unlit = false;
    }
    scene.lights.clear();
    return scene;
}

RenderSettings skyx(std::uint32_t size, glm::vec3 background = {0, 0, 0}) {
    RenderSettings settings = settings_for(size);
    settings.background = background;
    settings.transparency = Transparency::interleaved_skyx;
    return settings;
}

/// A scene and what the pixels of its picture hold.
struct Model {
    static constexpr std::uint32_t side = 48;
    static constexpr glm::vec3 background{0.25f, 0.125f, 0.5f};

    explicit Model(Scene of) : scene(glowing(std::move(of))) {
        const RenderSettings settings = skyx(side, background);
        stable =
            must(reference::render(scene, scene.cameras.front(), {.size = settings.size, .stability = true})).stable;
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) pixels.push_back(held(scene, settings, x, y));
    }
    Scene scene;
    Image8 stable;
    std::vector<Held> pixels;
};

struct Difference {
    std::size_t judged = 0, wrong = 0;
};

/// Pixels of which the whole window is stable, and those that are not as the model has them, within what two roundings
/// to binary16 and four layers of arithmetic may do.
Difference difference(const ImageF& hdr, const Model& model) {
    Difference out;
    for (std::uint32_t y = 0; y + 1 < Model::side; ++y)
        for (std::uint32_t x = 0; x + 1 < Model::side; ++x) {
            std::array<Held, 4> window;
            bool stable = true;
            for (std::uint32_t i = 0; i < 4; ++i) {  // rows within columns, which is the order of equal depths
                const std::uint32_t u = x + i / 2, v = y + i % 2;
                window[i] = model.pixels[v * Model::side + u];
                stable = stable && *model.stable.texel(u, v) == 255;
            }
            if (!stable) continue;
            const glm::dvec3 wanted = united(window);
            ++out.judged;
            bool right = true;
            for (int c = 0; c < 3; ++c)
                right = right && std::abs(hdr.texel(x, y)[c] - wanted[c]) <= 0x1p-9 * std::max(1.0, wanted[c]);
            out.wrong += !right;
        }
    return out;
}

/// Instances that lie behind themselves, in each other.
Scene make_balls() {
    Scene scene;
    add(scene, make_uv_sphere(0.6f, 6, 10), flat({1, 0.5f, 0, 0.5f}, AlphaMode::blend), at(-0.2, 0, 0));
    add(scene, make_uv_sphere(0.6f, 6, 10), flat({0, 0.5f, 1, 0.75f}, AlphaMode::blend), at(0.3, 0.1, 0.2));
    add(scene, quad(0.9f, 0.3f), flat({0.5f, 1, 0.5f, 0.25f}, AlphaMode::blend), at(0, 0.1, 0.3));
    for (Material& m : scene.materials) m.double_sided = true;
    scene.cameras.push_back(flat_camera());
    return scene;
}

glm::dvec3 texel(const ImageF& image, std::uint32_t x, std::uint32_t y) {
    const float* t = image.texel(x, y);
    return {t[0], t[1], t[2]};
}
bool near(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::all(glm::lessThan(glm::abs(a - b), glm::dvec3(0x1p-9)));
}

constexpr glm::vec4 red{1, 0, 0, 0.5f}, green{0, 1, 0, 0.5f}, blue{0, 0, 1, 0.5f}, white{1, 1, 1, 0.5f};

/// Colour over black of straight layers of alpha 1/2, nearest first.
glm::dvec3 halves(std::initializer_list<glm::vec4> layers) {
    glm::dvec3 out(0);
    double through = 1;
    for (const glm::vec4& c : layers) {
        out += glm::dvec3(c) * (0.5 * through);
        through *= 0.5;
    }
    return out;
}

template <rhi::Backend B>
glm::dvec3 middle(typename B::Device& device, const std::vector<Sheet>& sheets) {
    const Scene scene = glowing(make_sheets(sheets));
    return texel(shoot<B>(device, scene, scene.cameras.front(), skyx(8)).hdr, 4, 4);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("interleaved_skyx: scenes come out as its model on the CPU has them", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    static const Model models[] = {Model(make_random_quads(24, 3)), Model(make_intersecting_planes()),
                                   Model(make_balls())};
    for (const Model& model : models)
        for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
            for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
                RenderSettings settings = skyx(Model::side, Model::background);
                settings.gbuffer = layout;
                settings.shading = stage;
                const auto shot = shoot<TestType>(*device, model.scene, model.scene.cameras.front(), settings);
                const Difference d = difference(shot.hdr, model);
                INFO(name(layout) << " " << name(stage));
                CHECK(d.judged > 300);
                CHECK(d.wrong == 0);
            }
}

TEMPLATE_LIST_TEST_CASE("interleaved_skyx: three layers are right in any order, and the fourth is lost", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    CHECK(near(middle<TestType>(*device, {{150, red}, {100, green}, {50, blue}}), halves({red, green, blue})));
    CHECK(near(middle<TestType>(*device, {{50, blue}, {100, green}, {150, red}}), halves({red, green, blue})));
    CHECK(near(middle<TestType>(*device, {{100, green}, {150, red}, {50, blue}}), halves({red, green, blue})));
    // The nearest of four was drawn last: it is not there.
    CHECK(near(middle<TestType>(*device, {{50, blue}, {100, green}, {150, red}, {200, white}}),
               halves({red, green, blue})));
}

TEMPLATE_LIST_TEST_CASE("interleaved_skyx: one instance gives one layer, and 126 are as many as it can tell apart",
                        "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Both sheets in one mesh: the one that was drawn first is in one pixel only, and its id is taken.
    Scene twice;
    Mesh mesh = quad();
    for (int i = 0; i < 4; ++i)
        mesh.positions.push_back(mesh.positions[static_cast<std::size_t>(i)] + glm::vec3(0, 0, 1));
    mesh.normals.resize(8, {0, 0, 1});
    mesh.uv0.clear();
    for (int i = 0; i < 6; ++i) mesh.indices.push_back(mesh.indices[static_cast<std::size_t>(i)] + 4);
    update_bounds(mesh);
    add(twice, mesh, flat(white, AlphaMode::blend));
    twice.cameras.push_back(flat_camera());
    const Scene one = glowing(twice);
    CHECK(near(texel(shoot<TestType>(*device, one, one.cameras.front(), skyx(8)).hdr, 4, 4), halves({white})));

    for (const std::uint32_t between : {124u, 125u}) {
        std::vector<Sheet> sheets{{50, red}};
        for (std::uint32_t i = 0; i < between; ++i) sheets.push_back({40, {1, 1, 1, 0}});  // too thin to be drawn
        sheets.push_back({100, green});
        const glm::dvec3 wanted = between == 125 ? halves({red}) : halves({green, red});
        CHECK(near(middle<TestType>(*device, sheets), wanted));
    }
}

TEMPLATE_LIST_TEST_CASE("interleaved_skyx: alpha below 8/255 is not drawn", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    CHECK(near(middle<TestType>(*device, {{50, {1, 1, 1, 7 / 255.0f}}}), {0, 0, 0}));
    CHECK(near(middle<TestType>(*device, {{50, {1, 1, 1, 8 / 255.0f}}}), glm::dvec3(8 / 255.0)));
}

TEMPLATE_LIST_TEST_CASE(
    "interleaved_skyx: what is opaque has half its resolution behind glass, and the whole elsewhere", "[gpu]",
    Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 32;
    // Columns of pixels, white and black in turn, with glass over the right half.
    Scene scene;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float shade = i % 2 == 0 ? 1.0f : 0.0f;
        add(scene, quad(1.0f / n, 1), flat({shade, shade, shade, 1}), at((2.0 * i + 1) / n - 1, 0, -1));
    }
    add(scene, quad(0.5f, 1), flat({0, 0, 0, 0.5f}, AlphaMode::blend), at(0.5, 0, 0));
    scene.cameras.push_back(flat_camera());
    scene = glowing(scene);
    const ImageF picture = shoot<TestType>(*device, scene, scene.cameras.front(), skyx(n)).hdr;
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            // The stripes of even columns are what three pixels of four see of it, the one at the start included.
            const double wanted = x + 1 < n / 2 ? (x % 2 == 0 ? 1 : 0) : 0.5;
            wrong += !near(texel(picture, x, y), glm::dvec3(wanted));
        }
    CHECK(wrong == 0);
    // A column left of the glass sees it already: silhouettes grow by a pixel.
    CHECK(near(texel(picture, n / 2 - 1, n / 2), glm::dvec3(0.5)));
}

TEMPLATE_LIST_TEST_CASE("interleaved_skyx: the gain of 1.1 changes alpha and no colour", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = glowing(make_sheets({{50, blue}, {100, green}, {150, red}}));
    RenderSettings settings = skyx(16);
    const ImageF plain = shoot<TestType>(*device, scene, scene.cameras.front(), settings).hdr;
    settings.skyx_alpha_gain = true;
    const ImageF gained = shoot<TestType>(*device, scene, scene.cameras.front(), settings).hdr;
    std::size_t colors = 0;
    for (std::size_t i = 0; i < plain.data.size(); i += 4)
        colors += !std::equal(&plain.data[i], &plain.data[i] + 3, &gained.data[i]);
    CHECK(colors == 0);
    CHECK(plain.texel(4, 4)[3] == 1.0f);
    CHECK(std::abs(gained.texel(4, 4)[3] - 1.1 * 1.1 * 1.1) <= 0x1p-9);
}
