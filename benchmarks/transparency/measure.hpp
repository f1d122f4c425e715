// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One scene on one device: every method's picture is judged, then all are timed, in turn.
#include <pellucid/renderer/renderer.hpp>
#include <algorithm>
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

/// Largest error that an exact method may add to that of the opaque surfaces, as a share of max(1, radiance).
///   2 · 2^-10: the target is binary16 and is written twice, each time with up to one unit lost;
///   2^-11: an A-buffer stores colours as binary16, rounded to nearest;  layers · 2^-17: and alpha in 16 bits;
///   2^-9 for lit surfaces: their radiance is computed in single precision (roughness 0.045 amplifies by 500).
[[nodiscard]] inline double exact_bound(const Case& c, std::uint32_t layers) {
    return 0x1p-9 + 0x1p-11 + layers * 0x1p-17 + (c.lit ? 0x1p-9 : 0);
}

/// Whether the picture of an exact method is what its documentation says, at every stable pixel.
/// `slack`: for each value how far off the opaque surfaces already are; null: nowhere.
[[nodiscard]] inline Result<void> check_exact(const Case& c, const std::string& method, const ImageF& picture,
                                              const ImageF& expected, const char* expected_name, const ImageF* slack,
                                              const Truth& truth) {
    const double bound = exact_bound(c, truth.max_layers);
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < picture.data.size(); ++i) {
        if (truth.stable.data[i / 3] != 255) continue;
        const double value = picture.data[i], reference = expected.data[i];
        const double error = std::abs(value - reference) - (slack ? slack->data[i] : 0.0f);
        const double scaled = error / std::max(1.0, std::abs(reference));
        if (scaled > worst || !std::isfinite(scaled)) worst = std::isfinite(scaled) ? scaled : INFINITY, at = i;
        if (!std::isfinite(scaled)) break;
    }
    if (worst <= bound) return {};
    const std::size_t x = at / 3 % picture.width, y = at / 3 / picture.width;
    return Error{Errc::internal, c.name + ", " + method + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                     "), channel " + std::to_string(at % 3) + " is " +
                                     significant(picture.data[at], 6) + " but the " + expected_name + " has " +
                                     significant(expected.data[at], 6) + ": " + significant(worst) +
                                     " more than opaque surfaces explain, where an exact method may add " +
                                     significant(bound) + "; nothing is timed"};
}

/// A method that is being measured.
template <rhi::Backend B>
struct Contender {
    MethodRow row;
    std::unique_ptr<Renderer<B>> renderer;
    ImageF picture;
    std::vector<double> frame, transparency;  ///< [ms] of each round
    struct Pass {
        std::string name;
        std::vector<double> milliseconds;
    };
    std::vector<Pass> passes;

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
        double sum = 0;
        for (const measure::GpuSpan& span : spans) {
            auto pass = std::find_if(passes.begin(), passes.end(), [&](const Pass& p) { return p.name == span.name; });
            if (pass == passes.end()) pass = passes.insert(pass, {span.name, {}});
            pass->milliseconds.push_back(span.ms);
            if (of_transparency(span.name)) sum += span.ms;
        }
        transparency.push_back(sum);
        return {};
    }
};

}  // namespace detail

