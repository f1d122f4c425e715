// SPDX-License-Identifier: MIT
// The prefiltered cube map that a device makes of a picture, against integrals in double; and what is seen of it.
#include <cstring>
#include <pellucid/passes/environment.hpp>
#include <pellucid/reference/image_based_light.hpp>
#include <pellucid/reference/renderer.hpp>
#include "support/assets.hpp"
#include "support/scene.hpp"

using namespace pellucid;

namespace {

/// A sky with a bright patch of a few texels, and another colour in every quarter: nothing in it is symmetric.
ImageF made_picture(std::uint32_t height = 64) {
    ImageF out(2 * height, height, 3);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < 2 * height; ++x) {
            float* const t = out.texel(x, y);
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(2 * height);
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
            t[0] = 0.2f + 0.5f * u;
            t[1] = 0.7f - 0.6f * v;
            t[2] = u < 0.5f ? 0.3f : 0.9f * v;
            if (x / 3 == height / 6 && y / 3 == height / 12) t[0] = t[1] = 60;  // a sun
        }
    return out;
}

/// The levels of a cube that the device made, faces in order.
template <rhi::Backend B>
std::vector<std::array<ImageF, 6>> made_levels(typename B::Device& device, const ImageF& picture, std::uint32_t size) {
    const auto pass = test::must(EnvironmentPass<B>::create(device, picture, size));
    auto* const cmd = test::must(device.begin_frame());
    pass.record(*cmd);
    test::must(device.wait(test::must(device.submit())));
    std::vector<std::array<ImageF, 6>> out(pass.levels());
    const rhi::TextureDesc desc{
        .size = {size, size}, .layers = 6, .mips = pass.levels(), .format = rhi::Format::rgba16_float};
    for (std::uint32_t level = 0; level < pass.levels(); ++level)
        for (std::uint32_t face = 0; face < 6; ++face) {
            const rhi::Texels texels = test::must(rhi::download<B>(device, pass.cube(), desc, level, face));
            ImageF& image = out[level][face] = ImageF(size >> level, size >> level, 3);
            for (std::uint32_t y = 0; y < image.height; ++y)
                for (std::uint32_t x = 0; x < image.width; ++x) {
                    const auto halves = texels.template at<std::array<std::uint16_t, 4>>(x, y);
                    for (std::size_t c = 0; c < 3; ++c) image.texel(x, y)[c] = half_to_float(halves[c]);
                }
        }
    return out;
}

struct LevelError {
    double rms = 0, worst = 0;  ///< relative to the level's mean
};
LevelError error_of(const std::array<ImageF, 6>& level, const ImageF& picture, double roughness) {
    LevelError error;
    double mean = 0, squares = 0;
    std::size_t count = 0;
    const std::uint32_t side = level[0].width, step = std::max(1u, side / 4);
    const auto radiance = [&](glm::dvec3 d) { return reference::environment_radiance(picture, d); };
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t y = step / 2; y < side; y += step)
            for (std::uint32_t x = step / 2; x < side; x += step) {
                const glm::dvec3 axis = reference::cube_direction(face, (glm::dvec2(x, y) + 0.5) / double(side));
                const double alpha = roughness * roughness;
                const glm::dvec3 wanted = alpha > 0.02 ? reference::prefiltered_radiance(picture, axis, alpha)
                                                       : reference::prefiltered_radiance(radiance, axis, alpha, 256);
                for (int c = 0; c < 3; ++c) {
                    const double off = level[face].texel(x, y)[c] - wanted[c];
                    REQUIRE(std::isfinite(off));
                    squares += off * off;
                    mean += wanted[c];
                    error.worst = std::max(error.worst, std::abs(off));
                    ++count;
                }
            }
    mean /= static_cast<double>(count);
    error.rms = std::sqrt(squares / static_cast<double>(count)) / mean;
    error.worst /= mean;
    return error;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("levels of the cube are the picture prefiltered", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const ImageF picture = made_picture();
    const auto levels = made_levels<TestType>(*device, picture, 64);
    REQUIRE(levels.size() == 4);  // 64, 32, 16, 8
    for (std::uint32_t l = 1; l < levels.size(); ++l) {
        const double roughness = environment_roughness(l, 4);
        const LevelError e = error_of(levels[l], picture, roughness);
        std::printf("%s: roughness %.2f off by %.3g RMS, %.3g at worst, of the mean\n", TestType::name, roughness,
                    e.rms, e.worst);
        CHECK(e.rms <= (roughness < 0.2 ? 0.02 : 0.004));
        CHECK(e.worst <= (roughness < 0.2 ? 0.1 : 0.02));
    }
}

TEMPLATE_LIST_TEST_CASE("a picture of one radiance stays what it is at every level, edge and corner", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    ImageF picture(32, 16, 3);
    std::fill(picture.data.begin(), picture.data.end(), 0.75f);
    for (const auto& level : made_levels<TestType>(*device, picture, 32))
        for (const ImageF& face : level)
            for (const float value : face.data) REQUIRE(std::abs(value - 0.75f) <= 0.75f * 0x1p-10f);
}

TEMPLATE_LIST_TEST_CASE("what is brighter than a half stays finite", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    ImageF picture(32, 16, 3);
    std::fill(picture.data.begin(), picture.data.end(), 1e6f);
    for (const auto& level : made_levels<TestType>(*device, picture, 16))
        for (const ImageF& face : level)
            for (const float value : face.data) REQUIRE(value == 65504.0f);
}

