// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The demonstration without a window: pictures of moments at equal distances, and what a frame takes.
#include "../support/demo.hpp"
#include "stage.hpp"
#include <pellucid/measure/statistics.hpp>
#include <pellucid/scene/image_file.hpp>
#include <chrono>
#include <cstdio>
#include <map>

namespace pellucid::samples {

struct Sequence {
    std::uint32_t frames = 30;
    double step = 1.0 / 30;  ///< [s] between two frames, however long they take
    std::string folder;
};

/// Writes folder/frame_0000.png, …, and says how long frames took.  Errors: the device's, and io.
template <rhi::Backend B>
[[nodiscard]] Result<void> write_sequence(typename B::Device& device, DeferredStage<B>& stage,
                                          const Sequence& sequence) {
    PELLUCID_CHECK(make_folder(sequence.folder));
    const Bounds bounds = scene_bounds(stage.scene());
    const Camera start = stage.scene().cameras.front();
    std::vector<double> frames;
    std::map<std::string, std::vector<double>> passes;
    std::string file;
    for (std::uint32_t frame = 0; frame < sequence.frames; ++frame) {
        const double seconds = frame * sequence.step;
        const Camera camera = glide(start, bounds, seconds);
        const auto before = std::chrono::steady_clock::now();
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, stage.draw(camera, seconds));
        PELLUCID_CHECK(device.wait(ticket));
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
        frames.push_back(took.count());
        std::span<const measure::GpuSpan> spans;
        PELLUCID_TRY(spans, stage.renderer().gpu_times());
        for (const measure::GpuSpan& span : spans) passes[span.name].push_back(span.ms);
        Image8 picture;
        PELLUCID_TRY(picture, stage.renderer().read_display());
        char name[32];
        std::snprintf(name, sizeof name, "frame_%04u.png", frame);
        file = (std::filesystem::path(sequence.folder) / name).string();
        PELLUCID_CHECK(write_png(file, picture));
    }
    const Extent2D size = stage.renderer().settings().size;
    std::printf("%s on %s: %u frames of %ux%u, %.4g s apart, %.2f ms a frame (median)\n", B::name,
                device.info().name.c_str(), sequence.frames, size.width, size.height, sequence.step,
                measure::summarize(frames).median);
    for (const auto& [name, ms] : passes)
        std::printf("  %-16s %8.3f ms on the device\n", name.c_str(), measure::summarize(ms).median);
    std::printf("the last picture is %s\n", file.c_str());
    return {};
}

}  // namespace pellucid::samples
