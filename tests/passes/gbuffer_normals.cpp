// SPDX-License-Identifier: MIT
// Octahedral normals as the shaders encode and decode them, against the double reference.
#include <pellucid/gpu/scene.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <pellucid/reference/gbuffer.hpp>
#include "reference/sampling.hpp"
#include "support/gpu.hpp"

using namespace pellucid;
using test::own;

namespace {
/// Directions that tests must not miss, then random ones: `count` in all, unit to float precision.
std::vector<gpu::vec4> directions(std::size_t count) {
    std::vector<gpu::vec4> out;
    const float values[] = {-1.0f, -0.5f, -1e-4f, -1e-8f, -0.0f, 0.0f, 1e-8f, 1e-4f, 0.5f, 1.0f};
    for (const float x : values)
        for (const float y : values)
            for (const float z : values) {
                const glm::dvec3 v(x, y, z);
                if (glm::length(v) < 1e-3) continue;
                const glm::dvec3 n = v / glm::length(v);
                out.push_back({std::copysign(static_cast<float>(n.x), x), std::copysign(static_cast<float>(n.y), y),
                               std::copysign(static_cast<float>(n.z), z), 0});
            }
    test::Random random(7);
    while (out.size() < count) {
        glm::dvec3 n = random.direction();
        if (out.size() % 5 == 0) n = glm::normalize(glm::dvec3(n.x, n.y, 1e-5 * n.z));  // at the fold
        if (out.size() % 5 == 1) n = glm::normalize(glm::dvec3(n.x * 1e-5, n.y, n.z));
        out.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z), 0});
    }
    return out;
}

template <rhi::Backend B>
std::vector<gpu::vec4> on_gpu(typename B::Device& device, const std::vector<gpu::vec4>& in) {
    const std::span<const gpu::vec4> values(in);
    const auto buffer =
        own(device, device.make_buffer({.size = values.size_bytes(),
                                        .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_source,
                                        .initial = rhi::bytes_of(values),
                                        .debug_name = "directions"}));
    const rhi::GroupLayout layout{{{12, rhi::BindingKind::storage_buffer}}};
    const auto group =
        own(device, device.make_group({.layout = layout, .bindings = {{.binding = 12, .buffer = buffer}}}));
    const auto pipeline = own(device, device.make_pipeline(rhi::ComputePipelineDesc{
                                          .compute = &shaders::test_octahedral_comp, .pass_group = layout}));
    test::run(device, [&](auto& cmd) {
        cmd.begin_compute({.uses = {rhi::use(buffer.get(), rhi::Access::storage_read_write)}, .name = "octahedral"});
        cmd.bind_pipeline(pipeline);
        cmd.bind_group(group);
        cmd.dispatch(static_cast<std::uint32_t>((in.size() + 63) / 64), 1, 1);
        cmd.end_compute();
    });
    return test::read<gpu::vec4>(device, buffer, in.size());
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("octahedral normals on the GPU: largest error 0.0025 degrees", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const std::vector<gpu::vec4> in = directions(200'000);
    const std::vector<gpu::vec4> out = on_gpu<TestType>(*device, in);
    double worst = 0, worst_decode = 0;
    std::size_t other_code = 0, farther = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const glm::dvec3 wanted(in[i].x, in[i].y, in[i].z), got(out[i].x, out[i].y, out[i].z);
        const double error = test::degrees_between(wanted, got);
        worst = std::max(worst, error);
        const auto code = std::bit_cast<std::uint32_t>(out[i].w);
        const glm::dvec3 exact = reference::direction_from_oct32<double>(code);
        worst_decode = std::max(worst_decode, glm::length(got - exact));
        const std::uint32_t nearest = reference::oct32_from_direction(glm::normalize(wanted));
        if (code == nearest) continue;
        ++other_code;  // equally near but for the rounding of float, or two codes of one direction (on the fold)
        const double best = test::degrees_between(wanted, reference::direction_from_oct32<double>(nearest));
        farther += test::degrees_between(wanted, exact) > best + 2e-5;
    }
    std::printf("%s: octahedral error %.6f deg, decode %.2g, other codes %zu of %zu\n", TestType::name, worst,
                worst_decode, other_code, in.size());
    CHECK(worst <= 0.0025);
    CHECK(worst_decode <= 2e-7);
    CHECK(farther == 0);
    CHECK(other_code < in.size() / 100);
}

TEMPLATE_LIST_TEST_CASE("octahedral normals on the GPU: axes are exact", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    std::vector<gpu::vec4> in;
    for (const float s : {1.0f, -1.0f})
        for (const float z : {0.0f, -0.0f}) {
            in.push_back({s, z, z, 0});
            in.push_back({z, s, z, 0});
            in.push_back({z, z, s, 0});
        }
    const std::vector<gpu::vec4> out = on_gpu<TestType>(*device, in);
    for (std::size_t i = 0; i < in.size(); ++i) {
        INFO(in[i].x << " " << in[i].y << " " << in[i].z);
        CHECK(out[i].x == in[i].x);
        CHECK(out[i].y == in[i].y);
        CHECK(out[i].z == in[i].z);
    }
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("octahedral normals: the same bits on both backends", "[gpu]") {
    const auto vulkan = test::make_device<Vulkan>();
    const auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl || vulkan->info().software != opengl->info().software) return;
    const std::vector<gpu::vec4> in = directions(100'000);
    const auto a = on_gpu<Vulkan>(*vulkan, in), b = on_gpu<OpenGL>(*opengl, in);
    CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}
#endif
