// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// All of the viewer that no device holds: it goes on when a device is lost or another backend is chosen.
#include "facts.hpp"
#include "rig.hpp"
#include "ui.hpp"
#include <string>

namespace pellucid::samples::viewer {

struct State {
    Choices choices;
    Requests requests;
    Facts facts;
    Rig rig;
    Ui ui;

    Loaded loaded;
    std::uint64_t scene_number = 0;      ///< counts scenes
    std::uint64_t camera_number = 0;     ///< counts places of the camera
    std::uint64_t reference_number = 0;  ///< counts reference pictures
    Camera camera;                       ///< of the last frame

    Task<Loaded> loading;
    Task<std::shared_ptr<const ImageF>> environment;
    Task<ReferencePicture> drawing;
    Task<Quality> judging;
    std::optional<ReferencePicture> reference;

    /// Shows a scene from now on.  `picture`: size that a camera is made for, where the scene has none.
    void show(Loaded scene, Extent2D picture);
    /// Reads a scene or an environment's picture, by the file's ending, beside the frames; what cannot be read is said
    /// and changes nothing.
    void open(const std::string& file);
    /// Takes what is done, follows the camera, and says how far the rest is.
    void poll(Extent2D picture);
    /// Something is being computed beside the frames.
    [[nodiscard]] bool busy() const {
        return loading.running() || environment.running() || drawing.running() || judging.running();
    }
    void say(std::string text, bool error) {
        facts.message = std::move(text);
        facts.message_is_error = error;
    }

    // ------------------------------------------------------------------------------------- reference pictures
    /// Names scene, camera, and everything of the settings that a picture without errors depends on.
    [[nodiscard]] std::string occasion(const RenderSettings& settings) const;
    /// What the reference renderer would be asked for now: only what it heeds, at its own size.
    [[nodiscard]] RenderSettings reference_settings(const RenderSettings& left) const;
    /// The reference picture of just this, or null.
    [[nodiscard]] const ReferencePicture* fitting_reference(const RenderSettings& left) const;
    /// Begins one where there is none that fits, the camera rests and nothing is being drawn for it already.
    void want_reference(const RenderSettings& left, bool again = false);

private:
    std::string drawing_of_;  ///< what the running drawing is of
    bool declined_ = false;   ///< cancelled or failed for that: it is not begun again by itself
};

/// Whether two cameras see the same.
[[nodiscard]] bool same(const Camera& a, const Camera& b);

}  // namespace pellucid::samples::viewer
