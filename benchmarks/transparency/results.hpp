// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the program measures: by backend, scene and method.
#include <pellucid/measure/quality.hpp>
#include <cstring>
#include "support/machine.hpp"
#include "support/time.hpp"
#include "transparency/truth.hpp"

namespace pellucid::bench {

/// Whose time a row has.
enum class RowKind : std::uint8_t {
    opaque,  ///< the frame without its translucent surfaces
    method,  ///< one of ours
    peer     ///< another program's
};

struct PassTime {
    std::string name;
    Summary milliseconds;
};

struct MethodRow {
    RowKind kind = RowKind::method;
    std::string method;
    std::string remark;
    Summary frame;                   ///< [ms] from `render` to the end of the wait
    double ratio = 0;                ///< to the baseline, the median of the rounds' own ratios; 0: it has none
    Summary transparency;            ///< [ms] of it what translucent surfaces took
    Summary added_light;             ///< [ms] of that, in the lighting pass; only with timestamps
    std::vector<PassTime> passes;    ///< GPU times of all passes; only with timestamps
    double peer_ratio = 0;           ///< as `ratio`, to the peer's exact method
    std::uint32_t draws = 0;         ///< a frame
    measure::QualityReport quality;  ///< of stable pixels
    double added_error = 0;          ///< of an exact method: `detail::added_error`
    std::uint64_t bytes = 0;         ///< of GPU memory that the renderer reports
    std::uint64_t own_bytes = 0;     ///< of them what there is not without translucent surfaces
};

/// Another program that draws the same scene in turn with us.
class Peer {
public:
    virtual ~Peer() = default;
    /// [ms] that it takes to draw one frame.
    [[nodiscard]] virtual Result<double> frame() = 0;

    MethodRow row;
    bool exact = false;  ///< our times are also given as multiples of this one's
};

struct SceneResult {
    std::string name, title;
    std::uint64_t triangles = 0;
    const Truth* truth = nullptr;
    double exact_bound = 0;  ///< of `MethodRow::added_error`
    std::vector<MethodRow> rows;
    std::vector<std::string> notes;  ///< a sentence each
};

struct BackendResult {
    rhi::DeviceInfo device;
    Machine machine;
    Extent2D size;            ///< [pixel]
    bool timestamps = false;  ///< transparency is timed by the GPU; else it is what the frame takes longer
    std::uint32_t rounds = 0, warm_up = 0;
    std::vector<SceneResult> scenes;
    std::vector<std::string> notes;  ///< a sentence each
};

/// Whether a pass of the frame is there for translucent surfaces alone.
[[nodiscard]] inline bool of_transparency(const char* pass) {
    for (const char* other : {"gbuffer", "emitted", "lighting", "background", "tonemap"})
        if (std::strcmp(pass, other) == 0) return false;
    return true;
}

/// Everything but the maps: errors, PSNR, LDR-FLIP, unstable pixels apart.
[[nodiscard]] inline Result<measure::QualityReport> judge(const ImageF& picture, const ImageF& reference,
                                                          const Image8& stable) {
    using enum measure::QualityMetrics;
    PELLUCID_TRY(measure::QualityReport report,
                 measure::quality(picture, reference,
                                  {.metrics = errors | tone_mapped_psnr | ldr_flip | coverage, .mask = &stable}));
    if (report.ldr_flip) report.ldr_flip->map = {};
    return report;
}

}  // namespace pellucid::bench