/// `peers` take their turns too.
/// Errors: those of the device; internal where an exact method's picture is wrong.
template <rhi::Backend B>
[[nodiscard]] Result<SceneResult> measure_scene(rhi::DeviceFor<B>& device, const Case& c, const Truth& truth,
                                                const SceneSettings& settings,
                                                const std::vector<std::unique_ptr<Peer>>& peers) {
    using detail::Contender;
    SceneResult out{.name = c.name, .title = c.title, .truth = &truth};
    std::vector<Contender<B>> contenders;
    const auto enter = [&](RowKind kind, const Method& method, const ImageF& expected) -> Result<void> {
        Contender<B> entry;
        entry.row = {.kind = kind, .method = name(method.value), .remark = method.remark};
        PELLUCID_TRY(entry.renderer, Renderer<B>::create(device, c.scene, c.settings(settings.size, method.value)));
        PELLUCID_TRY(const rhi::Ticket ticket, entry.renderer->render(c.camera));
        PELLUCID_CHECK(device.wait(ticket));
        PELLUCID_TRY(const ImageF hdr, entry.renderer->read_hdr());
        entry.picture = detail::without_alpha(hdr);
        PELLUCID_TRY(entry.row.quality, judge(entry.picture, expected, truth.stable));
        const RenderStats stats = entry.renderer->stats();
        entry.row.bytes = stats.bytes + method.fragment_bytes * truth.fragments;
        entry.row.draws = stats.draws;
        if (!contenders.empty()) entry.row.own_bytes = entry.row.bytes - contenders.front().row.bytes;
        out.triangles = stats.triangles;
        contenders.push_back(std::move(entry));
        return {};
    };

    PELLUCID_CHECK(enter(RowKind::opaque, {Transparency::none, false, "opaque surfaces alone"}, truth.opaque));
    ImageF slack = contenders[0].picture;  // how far off what lies behind already is
    for (std::size_t i = 0; i < slack.data.size(); ++i) slack.data[i] = std::abs(slack.data[i] - truth.opaque.data[i]);
    const ImageF* first_exact = nullptr;
    contenders.reserve(settings.methods.size() + 1);
    for (const Method& method : settings.methods) {
        PELLUCID_CHECK(enter(RowKind::method, method, truth.radiance));
        if (!method.exact) continue;
        const Contender<B>& entry = contenders.back();
        // How a device filters textures is its own affair: there the exact methods must agree with each other.
        if (!c.sampled)
            PELLUCID_CHECK(
                detail::check_exact(c, entry.row.method, entry.picture, truth.radiance, "reference", &slack, truth));
        else if (first_exact)
            PELLUCID_CHECK(detail::check_exact(c, entry.row.method, entry.picture, *first_exact, "other exact method",
                                               nullptr, truth));
        first_exact = &entry.picture;
    }

    // Every other round runs backwards: what one leaves behind for the next does not always hit the same.
    const std::size_t turns = contenders.size() + peers.size();
    std::vector<std::vector<double>> peer_times(peers.size());
    for (std::uint32_t round = 0; round < settings.warm_up + settings.rounds; ++round) {
        const bool kept = round >= settings.warm_up;
        for (std::size_t turn = 0; turn < turns; ++turn) {
            const std::size_t i = round % 2 ? turns - 1 - turn : turn;
            if (i < contenders.size()) {
                PELLUCID_CHECK(contenders[i].time(device, c.camera, settings.timestamps, kept));
            } else {
                PELLUCID_TRY(const double milliseconds, peers[i - contenders.size()]->frame());
                if (kept) peer_times[i - contenders.size()].push_back(milliseconds);
            }
        }
    }

    for (Contender<B>& entry : contenders) {
        if (!settings.timestamps) entry.transparency = differences(entry.frame, contenders[0].frame);
        if (entry.row.kind == RowKind::method) {
            entry.row.ratio = summarise(ratios(entry.frame, contenders[1].frame)).median;
            entry.row.transparency = summarise(entry.transparency);
            for (std::size_t p = 0; p < peers.size(); ++p)
                if (peers[p]->exact) entry.row.peer_ratio = summarise(ratios(entry.frame, peer_times[p])).median;
        }
        entry.row.frame = summarise(entry.frame);
        for (const auto& pass : entry.passes) entry.row.passes.push_back({pass.name, summarise(pass.milliseconds)});
        out.rows.push_back(std::move(entry.row));
    }
    for (std::size_t p = 0; p < peers.size(); ++p) {
        out.rows.push_back(peers[p]->row);
        out.rows.back().frame = summarise(peer_times[p]);
        out.rows.back().ratio = summarise(ratios(peer_times[p], contenders[1].frame)).median;
    }
    return out;
}

}  // namespace pellucid::bench
