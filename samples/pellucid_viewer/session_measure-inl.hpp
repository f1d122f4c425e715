// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Session<B>: errors and times that are measured.
#include "session.hpp"
#include <chrono>

namespace pellucid::samples::viewer {

/// The last method of the table that loses nothing and that the device can run; null: none.
[[nodiscard]] inline const TransparencyTraits* exact_method(const rhi::DeviceInfo& device) {
    const TransparencyTraits* out = nullptr;
    for (const TransparencyTraits& t : all_transparencies)
        if (*t.loses == 0 && check_device(t.method, device)) out = &t;
    return out;
}

template <rhi::Backend B>
Result<typename Session<B>::Truth> Session<B>::truth(const RenderSettings& settings) {
    if (state_.choices.against == Against::reference) {
        const ReferencePicture* picture = state_.fitting_reference(settings);
        return Truth{.name = "the reference",
                     .picture = picture ? &picture->radiance : nullptr,
                     .divisor = state_.choices.reference_divisor};
    }
    const TransparencyTraits* exact = exact_method(device_->info());
    if (!exact)
        return Error{Errc::unsupported, "no exact method runs on " + device_->info().name +
                                            ": compare with the reference to measure errors"};
    RenderSettings of = state_.reference_settings(settings);
    of.size = settings.size;
    of.transparency = exact->method;
    of.shadow_size = settings.shadow_size;
    const std::string key = state_.occasion(of) + exact->name;
    if (key != truth_of_) {
        PELLUCID_TRY(const bool drawn, exact_.draw(*device_, state_.loaded.scene, of, state_.camera));
        if (!drawn) return Error{Errc::out_of_memory, exact_.problem()};
        PELLUCID_TRY(const ImageF radiance, exact_.renderer()->read_hdr());
        truth_ = rgb(radiance);
        truth_of_ = key;
    }
    return Truth{.name = std::string(exact->name) + ", which is exact", .picture = &truth_};
}

template <rhi::Backend B>
Result<void> Session<B>::draw_errors(const RenderSettings& settings) {
    Truth against;
    ImageF right;
    if (state_.choices.against == Against::method) {
        if (!right_.renderer()) return {};
        PELLUCID_TRY(const ImageF radiance, right_.renderer()->read_hdr());
        right = rgb(radiance);
        against = {.name = name(right_.renderer()->settings().transparency), .picture = &right};
    } else {
        Result<Truth> found = truth(settings);
        if (!found) return said(found);
        against = std::move(*found);
    }
    if (!against.picture) return {};  // it is being drawn
    Side<B>* side = &left_;
    if (against.divisor != 1) {
        RenderSettings at = settings;
        at.size = {against.picture->width, against.picture->height};
        PELLUCID_TRY(const bool drawn, small_.draw(*device_, state_.loaded.scene, at, state_.camera));
        if (!drawn) return {};
        side = &small_;
    } else {
        small_.release();
    }
    PELLUCID_TRY(const ImageF radiance, side->renderer()->read_hdr());
    const Result<ImageF> errors = measure::error_picture(rgb(radiance), *against.picture);
    if (!errors) return said(errors);
    return show_heat(
        heat_picture(*errors, "error of radiance against " + against.name, measure::HeatScale::logarithmic),
        against.divisor);
}

template <rhi::Backend B>
Result<typename Session<B>::Measured> Session<B>::measure(const RenderSettings& settings) {
    std::unique_ptr<Renderer<B>> own;
    Renderer<B>* renderer = left_.renderer();
    if (!renderer || !same(renderer->settings(), settings)) {
        PELLUCID_TRY(own, Renderer<B>::create(*device_, *state_.loaded.scene, settings));
        renderer = own.get();
    }
    const rhi::DeviceInfo& info = device_->info();
    const bool timestamps = info.timestamp_ns > 0 && !info.software;  // those of CPUs need not bracket the work
    std::vector<double> times;
    for (int i = 0; i < 4; ++i) {
        const auto start = std::chrono::steady_clock::now();
        PELLUCID_TRY(const rhi::Ticket ticket, renderer->render(state_.camera));
        PELLUCID_CHECK(device_->wait(ticket));
        double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (timestamps) {
            PELLUCID_TRY(const auto spans, renderer->gpu_times());
            ms = 0;
            for (const measure::GpuSpan& span : spans) ms += span.ms;
        }
        if (i > 0) times.push_back(ms);  // the first one warms caches
    }
    PELLUCID_TRY(const ImageF radiance, renderer->read_hdr());
    return Measured{.ms = measure::median(times), .radiance = rgb(radiance)};
}

template <rhi::Backend B>
Result<void> Session<B>::add_point(const RenderSettings& settings, const Truth& against) {
    PELLUCID_TRY(const Measured measured, measure(settings));
    PELLUCID_TRY(const measure::ImageError error, measure::image_error(measured.radiance, *against.picture));
    state_.facts.points.add(describe(settings), measured.ms, error.rmse);
    return {};
}

/// Left against right, by every number of the panel; beside the frames, since FLIP takes a while.
template <rhi::Backend B>
Result<void> Session<B>::compare_sides(const RenderSettings& settings) {
    Truth against;
    ImageF right;
    if (state_.choices.against == Against::method && right_.renderer()) {
        PELLUCID_TRY(const ImageF radiance, right_.renderer()->read_hdr());
        right = rgb(radiance);
        against = {.name = state_.facts.right.label, .picture = &right};
    } else {
        PELLUCID_TRY(against, truth(settings));
    }
    if (!against.picture) return {};
    RenderSettings at = left_.renderer()->settings();
    at.size = {against.picture->width, against.picture->height};
    PELLUCID_TRY(Measured measured, measure(at));
    state_.judging.start(
        "comparing " + state_.facts.left.label + " with " + against.name,
        [test = std::move(measured.radiance), of = *against.picture, test_name = state_.facts.left.label,
         truth_name = against.name](TaskControl&) -> Result<Quality> {
            PELLUCID_TRY(Quality out, judge(test, of));
            out.test = test_name;
            out.truth = truth_name;
            return out;
        });
    return {};
}

template <rhi::Backend B>
Result<void> Session<B>::answer_measurements() {
    Requests& r = state_.requests;
    Facts& facts = state_.facts;
    const RenderSettings settings = wanted();
    if (std::exchange(r.measure_all, false)) {
        queue_.clear();
        for (const TransparencyTraits& t : all_transparencies)
            if (check_device(t.method, device_->info())) queue_.push_back(t.method);
        queued_ = queue_.size();
    }
    // By itself: once for each combination, and only against a picture that is there anyway.
    const bool right_is_there = state_.choices.against != Against::nothing && facts.right.drawn;
    const bool by_itself = state_.choices.measure_at_rest && right_is_there && state_.rig.rest() > 0.5 &&
                           !state_.judging.running() && (!facts.quality || facts.quality_is_old);
    const bool asked = std::exchange(r.measure, false) || by_itself;
    facts.measuring.reset();
    if (!asked && queue_.empty()) return {};

    const Result<Truth> against = truth(settings);
    if (!against || !against->picture) {
        if (against && !by_itself) state_.say("there is no reference picture to measure against yet", true);
        queue_.clear();
        return said(against);
    }
    RenderSettings at = settings;
    at.size = {against->picture->width, against->picture->height};
    facts.points.begin(state_.occasion(state_.reference_settings(settings)) + against->name,
                       facts.scene + ", " + std::to_string(at.size.width) + "x" + std::to_string(at.size.height) +
                           " pixels, against " + against->name);
    if (!queue_.empty()) {
        const Transparency method = queue_.front();
        queue_.pop_front();
        facts.measuring = Progress{std::string("measuring ") + name(method),
                                   1 - static_cast<double>(queue_.size()) / static_cast<double>(queued_)};
        PELLUCID_CHECK(said(add_point(with_method(at, method), *against)));
    }
    if (!asked) return {};
    facts.quality_is_old = false;
    at = left_.renderer()->settings();
    at.size = {against->picture->width, against->picture->height};
    PELLUCID_CHECK(said(add_point(at, *against)));
    return said(compare_sides(settings));
}

}  // namespace pellucid::samples::viewer
