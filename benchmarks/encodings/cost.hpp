// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What encoding a value and decoding it again costs on a device: the kernels of shaders/bench_encodings.  Each
/// invocation sends 256 values through one encoding; its errors are compared with those on the CPU before it is timed.
#include <pellucid/gpu/scene.h>
#include <bit>
#include <pellucid/rhi/readback.hpp>
#include <pellucid/shaders/bench_encodings.hpp>
#include "encodings/checks.hpp"
#include "support/pass_clock.hpp"

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

/// All four families, their expectations for a picture of `size`.
[[nodiscard]] inline std::vector<EncodingFamily> encoding_families(const std::vector<SpeedErrorTable>& errors,
                                                                   const std::vector<PixelAt>& pixels, Extent2D size) {
    const rhi::Shader* normals = &shaders::bench_encodings_normals_comp;
    const rhi::Shader* scalars = &shaders::bench_encodings_scalars_comp;
    const rhi::Shader* positions = &shaders::bench_encodings_positions_comp;
    std::vector<EncodingFamily> out;
    for (const SpeedErrorTable& table : errors) out.push_back({.table = table});

    // A component that lies between two codes may go either way: a few values in 10^4 with 16 bits.
    std::vector<EncodingKernel>& n = out[0].kernels;
    n.push_back({"normals: the loop", normals, {ENCODING_NOTHING, 16, 0}, {{2, 2}}, 1.001});
    for (const NormalEncoding& e : normal_encodings) {
        std::vector<KernelError> expected = {normal_kernel_error(e, pixels, size)};
        if (e.form == NormalForm::half_nearest || e.form == NormalForm::half_truncated)
            for (const NormalEncoding& other : normal_encodings)
                if (other.form != e.form && other.bits == 16 &&
                    (other.form == NormalForm::half_nearest || other.form == NormalForm::half_truncated))
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
    for (const PositionEncoding& e : position_encodings) {
        const bool half =
            e.store == PositionStore::world_half_nearest || e.store == PositionStore::world_half_truncated;
        std::vector<KernelError> expected;
        for (const PositionEncoding& other : position_encodings)
            if (&other == &e || (half && (other.store == PositionStore::world_half_nearest ||
                                          other.store == PositionStore::world_half_truncated)))
                expected.push_back(position_kernel_error(other, pixels, size));
        p.push_back({std::string("positions: ") + e.name,
                     positions,
                     {static_cast<std::uint32_t>(e.store), static_cast<std::uint32_t>(e.use), 0},
                     std::move(expected),
                     half ? 1.05 : 2.0,
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

/// The frame's parameters as far as positions need them.
[[nodiscard]] inline gpu::FrameParams kernel_frame(DepthRange range, Extent2D size) {
    const PositionView view = kernel_view(range, size);
    const auto narrow = [](double x, double y, double z, double w) {
        return gpu::vec4{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
    };
    const auto column = [&](int i) {
        const glm::dvec4& c = view.world_from_view[i];
        return narrow(c.x, c.y, c.z, 0);
    };
    gpu::FrameParams frame{};
    frame.world_x = column(0), frame.world_y = column(1), frame.world_z = column(2);
    frame.clip_scale = narrow(view.clip.sx, view.clip.sy, view.clip.ox, view.clip.oy);
    frame.clip_depth = narrow(view.clip.zz, view.clip.zw, view.clip.wz, view.clip.ww);
    frame.pixel = narrow(2.0 / size.width, 2.0 / size.height, size.width, size.height);
    return frame;
}

/// Checks and times every kernel; the rows of each family get their costs.
template <rhi::Backend B>
[[nodiscard]] Result<void> add_costs(rhi::DeviceFor<B>& device, const PassSettings& settings,
                                     std::vector<EncodingFamily>& families, const std::vector<PixelAt>& pixels) {
    const Extent2D size = settings.size;
    const rhi::TextureDesc shown{.size = size,
                                 .format = rhi::Format::rgba32_float,
                                 .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                                 .debug_name = "encodings.errors"};
    rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> errors;
    PELLUCID_OWN(errors, device, device.make_texture(shown));
    const auto matrix = std::bit_cast<gpu::EncodingMatrix>(kernel_view(DepthRange::infinite, size).world_from_clip);
    rhi::Unique<rhi::DeviceFor<B>, rhi::Buffer> matrices;
    PELLUCID_OWN(matrices, device,
                 device.make_buffer({.size = sizeof matrix,
                                     .usage = rhi::BufferUsage::uniform,
                                     .initial = rhi::bytes_of(matrix),
                                     .debug_name = "encodings.matrix"}));
    const rhi::GroupLayout layout{{{BENCH_ENCODINGS_OUTPUT, rhi::BindingKind::storage_texture},
                                   {BENCH_ENCODINGS_MATRIX, rhi::BindingKind::uniform_buffer}}};
    rhi::Unique<rhi::DeviceFor<B>, rhi::Group> group;
    PELLUCID_OWN(group, device,
                 device.make_group({.layout = layout,
                                    .bindings = {{.binding = BENCH_ENCODINGS_OUTPUT, .texture = errors},
                                                 {.binding = BENCH_ENCODINGS_MATRIX, .buffer = matrices}},
                                    .debug_name = "encodings"}));

    std::array<rhi::UniformSlice, 3> frames;  // one a DepthRange
    const auto begin = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
        for (const DepthRange range : {DepthRange::standard, DepthRange::reversed, DepthRange::infinite}) {
            PELLUCID_TRY(frames[static_cast<std::size_t>(range)],
                         cmd.upload_uniforms(rhi::bytes_of(kernel_frame(range, size))));
        }
        return {};
    };
    std::vector<rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline>> pipelines;
    std::vector<Work<B>> works;
    for (const EncodingFamily& family : families)
        for (const EncodingKernel& kernel : family.kernels) {
            const rhi::SpecConstant constants[] = {{0, 0},
                                                   {1, kernel.constants[0]},
                                                   {2, kernel.constants[1]},
                                                   {3, kernel.constants[2]},
                                                   {4, kernel.constants[3]}};
            rhi::Unique<rhi::DeviceFor<B>, rhi::Pipeline> pipeline;
            PELLUCID_OWN(pipeline, device,
                         device.make_pipeline(rhi::ComputePipelineDesc{.compute = kernel.shader,
                                                                       .constants = constants,
                                                                       .pass_group = layout,
                                                                       .debug_name = kernel.name.c_str()}));
            const rhi::Pipeline handle = pipeline;
            pipelines.push_back(std::move(pipeline));
            const auto record = [&, handle, range = kernel.range](rhi::CommandsFor<B>& cmd) {
                cmd.begin_compute({.uses = {rhi::use(matrices.get(), rhi::Access::uniform_read),
                                            rhi::use(errors.get(), rhi::Access::storage_write)},
                                   .name = "encodings"});
                cmd.bind_pipeline(handle);
                cmd.bind_frame(frames[static_cast<std::size_t>(range)], {});
                cmd.bind_group(group);
                cmd.dispatch((size.width + 7) / 8, (size.height + 7) / 8, 1);
                cmd.end_compute();
            };
            const auto once = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                PELLUCID_CHECK(begin(cmd));
                record(cmd);
                return {};
            };
            PELLUCID_CHECK(run_frame<B>(device, once));
            PELLUCID_TRY(const rhi::Texels texels, rhi::download<B>(device, errors, shown));
            PELLUCID_CHECK(check_kernel(kernel, texels, pixels));
            works.push_back({.name = kernel.name, .record = record});
        }
    PELLUCID_TRY(const RoundTimes times, time_works<B>(device, settings, works, begin));

    const double values = BENCH_ENCODINGS_VALUES * static_cast<double>(size.width) * size.height;
    std::size_t first = 0;
    for (EncodingFamily& family : families) {
        std::vector<std::vector<double>> own;  // without the loop, round by round
        std::size_t cheapest = 0;
        for (std::size_t i = 0; i < family.table.rows.size(); ++i) {
            own.push_back(differences(times[first + 1 + i], times[first]));
            if (summarise(own[i]).median < summarise(own[cheapest]).median) cheapest = i;
        }
        // Where the cheapest cannot be told from the loop there is nothing to be a multiple of.
        const bool has_ratio = summarise(own[cheapest]).lowest > 0;
        for (std::size_t i = 0; i < family.table.rows.size(); ++i) {
            SpeedErrorRow& row = family.table.rows[i];
            const double scale = 1e6 / values;  // [ms] of a dispatch → [ns] a value
            std::vector<NamedNumber> more = {{"ns a value", summarise(own[i]).median * scale}};
            if (family.has_decoders) {
                const std::vector<double>& decoder = times[first + 1 + i + family.table.rows.size()];
                more.push_back({"to encode", summarise(differences(times[first + 1 + i], decoder)).median * scale});
                more.push_back({"to decode", summarise(differences(decoder, times[first])).median * scale});
            }
            row.more.insert(row.more.begin(), more.begin(), more.end());
            for (double& ms : own[i]) ms /= BENCH_ENCODINGS_VALUES;  // one value a pixel
            row.milliseconds = summarise(own[i]);
        }
        for (std::size_t i = 0; has_ratio && i < family.table.rows.size(); ++i)
            family.table.rows[i].ratio = summarise(ratios(own[i], own[cheapest])).median;
        char text[160];
        std::snprintf(text, sizeof text,
                      "ms: encoding and decoding one value a pixel, without the loop, which took %.3g ns a value",
                      summarise(times[first]).median * 1e6 / values);
        family.table.notes.push_back(text);
        first += family.kernels.size();
    }
    return {};
}

}  // namespace pellucid::bench
