// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The viewer on one device: everything that goes when the device goes.  A frame obeys the choices, draws the pictures
/// and the panel into the canvas, and tells the panel what it took.
#include "canvas.hpp"
#include "overdraw.hpp"
#include "side.hpp"
#include "state.hpp"
#include "support/imgui_pass.hpp"
#include <array>
#include <deque>

namespace pellucid::samples::viewer {

template <rhi::Backend B>
class Session {
public:
    /// `state` must outlive the session and have a scene.  Errors: those of the device's creation and of its objects.
    [[nodiscard]] static Result<std::unique_ptr<Session>> create(const rhi::DeviceDesc& desc, State& state);

    /// One frame on a canvas of this size.  Gives whether anything was drawn: not where a side is 0.  What goes wrong
    /// with a file, a setting or a measurement is said in the panel, and the last good state stays.
    /// Errors: what makes it impossible to go on: device loss, a canvas that cannot be had, the very first picture.
    [[nodiscard]] Result<bool> frame(const Input& input, Extent2D canvas);

    [[nodiscard]] typename B::Device& device() noexcept { return *device_; }
    [[nodiscard]] rhi::Texture canvas() const noexcept { return canvas_->texture(); }
    [[nodiscard]] Extent2D canvas_size() const noexcept { return canvas_->size(); }
    /// `[h, w, 4]` codes of the last frame; waits.
    [[nodiscard]] Result<Image8> read_canvas() { return canvas_->read(); }
    /// The same without the user interface, and without the panel's part of the canvas; draws the canvas anew.
    [[nodiscard]] Result<Image8> read_picture();
    /// `[h, w, 4]` linear radiance of the left picture; waits.
    [[nodiscard]] Result<ImageF> read_radiance() { return left_.renderer()->read_hdr(); }
    [[nodiscard]] Renderer<B>* left() const noexcept { return left_.renderer(); }
    [[nodiscard]] Renderer<B>* right() const noexcept { return right_.renderer(); }
    /// Methods wait to be measured, one a frame.
    [[nodiscard]] bool measuring() const noexcept { return !queue_.empty(); }
    /// Why the pictures are not what was asked for, left and right; without a message where they are.
    [[nodiscard]] std::array<Error, 2> problems() const { return {left_.error(), right_.error()}; }
    /// [ms] that building the left renderer took, the last time.
    [[nodiscard]] double build_ms() const noexcept { return left_.build_ms(); }

private:
    Session(std::unique_ptr<typename B::Device> device, State& state) : device_(std::move(device)), state_(state) {}
    [[nodiscard]] Result<void> draw_pictures();
    [[nodiscard]] Result<void> take_times();
    [[nodiscard]] Result<void> draw_right(const RenderSettings& wanted);
    [[nodiscard]] Result<void> draw_view(const RenderSettings& wanted);
    [[nodiscard]] Result<void> draw_errors(const RenderSettings& wanted);
    [[nodiscard]] Result<void> show_heat(const HeatPicture& picture, std::uint32_t divisor);
    [[nodiscard]] Result<void> compose(const ImDrawData* lists);
    [[nodiscard]] Result<void> save();

    // Measurements (session_measure-inl.hpp).
    /// What errors are measured against: the reference picture where there must be one, else what an exact method
    /// draws.
    struct Truth {
        std::string name;
        const ImageF* picture = nullptr;  ///< [h, w, 3]; null: there is none yet
        std::uint32_t divisor = 1;
    };
    struct Measured {
        double ms = 0;
        ImageF radiance;  ///< [h, w, 3]
    };
    [[nodiscard]] Result<Truth> truth(const RenderSettings& wanted);
    /// Draws a few frames with these settings and tells the time of one.  Errors: those of the renderer.
    [[nodiscard]] Result<Measured> measure(const RenderSettings& settings);
    [[nodiscard]] Result<void> add_point(const RenderSettings& settings, const Truth& truth);
    [[nodiscard]] Result<void> compare_sides(const RenderSettings& wanted);
    [[nodiscard]] Result<void> answer_measurements();

    [[nodiscard]] RenderSettings wanted() const {
        RenderSettings out = state_.choices.render;
        out.size = layout_.picture_size();
        return out;
    }
    /// Device loss ends the frame; everything else is said in the panel.
    template <class T>
    [[nodiscard]] Result<void> said(const Result<T>& result) {
        if (result) return {};
        if (result.error().code == Errc::device_lost) return result.error();
        state_.say(result.error().message, true);
        return {};
    }
    void tell_device();

    std::unique_ptr<typename B::Device> device_;  // first: everything else goes before it
    State& state_;
    std::optional<Canvas<B>> canvas_;
    std::optional<ImGuiPass<B>> ui_;
    Layout layout_;
    Side<B> left_, right_;
    Side<B> exact_, small_;  ///< what errors are measured against; the left picture at the size of a reference
    std::optional<Overdraw<B>> overdraw_;
    std::shared_ptr<const Scene> overdraw_of_;
    Uploaded<B> heat_, reference_;
    std::string reference_shown_;  ///< which one, and how it is tone-mapped
    Source left_source_, right_source_;
    ImageF truth_;          ///< of an exact method
    std::string truth_of_;  ///< what it is of
    std::string measured_;  ///< what the quality is of
    std::deque<Transparency> queue_;
    std::size_t queued_ = 0;
};

}  // namespace pellucid::samples::viewer

#include "session-inl.hpp"
#include "session_measure-inl.hpp"