namespace {

/// Spheres of five roughnesses, metal above and dielectric below.
Scene sphere_rows() {
    Scene scene;
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i < 5; ++i)
            test::add(scene, make_uv_sphere(0.46f, 48, 96),
                      {.base_color = {1, 0.8f, 0.5f, 1},
                       .metallic = row == 0 ? 1.0f : 0.0f,
                       .roughness = 0.25f * static_cast<float>(i)},
                      test::at(i - 2.0, 0.5 - row, 0));
    return scene;
}
Camera rows_camera() {
    return {.projection = Projection::orthographic,
            .half_width = 2.5,
            .half_height = 1,
            .near = 1,
            .far = 9,
            .world_from_view = look_at({0, 0, 5}, {0, 0, 0})};
}
RenderSettings rows_settings() {
    RenderSettings s = test::settings_for(1);
    s.size = {160, 64};
    s.keep_gbuffer = false;
    return s;
}

double scaled_rmse(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (std::uint32_t y = 0; y < a.height; ++y)
        for (std::uint32_t x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double wanted = b.texel(x, y)[c], off = (a.texel(x, y)[c] - wanted) / std::max(1.0, wanted);
                sum += off * off;
            }
    return std::sqrt(sum / (3.0 * a.width * a.height));
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("under a white sky what reflects all is invisible", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = sphere_rows();
    for (Material& m : scene.materials) m.base_color = {1, 1, 1, 1};
    RenderSettings settings = rows_settings();
    settings.environment = {.kind = EnvironmentKind::sky, .sky = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
    settings.brdf = Brdf::conserving;
    const auto shot = test::shoot<TestType>(*device, scene, rows_camera(), settings);
    float least = 2, most = 0;
    for (std::uint32_t y = 0; y < shot.hdr.height; ++y)
        for (std::uint32_t x = 0; x < shot.hdr.width; ++x)
            for (int c = 0; c < 3; ++c) {
                least = std::min(least, shot.hdr.texel(x, y)[c]);
                most = std::max(most, shot.hdr.texel(x, y)[c]);
            }
    std::printf("%s: white furnace from %.5f to %.5f\n", TestType::name, static_cast<double>(least),
                static_cast<double>(most));
    CHECK(least >= 0.998f);
    CHECK(most <= 1.001f);
    // glTF's model has no second lobe: rough metals lose most of the light.
    settings.brdf = Brdf::gltf;
    const auto lossy = test::shoot<TestType>(*device, scene, rows_camera(), settings);
    CHECK(lossy.hdr.texel(144, 16)[0] < 0.5f);
    CHECK(lossy.hdr.texel(144, 48)[0] >= 0.998f);  // its diffuse part takes what the lobe leaves
}

TEMPLATE_LIST_TEST_CASE("sky and picture light surfaces as the reference says", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = sphere_rows();
    for (const EnvironmentKind kind : {EnvironmentKind::sky, EnvironmentKind::picture})
        for (const Brdf brdf : {Brdf::gltf, Brdf::conserving}) {
            RenderSettings settings = rows_settings();
            settings.environment.kind = kind;
            settings.environment.size = 64;
            if (kind == EnvironmentKind::picture)
                settings.environment.picture = std::make_shared<const ImageF>(made_picture());
            settings.brdf = brdf;
            const auto shot = test::shoot<TestType>(*device, scene, rows_camera(), settings);
            const auto picture = test::must(reference::render(scene, rows_camera(),
                                                              {.size = settings.size,
                                                               .brdf = static_cast<reference::BrdfModel>(brdf),
                                                               .environment = settings.environment,
                                                               .stability = true}));
            ImageF seen = shot.hdr;
            for (std::uint32_t y = 0; y < seen.height; ++y)
                for (std::uint32_t x = 0; x < seen.width; ++x)
                    if (*picture.stable.texel(x, y) == 0)
                        for (int c = 0; c < 3; ++c) seen.texel(x, y)[c] = picture.radiance.texel(x, y)[c];
            const double rmse = scaled_rmse(seen, picture.radiance);
            std::printf("%s: %s, %s: scaled RMSE %.3g\n", TestType::name, name(kind), name(brdf), rmse);
            // A picture's levels are interpolated in roughness, and its mirror images in texels: 0.0113 here.
            CHECK(rmse <= (kind == EnvironmentKind::sky ? 0.002 : 0.015));
        }
}

TEMPLATE_LIST_TEST_CASE("an environment replaces the background where it is to be seen, and changes nothing where not",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    RenderSettings settings = rows_settings();
    settings.background = {0.25f, 0.5f, 0.75f};
    settings.environment.kind = EnvironmentKind::sky;
    const Camera up{.near = 0.1, .world_from_view = look_at({0, 0, 0}, {0, 1, -1})};
    const auto seen = test::shoot<TestType>(*device, {}, up, settings);
    const glm::dvec3 middle = sky_radiance(settings.environment.sky, std::sqrt(0.5));
    for (int c = 0; c < 3; ++c) CHECK(seen.hdr.texel(80, 32)[c] == Approx(middle[c]).epsilon(0.006));
    CHECK(seen.hdr.texel(0, 0)[3] == 1);
    settings.environment.backdrop = false;
    const auto hidden = test::shoot<TestType>(*device, {}, up, settings);
    CHECK(hidden.hdr.texel(80, 32)[0] == 0.25f);
    CHECK_FALSE(hidden.renderer->needs().lighting);
}
