// SPDX-License-Identifier: MIT
// Positions that come back from depth: the shader functions alone, and the whole path from a scene far from the origin.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include "reference/sampling.hpp"
#include "support/gpu.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::own;

namespace {
constexpr Extent2D size{256, 256};

/// The part of the frame's parameters that the position functions read.
gpu::FrameParams frame_params(const Camera& camera) {
    gpu::FrameParams f{};
    const ClipFromView c = clip_from_view(camera, size);
    auto narrow = [](double v) { return static_cast<float>(v); };
    f.clip_scale = {narrow(c.sx), narrow(c.sy), narrow(c.ox), narrow(c.oy)};
    f.clip_depth = {narrow(c.zz), narrow(c.zw), narrow(c.wz), narrow(c.ww)};
    f.view_scale = {narrow(1 / c.sx), narrow(1 / c.sy), 0, 0};
    f.pixel = {2.0f / size.width, 2.0f / size.height, narrow(size.width), narrow(size.height)};
    return f;
}

template <rhi::Backend B>
std::vector<gpu::vec4> round_trip(typename B::Device& device, const Camera& camera, const std::vector<gpu::vec4>& in) {
    const std::span<const gpu::vec4> values(in);
    const auto buffer =
        own(device, device.make_buffer({.size = values.size_bytes(),
                                        .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_source,
                                        .initial = rhi::bytes_of(values),
                                        .debug_name = "points"}));
    const rhi::GroupLayout layout{{{12, rhi::BindingKind::storage_buffer}}};
    const auto group =
        own(device, device.make_group({.layout = layout, .bindings = {{.binding = 12, .buffer = buffer}}}));
    const rhi::SpecConstant constants[] = {{0, PELLUCID_NEED_ALL}};
    const auto pipeline =
        own(device, device.make_pipeline(rhi::ComputePipelineDesc{
                        .compute = &shaders::test_position_comp, .constants = constants, .pass_group = layout}));
    test::run(device, [&](auto& cmd) {
        const auto frame = test::must(cmd.upload_uniforms(rhi::bytes_of(frame_params(camera))));
        cmd.begin_compute({.uses = {rhi::use(buffer.get(), rhi::Access::storage_read_write)}, .name = "position"});
        cmd.bind_pipeline(pipeline);
        cmd.bind_frame(frame, {});
        cmd.bind_group(group);
        cmd.dispatch(static_cast<std::uint32_t>((in.size() + 63) / 64), 1, 1);
        cmd.end_compute();
    });
    return test::read<gpu::vec4>(device, buffer, in.size());
}

/// Points on the rays through pixel centres, at distances that are uniform in their logarithm over [near, far].
std::vector<gpu::vec4> points(const Camera& camera, double far, std::size_t count) {
    const ClipFromView clip = clip_from_view(camera, size);
    test::Random random(3);
    std::vector<gpu::vec4> out;
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<std::uint32_t>(random.uniform(0, size.width));
        const auto y = static_cast<std::uint32_t>(random.uniform(0, size.height));
        const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, size);
        const double z = -camera.near * std::pow(far / camera.near, random.uniform(0.001, 0.999));
        const double w = z * clip.wz + clip.ww;
        out.push_back({static_cast<float>((ndc.x * w - clip.ox) / clip.sx),
                       static_cast<float>((ndc.y * w - clip.oy) / clip.sy), static_cast<float>(z), 0});
    }
    return out;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("a point comes back from its depth whatever far/near is", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
        const Camera camera{.near = 0.01};
        const auto in = points(camera, 0.01 * ratio, 50'000);
        const auto out = round_trip<TestType>(*device, camera, in);
        double worst = 0, worst_depth = 0;
        for (std::size_t i = 0; i < in.size(); ++i) {
            const glm::dvec3 wanted(in[i].x, in[i].y, in[i].z), got(out[i].x, out[i].y, out[i].z);
            worst = std::max(worst, glm::length(got - wanted) / glm::length(wanted));
            const double depth = camera.near / -wanted.z;
            worst_depth = std::max(worst_depth, std::abs(out[i].w - depth) / depth);
        }
        std::printf("%s: far/near %.0e: position error %.3g, depth error %.3g\n", TestType::name, ratio, worst,
                    worst_depth);
        INFO("far/near " << ratio);
        CHECK(worst <= 2.5e-7);
        CHECK(worst_depth <= 1.8e-7);
    }
}

