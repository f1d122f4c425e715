// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The kernels of shaders/bench_encodings and what each must find.  An invocation sends 256 values through one encoding
/// and stores its errors; they are compared with those on the CPU before anything is timed.
#include <pellucid/rhi/readback.hpp>
#include <pellucid/shaders/bench_encodings.hpp>
#include "encodings/checks.hpp"

namespace pellucid::bench {

/// A pipeline and what it must find.  The first of a family encodes nothing: its time is that of the loop.
struct EncodingKernel {
    std::string name;
    const rhi::Shader* shader;
    std::array<std::uint32_t, 4> constants;  ///< 1, 2, 3, 4; 0 is for the scene's shaders
    std::vector<KernelError> expected;       ///< one of them: what the device may round either way
    double factor = 1;                       ///< errors may be this much larger or smaller than expected …
    double slack = 0;                        ///< … and by this besides: the device's own arithmetic
    DepthRange range = DepthRange::infinite;
};

struct EncodingFamily {
    SpeedErrorTable table;  ///< with its errors; row i is that of kernels[i + 1]
    std::vector<EncodingKernel> kernels;
    bool has_decoders = false;  ///< kernels[i + 1 + rows] decodes only, where row i encodes and decodes
};

/// All four families with what their kernels must find at `pixels` of a picture of `size`.  `errors`: the tables of
/// normals, roughness, colour and positions, in this order.
[[nodiscard]] inline std::vector<EncodingFamily> encoding_families(const std::vector<SpeedErrorTable>& errors,
                                                                   const std::vector<PixelAt>& pixels, Extent2D size) {
    const rhi::Shader* normals = &shaders::bench_encodings_normals_comp;
    const rhi::Shader* scalars = &shaders::bench_encodings_scalars_comp;
    const rhi::Shader* positions = &shaders::bench_encodings_positions_comp;
    std::vector<EncodingFamily> out;
    for (const SpeedErrorTable& table : errors) out.push_back({.table = table});

    // A component that lies halfway between two codes may go either way on a device whose inverse square root is off by
    // a unit in the last place; that moves the mean by far less than another way of rounding does (oct32: 10 %).
    std::vector<EncodingKernel>& n = out[0].kernels;
    n.push_back({"normals: the loop", normals, {ENCODING_NOTHING, 16, 0}, {{2, 2}}, 1.001});
    const auto is_half = [](NormalForm form) {
        return form == NormalForm::half_nearest || form == NormalForm::half_truncated;
    };
    for (const NormalEncoding& e : normal_encodings) {
        std::vector<KernelError> expected;
        for (const NormalEncoding& other : normal_encodings)
            if (&other == &e || (is_half(other.form) && is_half(e.form)))
                expected.push_back(normal_kernel_error(other, pixels, size));
        n.push_back({std::string("normals: ") + e.name,
                     normals,
                     {static_cast<std::uint32_t>(e.form), e.bits, e.precise},
                     std::move(expected),
                     1.02,
                     3e-7});
    }
    for (const NormalEncoding& e : normal_encodings)
        n.push_back({std::string("normals, decoded: ") + e.name,
                     normals,
                     {static_cast<std::uint32_t>(e.form), e.bits, e.precise, 1},
                     {decoder_kernel_error(e, pixels, size)},
                     1.001,
                     1e-5});
    out[0].has_decoders = true;

    std::vector<EncodingKernel>& r = out[1].kernels;
    const auto loop = [&](const auto& value) {
        return kernel_error(pixels, size, [&](KernelValues& values) { return 2 * double{glm::length(value(values))}; });
    };
    const auto one = [](KernelValues& values) { return glm::vec3(values.next(), 0, 0); };
    r.push_back({"numbers: the loop", scalars, {ENCODING_NOTHING, 8, 0}, {loop(one)}, 1.001});
    for (const std::uint32_t bits : roughness_bits)
        r.push_back({"numbers: unorm " + std::to_string(bits),
                     scalars,
                     {SCALAR_UNORM, bits, 0},
                     {unorm_kernel_error(bits, pixels, size)},
                     1.02,
                     3e-7});
    r.push_back(
        {"numbers: metallic", scalars, {SCALAR_UNORM, 8, 0}, {unorm_kernel_error(8, pixels, size)}, 1.02, 3e-7});

    std::vector<EncodingKernel>& c = out[2].kernels;
    KernelError colors = loop([](KernelValues& values) { return values.next_vector(); });
    colors.max = 2;  // of a channel, which comes close to 1
    c.push_back({"colours: the loop", scalars, {ENCODING_NOTHING, 0, 0}, {colors}, 1.01});
    for (const ColorEncoding& e : color_encodings)
        c.push_back({std::string("colours: ") + e.name,
                     scalars,
                     {static_cast<std::uint32_t>(e.form), 0, 0},
                     {color_kernel_error(e.form, pixels, size)},
                     1.02,
                     2e-5});  // pow of a device has a few digits less

    // Depth is a quotient, and a device's may be 2.5 units in the last place off: that is the whole error of some.
    std::vector<EncodingKernel>& p = out[3].kernels;
    p.push_back({"positions: the loop", positions, {ENCODING_NOTHING, 0, 0}, {{2, 2}}, 1.001});
    const auto is_world_half = [](PositionStore store) {
        return store == PositionStore::world_half_nearest || store == PositionStore::world_half_truncated;
    };
    for (const PositionEncoding& e : position_encodings) {
        std::vector<KernelError> expected;
        for (const PositionEncoding& other : position_encodings)
            if (&other == &e || (is_world_half(other.store) && is_world_half(e.store)))
                expected.push_back(position_kernel_error(other, pixels, size));
        p.push_back({std::string("positions: ") + e.name,
                     positions,
                     {static_cast<std::uint32_t>(e.store), static_cast<std::uint32_t>(e.use), 0},
                     std::move(expected),
                     is_world_half(e.store) ? 1.05 : 2.0,
                     3e-7,
                     e.range});
    }
    return out;
}

/// What a kernel found against what it must find.  Errors: internal.
[[nodiscard]] inline Result<void> check_kernel(const EncodingKernel& kernel, const rhi::Texels& found,
                                               const std::vector<PixelAt>& pixels) {
    KernelError error;
    for (const auto [x, y] : pixels) {
        const auto texel = found.at<gpu::vec4>(x, y);
        error.rms += double{texel.x};
        error.max = std::max(error.max, std::sqrt(double{texel.y}));
    }
    error.rms = std::sqrt(error.rms / (static_cast<double>(pixels.size()) * BENCH_ENCODINGS_VALUES));
    // Elsewhere in the picture the same kernel ran on other values: none may be far beyond what the sampled ones have.
    double largest = 0;
    for (std::uint32_t y = 0; y < found.size.height; ++y)
        for (std::uint32_t x = 0; x < found.size.width; ++x) {
            const double square = found.at<gpu::vec4>(x, y).y;
            largest = std::isfinite(square) ? std::max(largest, std::sqrt(square)) : INFINITY;
        }
    const auto agrees = [&](double value, double expected, double factor) {
        return value <= expected * factor + kernel.slack && value >= expected / factor - kernel.slack;
    };
    for (const KernelError& expected : kernel.expected)
        if (agrees(error.rms, expected.rms, kernel.factor) && agrees(error.max, expected.max, 1.1 * kernel.factor) &&
            largest <= 4 * expected.max + kernel.slack)
            return {};
    const KernelError& expected = kernel.expected.front();
    return Error{Errc::internal, kernel.name + ": the device's errors are " + significant(error.rms, 5) +
                                     " (root mean square) and " + significant(error.max, 5) + " (largest; " +
                                     significant(largest, 5) + " in all pixels), those on the CPU " +
                                     significant(expected.rms, 5) + " and " + significant(expected.max, 5) +
                                     "; the limit is a factor of " + significant(kernel.factor, 4) + ": not timed"};
}

}  // namespace pellucid::bench
