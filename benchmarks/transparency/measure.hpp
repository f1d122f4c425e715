// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One scene on one device: every method's picture is judged, then all are timed, in turn.
#include <pellucid/renderer/renderer.hpp>
#include <algorithm>
#include <cstring>
#include <functional>
#include <future>
#include "support/markdown.hpp"
#include "transparency/results.hpp"

namespace pellucid::bench {

struct SceneSettings {
    Extent2D size;
    std::vector<Method> methods;  ///< the first is the baseline
    bool timestamps = false;
    std::uint32_t rounds = 9, warm_up = 2;
};

namespace detail {

[[nodiscard]] inline ImageF without_alpha(const ImageF& image) {
    ImageF out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        std::copy_n(image.data.data() + 4 * i, 3, out.data.data() + 3 * i);
    return out;
}

/// Largest error that an exact method may add to that of the opaque surfaces, as a share of max(1, radiance):
///   2^-10: the target is binary16, and writing the composite loses up to one unit;
///   2^-11: an A-buffer stores colours as binary16, rounded to nearest;  layers · 2^-20: and alpha in 19 bits;
///   2e-3 for lit surfaces: what arithmetic in single precision changes where highlights are sharp (tests/renderer).
[[nodiscard]] inline double exact_bound(const Case& c, std::uint32_t layers) {
    return 0x1p-10 + 0x1p-11 + layers * 0x1p-20 + (c.lit ? 2e-3 : 0);
}

/// How much an exact method adds to the error that the opaque surfaces already have, at the worst stable pixel, as a
/// share of max(1, expected).  `slack`: that error, value by value; null: there is none.  `on_grid`: the other answer
/// of a device that moves corners to a grid (Truth::on_grid): each value is judged by the nearer one; null: there is
/// one. Errors: internal where it is more than `bound`, or not finite.
[[nodiscard]] inline Result<double> added_error(const Case& c, const std::string& method, const ImageF& picture,
                                                const ImageF& expected, const char* expected_name, const ImageF* slack,
                                                const ImageF* on_grid, const Image8& stable, double bound) {
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < picture.data.size(); ++i) {
        if (stable.data[i / 3] != 255) continue;
        const double reference = expected.data[i];
        double error = std::abs(picture.data[i] - reference);
        if (on_grid) error = std::min(error, std::abs(double{picture.data[i]} - on_grid->data[i]));
        if (slack) error -= slack->data[i];
        const double scaled = error / std::max(1.0, std::abs(reference));
        if (scaled <= worst) continue;  // false for what is not finite
        worst = std::isfinite(scaled) ? scaled : INFINITY, at = i;
        if (!std::isfinite(scaled)) break;
    }
    if (worst <= bound) return worst;
    const std::size_t x = at / 3 % picture.width, y = at / 3 / picture.width;
    return Error{Errc::internal,
                 c.name + ", " + method + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + "), channel " +
                     std::to_string(at % 3) + " is " + significant(picture.data[at], 6) + " but the " + expected_name +
                     " has " + significant(expected.data[at], 6) + ": " + significant(worst) +
                     " more than opaque surfaces explain, where an exact method may add " + significant(bound) + ""};
}

/// A method that is being measured.
template <rhi::Backend B>
struct Contender {
    MethodRow row;
    bool exact = false;
    std::unique_ptr<Renderer<B>> renderer;
    ImageF picture;                            ///< [h, w, 3] of the last frame that was read
    std::vector<double> frame, own, lighting;  ///< [ms] of each round: all, passes of its own, the lighting pass
    struct Pass {
        std::string name;
        std::vector<double> milliseconds;
    };
    std::vector<Pass> passes;

    /// Reads the last frame.
    [[nodiscard]] Result<void> read() {
        PELLUCID_TRY(const ImageF hdr, renderer->read_hdr());
        picture = without_alpha(hdr);
        return {};
    }

