// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Session<B>: the frame.
#include "panel.hpp"
#include "pictures.hpp"
#include "session.hpp"
#include <chrono>

namespace pellucid::samples::viewer {

template <rhi::Backend B>
Result<std::unique_ptr<Session<B>>> Session<B>::create(const rhi::DeviceDesc& desc, State& state) {
    PELLUCID_TRY(std::unique_ptr<typename B::Device> device, B::create(desc));
    std::unique_ptr<Session> session(new Session(std::move(device), state));
    PELLUCID_TRY(session->canvas_, Canvas<B>::create(*session->device_));
    PELLUCID_TRY(session->ui_, ImGuiPass<B>::create(*session->device_, state.ui.fonts(), Canvas<B>::format));
    session->tell_device();
    return session;
}

template <rhi::Backend B>
void Session<B>::tell_device() {
    Facts& facts = state_.facts;
    facts.device = device_->info();
    facts.unavailable.clear();
    for (const TransparencyTraits& t : all_transparencies) {
        const Result<void> can = check_device(t.method, device_->info());
        facts.unavailable.push_back(can ? "" : can.error().message);
    }
    facts.history.clear();
    facts.points = {};  // times of another device
    facts.quality.reset();
}

template <rhi::Backend B>
Result<bool> Session<B>::frame(const Input& input, Extent2D size) {
    const auto start = std::chrono::steady_clock::now();
    for (const std::string& file : input.dropped) state_.open(file);
    if (input.toggle_ui) state_.choices.hide_ui = !state_.choices.hide_ui;
    if (input.screenshot) state_.requests.screenshot_png = true;
    layout_ = layout_of(size, state_.choices.hide_ui);
    const bool over_picture =
        layout_.over_picture(input.x, input.y) && (layout_.panel == 0 || !state_.ui.wants_pointer());
    const bool splits = state_.split_drag.move(input, layout_, over_picture, state_.choices);
    state_.rig.move(input, state_.choices.motion, layout_.picture_size(), over_picture && !splits);
    state_.poll(layout_.picture_size());
    if (layout_.picture.width == 0 || layout_.picture.height == 0) return false;
    PELLUCID_CHECK(canvas_->resize(size));
    PELLUCID_CHECK(draw_pictures());
    PELLUCID_CHECK(answer_measurements());

    state_.ui.begin(input, size);
    if (!state_.choices.hide_ui) draw_panel(layout_, state_.facts, state_.choices, state_.requests);
    const ImDrawData& lists = state_.ui.end();
    PELLUCID_CHECK(compose(&lists));
    PELLUCID_CHECK(save());
    state_.facts.history.wall.push(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    return true;
}

template <rhi::Backend B>
Result<void> Session<B>::draw_pictures() {
    const RenderSettings settings = wanted();
    PELLUCID_CHECK(take_times());
    PELLUCID_TRY(const bool drawn, left_.draw(*device_, state_.loaded.scene, settings, state_.camera));
    Facts& facts = state_.facts;
    facts.left.problem = left_.problem();
    if (!left_.renderer()) return left_.error();
    if (left_.rebuilt()) facts.history.clear();
    left_source_ = {.texture = left_.renderer()->display()};
    facts.left.drawn = drawn;
    facts.left.label = describe(left_.renderer()->settings());
    facts.left.stats = left_.renderer()->stats();
    PELLUCID_CHECK(draw_right(settings));
    return draw_view(settings);
}

/// Of the last frame, before its renderer draws anything else: a frame that waits on its way drops what nobody took.
template <rhi::Backend B>
Result<void> Session<B>::take_times() {
    if (!left_.renderer()) return {};
    const auto spans = left_.renderer()->gpu_times();
    if (!spans) return said(spans);
    state_.facts.history.push_gpu(*spans);
    return {};
}

template <rhi::Backend B>
Result<void> Session<B>::draw_right(const RenderSettings& settings) {
    Facts& facts = state_.facts;
    right_source_ = {};
    facts.right = {};
    if (state_.choices.against != Against::method) right_.release();
    if (state_.choices.against == Against::method) {
        const RenderSettings other = with_method(settings, state_.choices.other);
        PELLUCID_TRY(facts.right.drawn, right_.draw(*device_, state_.loaded.scene, other, state_.camera));
        facts.right.problem = right_.problem();
        if (!right_.renderer()) return {};
        right_source_ = {.texture = right_.renderer()->display()};
        facts.right.label = describe(right_.renderer()->settings());
        facts.right.stats = right_.renderer()->stats();
    }
    if (state_.choices.against == Against::reference) {
        state_.want_reference(settings, std::exchange(state_.requests.draw_reference, false));
        const ReferencePicture* picture = state_.fitting_reference(settings);
        if (!picture) return {};
        const std::string shown =
            std::to_string(state_.reference_number) + name(settings.tonemap) + std::to_string(settings.exposure_ev);
        if (shown != reference_shown_) {
            PELLUCID_CHECK(reference_.set(*device_, tone_mapped(settings, picture->radiance)));
            reference_shown_ = shown;
        }
        right_source_ = {.texture = reference_.texture, .divisor = state_.choices.reference_divisor};
        facts.right.drawn = true;
        facts.right.label = "reference";
    }
    return {};
}

template <rhi::Backend B>
Result<void> Session<B>::draw_view(const RenderSettings& settings) {
    state_.facts.legend = {};
    if (state_.choices.view != View::overdraw) overdraw_.reset();
    if (state_.choices.view != View::error && queue_.empty()) exact_.release();
    switch (state_.choices.view) {
        case View::picture:
            return {};
        case View::layers: {
            PELLUCID_CHECK(device_->wait(left_.ticket()));  // counting waits too, and is a frame of the same renderer
            PELLUCID_CHECK(take_times());
            const auto counts = left_.renderer()->count_layers();
            if (!counts) return said(counts);
            return show_heat(heat_picture(*counts, "translucent fragments a pixel"), 1);
        }
        case View::error:
            return draw_errors(settings);
        case View::overdraw: {
            if (!overdraw_ || overdraw_of_ != state_.loaded.scene || !(overdraw_->size() == settings.size)) {
                overdraw_.reset();
                auto made = Overdraw<B>::create(*device_, *state_.loaded.scene, settings.size);
                if (!made) return said(made);
                overdraw_ = std::move(*made);
                overdraw_of_ = state_.loaded.scene;
            }
            const auto counts = overdraw_->count(state_.camera);
            if (!counts) return said(counts);
            return show_heat(heat_picture(*counts, "fragments rasterised a pixel, opaque and hidden ones too",
                                          measure::HeatScale::linear),
                             1);
        }
    }
    return {};
}

template <rhi::Backend B>
Result<void> Session<B>::show_heat(const HeatPicture& picture, std::uint32_t divisor) {
    PELLUCID_CHECK(heat_.set(*device_, picture.display));
    left_source_ = {.texture = heat_.texture, .divisor = divisor};
    state_.facts.legend = picture.legend;
    return {};
}

/// The pictures, and `lists` over them where there are any.
template <rhi::Backend B>
Result<void> Session<B>::compose(const ImDrawData* lists) {
    const bool split = state_.choices.against != Against::nothing && right_source_.texture;
    PELLUCID_TRY(typename B::Commands * cmd, device_->begin_frame());
    Result<void> done =
        canvas_->record(*cmd, layout_, left_source_, split ? right_source_ : Source{},
                        split ? split_column(layout_.picture.width, state_.choices.split) : layout_.picture.width);
    if (done && lists) done = ui_->record(*cmd, *lists, canvas_->texture(), canvas_->size());
    PELLUCID_TRY(const rhi::Ticket ticket, device_->submit());
    if (device_->info().timestamp_ns == 0) PELLUCID_CHECK(device_->wait(ticket));  // the wall clock is all there is
    return done;
}

template <rhi::Backend B>
Result<Image8> Session<B>::read_picture() {
    PELLUCID_CHECK(compose(nullptr));
    PELLUCID_TRY(const Image8 all, canvas_->read());
    const rhi::Rect& at = layout_.picture;
    Image8 out(at.width, at.height, 4);
    for (std::uint32_t y = 0; y < at.height; ++y)
        std::copy_n(all.texel(at.x, at.y + y), std::size_t{4} * at.width, out.texel(0, y));
    return out;
}

template <rhi::Backend B>
Result<void> Session<B>::save() {
    Requests& r = state_.requests;
    const auto write = [&](const char* ending, const auto& pixels, auto&& writer) -> Result<void> {
        if (!pixels) return said(pixels);
        const std::string file = free_file_name(ending);
        const Result<void> written = writer(file, *pixels);
        if (written) state_.say(file + " is written", false);
        return said(written);
    };
    if (std::exchange(r.screenshot_png, false)) PELLUCID_CHECK(write(".png", read_canvas(), write_png));
    if (std::exchange(r.picture_exr, false)) PELLUCID_CHECK(write(".exr", read_radiance(), write_exr));
    if (std::exchange(r.picture_png, false)) {
        PELLUCID_CHECK(write(".png", read_picture(), write_png));
        PELLUCID_CHECK(compose(nullptr));
    }
    return {};
}

}  // namespace pellucid::samples::viewer