TEMPLATE_LIST_TEST_CASE("a point comes back from its depth in an orthographic view", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Camera camera{.projection = Projection::orthographic, .half_width = 3, .half_height = 3, .near = 1, .far = 100};
    const auto in = points(camera, 100, 50'000);
    const auto out = round_trip<TestType>(*device, camera, in);
    double worst = 0;
    for (std::size_t i = 0; i < in.size(); ++i)
        worst = std::max(worst,
                         glm::length(glm::dvec3(out[i].x, out[i].y, out[i].z) - glm::dvec3(in[i].x, in[i].y, in[i].z)));
    // Depth is linear in z, in [0,1]: half an ulp of 1 is 6e-8 of the view's 99 m, five roundings at most.
    std::printf("%s: orthographic position error %.3g m of 99 m\n", TestType::name, worst);
    CHECK(worst <= 5 * 0x1p-24 * 99);
}

TEMPLATE_LIST_TEST_CASE("scene and camera far from the origin: depth and position as good as at the origin", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const RenderSettings settings = test::settings_for(64);
    for (const double offset : {0.0, 1e3, 1e5}) {
        for (const double distance : {0.35, 3.0, 900.0}) {
            // A wall that faces the camera; both turned and moved alike, by amounts that are no round numbers.
            const glm::dvec3 away = offset * glm::normalize(glm::dvec3(0.71, -0.22, 0.67));
            const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.731, glm::normalize(glm::dvec3(0.3, 1, -0.2)));
            Camera camera{.near = 0.1, .world_from_view = test::at(away.x, away.y, away.z) * turn};
            Scene scene;
            const auto half = static_cast<float>(4 * distance);
            test::add(scene, test::quad(half, half), test::matte({1, 1, 1}),
                      camera.world_from_view * test::at(0, 0, -distance));
            const auto shot = test::shoot<TestType>(*device, scene, camera, settings);
            const auto texels = shot.compact();
            const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
            double worst_depth = 0, worst = 0;
            for (std::uint32_t y = 0; y < 64; ++y)
                for (std::uint32_t x = 0; x < 64; ++x) {
                    const double stored = texels[y * 64 + x].depth, exact = camera.near / distance;
                    worst_depth = std::max(worst_depth, std::abs(stored - exact) / exact);
                    const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, settings.size);
                    if (stored == 0) continue;
                    const glm::dvec3 got = reference::view_from_depth(clip, ndc, stored);
                    const glm::dvec3 wanted = reference::view_from_depth(clip, ndc, exact);
                    worst = std::max(worst, glm::length(got - wanted) / glm::length(wanted));
                }
            INFO("offset " << offset << " m, distance " << distance << " m");
            std::printf("%s: offset %.0e, distance %g: depth %.3g, position %.3g\n", TestType::name, offset, distance,
                        worst_depth, worst);
            CHECK(worst_depth <= 2.5e-7);
            CHECK(worst <= 2.5e-7);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("a slanted plane through the world's origin has no holes, and its points lie on it", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const RenderSettings settings = test::settings_for(128);
    Scene scene;
    test::add(scene, make_plane(200, 200), test::matte({1, 1, 1}));
    const Camera camera{.world_from_view = look_at({0.5, 2, 3}, {0, 0, 0})};
    const auto shot = test::shoot<TestType>(*device, scene, camera, settings);
    const auto texels = shot.compact();
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, settings.size));
    const glm::dvec3 eye(camera.world_from_view[3]);
    std::size_t holes = 0;
    double worst = 0;
    for (std::uint32_t y = 0; y < 128; ++y)
        for (std::uint32_t x = 0; x < 128; ++x) {
            const double depth = texels[y * 128 + x].depth;
            holes += depth == 0;
            if (depth == 0) continue;
            const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, settings.size);
            const glm::dvec3 view = reference::view_from_depth(clip, ndc, depth);
            const glm::dvec3 relative = reference::relative_from_view(camera, view);
            worst = std::max(worst, std::abs(eye.y + relative.y) / glm::length(view));
        }
    std::printf("%s: slanted plane: distance from it %.3g of the view distance\n", TestType::name, worst);
    CHECK(holes == 0);
    // Rasterisers snap corners to 1/256 pixel and interpolate depth in float: 1/512 pixel of slope is the floor.
    CHECK(worst <= 1e-5);
}