    /// One frame; `kept`: its times count.
    [[nodiscard]] Result<void> time(rhi::DeviceFor<B>& device, const Camera& camera, bool timestamps, bool kept) {
        const double start = now_ns();
        PELLUCID_TRY(const rhi::Ticket ticket, renderer->render(camera));
        PELLUCID_CHECK(device.wait(ticket));
        const double milliseconds = (now_ns() - start) * 1e-6;
        PELLUCID_TRY(const auto spans, renderer->gpu_times());
        if (!kept) return {};
        frame.push_back(milliseconds);
        if (!timestamps) return {};
        if (spans.empty())
            return Error{Errc::internal, row.method + ": the device gave no timestamps of a frame; use --clock wall"};
        double sum = 0, light = 0;
        for (const measure::GpuSpan& span : spans) {
            auto pass = std::find_if(passes.begin(), passes.end(), [&](const Pass& p) { return p.name == span.name; });
            if (pass == passes.end()) pass = passes.insert(pass, {span.name, {}});
            pass->milliseconds.push_back(span.ms);
            if (of_transparency(span.name)) sum += span.ms;
            if (std::strcmp(span.name, "lighting") == 0) light += span.ms;
        }
        own.push_back(sum);
        lighting.push_back(light);
        return {};
    }
};

}  // namespace detail

/// One scene's measurement, step by step: `draw`, `judge_pictures`, `check`, `time`, `check` again, `result`.
template <rhi::Backend B>
class SceneRun {
public:
    SceneRun(rhi::DeviceFor<B>& device, const Case& c, const Truth& truth, const SceneSettings& settings,
             const std::vector<std::unique_ptr<Peer>>& peers)
        : device_(device), case_(c), truth_(truth), settings_(settings), peers_(peers), peer_times_(peers.size()) {
        out_ = {.name = c.name, .title = c.title, .truth = &truth};
        out_.exact_bound = detail::exact_bound(c, truth.max_layers);
    }

    /// Every method's first frame; that without translucent surfaces is contender 0, the baseline 1.
    [[nodiscard]] Result<void> draw() {
        PELLUCID_CHECK(enter(RowKind::opaque, {Transparency::none, Exact::nowhere, "opaque surfaces alone"}));
        for (const Method& method : settings_.methods) PELLUCID_CHECK(enter(RowKind::method, method));
        slack_ = contenders_[0].picture;
        for (std::size_t i = 0; i < slack_.data.size(); ++i)
            slack_.data[i] = std::abs(slack_.data[i] - truth_.opaque.data[i]);
        return {};
    }

    /// All at once: a large picture takes seconds.
    [[nodiscard]] Result<void> judge_pictures() {
        std::vector<std::future<Result<measure::QualityReport>>> verdicts;
        for (const Contender& entry : contenders_) {
            const ImageF& expected = entry.row.kind == RowKind::opaque ? truth_.opaque : truth_.radiance;
            verdicts.push_back(std::async(std::launch::async, judge, std::cref(entry.picture), std::cref(expected),
                                          std::cref(truth_.stable)));
        }
        for (std::size_t i = 0; i < verdicts.size(); ++i) {
            PELLUCID_TRY(contenders_[i].row.quality, verdicts[i].get());
        }
        return {};
    }

    /// The exact methods' pictures.  How a device filters textures is its own affair: there they must agree with each
    /// other.
    [[nodiscard]] Result<void> check() {
        const ImageF* expected = case_.sampled ? nullptr : &truth_.radiance;
        for (Contender& entry : contenders_) {
            if (!entry.exact) continue;
            if (expected) {
                PELLUCID_TRY(const double added,
                             detail::added_error(case_, entry.row.method, entry.picture, *expected,
                                                 case_.sampled ? "first exact method" : "reference",
                                                 case_.sampled ? nullptr : &slack_,
                                                 case_.sampled || truth_.on_grid.empty() ? nullptr : &truth_.on_grid,
                                                 truth_.stable, out_.exact_bound));
                entry.row.added_error = std::max(entry.row.added_error, added);
            } else {
                expected = &entry.picture;
            }
        }
        return {};
    }

    /// Every other round runs backwards: what one leaves behind for the next does not always hit the same.
    [[nodiscard]] Result<void> time() {
        const std::size_t turns = contenders_.size() + peers_.size();
        for (std::uint32_t round = 0; round < settings_.warm_up + settings_.rounds; ++round) {
            const bool kept = round >= settings_.warm_up;
            for (std::size_t turn = 0; turn < turns; ++turn) {
                const std::size_t i = round % 2 ? turns - 1 - turn : turn;
                if (i < contenders_.size()) {
                    PELLUCID_CHECK(contenders_[i].time(device_, case_.camera, settings_.timestamps, kept));
                } else {
                    PELLUCID_TRY(const double milliseconds, peers_[i - contenders_.size()]->frame());
                    if (kept) peer_times_[i - contenders_.size()].push_back(milliseconds);
                }
            }
        }
        for (Contender& entry : contenders_) PELLUCID_CHECK(entry.read());
        return {};
    }

    /// Ends the run.
    [[nodiscard]] SceneResult result() {
        const Contender &opaque = contenders_[0], &baseline = contenders_[1];
        for (Contender& entry : contenders_) {
            MethodRow& row = entry.row;
            if (row.kind == RowKind::method) {
                row.ratio = summarise(ratios(entry.frame, baseline.frame)).median;
                row.transparency = summarise(transparency(entry, opaque));
                row.added_light = summarise(differences(entry.lighting, opaque.lighting));
                for (std::size_t p = 0; p < peers_.size(); ++p)
                    if (peers_[p]->exact) row.peer_ratio = summarise(ratios(entry.frame, peer_times_[p])).median;
            }
            row.frame = summarise(entry.frame);
            for (const auto& pass : entry.passes) row.passes.push_back({pass.name, summarise(pass.milliseconds)});
            out_.rows.push_back(std::move(row));
        }
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            out_.rows.push_back(peers_[p]->row);
            out_.rows.back().frame = summarise(peer_times_[p]);
            out_.rows.back().ratio = summarise(ratios(peer_times_[p], baseline.frame)).median;
        }
        return std::move(out_);
    }

private:
    using Contender = detail::Contender<B>;

    /// [ms] of each round: a method's own passes and what it adds to the lighting pass, or, without timestamps, to the
    /// frame.
    [[nodiscard]] std::vector<double> transparency(const Contender& entry, const Contender& opaque) const {
        if (!settings_.timestamps) return differences(entry.frame, opaque.frame);
        std::vector<double> out = differences(entry.lighting, opaque.lighting);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += entry.own[i];
        return out;
    }

    [[nodiscard]] Result<void> enter(RowKind kind, const Method& method) {
        Contender entry;
        entry.exact = case_.exact(method);
        entry.row = {.kind = kind, .method = name(method.value), .remark = method.remark};
        PELLUCID_TRY(entry.renderer,
                     Renderer<B>::create(device_, case_.scene, case_.settings(settings_.size, method.value)));
        PELLUCID_CHECK(entry.time(device_, case_.camera, false, false));
        PELLUCID_CHECK(entry.read());
        const RenderStats stats = entry.renderer->stats();
        entry.row.bytes = stats.bytes;
        if (!contenders_.empty()) entry.row.own_bytes = entry.row.bytes - contenders_.front().row.bytes;
        entry.row.draws = stats.draws;
        out_.triangles = stats.triangles;
        contenders_.push_back(std::move(entry));
        return {};
    }

    rhi::DeviceFor<B>& device_;
    const Case& case_;
    const Truth& truth_;
    const SceneSettings& settings_;
    const std::vector<std::unique_ptr<Peer>>& peers_;
    SceneResult out_;
    std::vector<Contender> contenders_;
    ImageF slack_;                                 ///< how far off the opaque surfaces are
    std::vector<std::vector<double>> peer_times_;  ///< [ms] of each round
};

/// `peers` take their turns too.
/// Errors: those of the device; internal where an exact method's picture is wrong: then nothing was timed.
template <rhi::Backend B>
[[nodiscard]] Result<SceneResult> measure_scene(rhi::DeviceFor<B>& device, const Case& c, const Truth& truth,
                                                const SceneSettings& settings,
                                                const std::vector<std::unique_ptr<Peer>>& peers) {
    SceneRun<B> run(device, c, truth, settings, peers);
    PELLUCID_CHECK(run.draw());
    PELLUCID_CHECK(run.judge_pictures());
    PELLUCID_CHECK(run.check());
    PELLUCID_CHECK(run.time());
    PELLUCID_CHECK(run.check());  // the last frame is still that picture
    return run.result();
}

}  // namespace pellucid::bench
