// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The viewer without a window: its state, a session on a device with validation on, and frames by hand.
#include <filesystem>
#include <pellucid/scene/sample_scenes.hpp>
#include "pellucid_viewer/instances.hpp"
#include "support/devices.hpp"
#include "support/gpu.hpp"

namespace pellucid::test {

namespace viewer = samples::viewer;

inline viewer::Loaded loaded(Scene scene, std::string name = "test scene") {
    return {.scene = std::make_shared<const Scene>(std::move(scene)), .name = std::move(name)};
}

/// False where there is no device.
template <rhi::Backend B>
struct TestViewer {
    viewer::State state;
    Log log;
    std::unique_ptr<viewer::Session<B>> session;
    Extent2D size{160, 120};  ///< of the canvas

    explicit operator bool() const { return session != nullptr; }
    /// Without the panel, and by the method whose pipelines are built fastest, unless `choices` says otherwise.
    explicit TestViewer(Scene scene, viewer::Choices choices = quick()) {
        state.choices = std::move(choices);
        state.show(loaded(std::move(scene)), layout().picture_size());
        auto made = viewer::Session<B>::create(log.desc(), state);
        if (!made && made.error().code == Errc::no_device) {
            skip(std::string(B::name) + ": " + made.error().message, "PELLUCID_REQUIRE_DEVICES");
            return;
        }
        session = must(std::move(made));
    }
    [[nodiscard]] static viewer::Choices quick() {
        viewer::Choices out;
        out.render.transparency = Transparency::sorted;
        out.reference_divisor = 1;
        out.hide_ui = true;
        return out;
    }
    [[nodiscard]] viewer::Layout layout() const { return viewer::layout_of(size, state.choices.hide_ui); }

    /// One frame in which the camera rests.
    bool frame(viewer::Input input = {.seconds = 1}) { return must(session->frame(input, size)); }
    Image8 canvas() { return must(session->read_canvas()); }
    /// Frames until nothing is computed beside them any more, at most for 60 s.
    void settle() {
        const auto start = std::chrono::steady_clock::now();
        do {
            while (state.busy() || session->measuring()) {
                REQUIRE(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
                if (!session->measuring()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
                frame();
            }
            frame();  // which may begin something else
        } while (state.busy() || session->measuring());
    }
    /// What a renderer of its own displays of the same scene and camera.
    [[nodiscard]] Image8 expected(RenderSettings settings) {
        settings.size = layout().picture_size();
        auto renderer = must(Renderer<B>::create(session->device(), *state.loaded.scene, settings));
        (void)must(renderer->render(state.rig.camera()));
        return must(renderer->read_display());
    }
};

/// Columns [from, to) of a picture.
[[nodiscard]] inline Image8 columns(const Image8& picture, std::uint32_t from, std::uint32_t to) {
    Image8 out(to - from, picture.height, picture.channels);
    for (std::uint32_t y = 0; y < picture.height; ++y)
        std::copy_n(picture.texel(from, y), std::size_t{to - from} * picture.channels, out.texel(0, y));
    return out;
}
[[nodiscard]] inline bool equal(const Image8& a, const Image8& b) {
    return a.width == b.width && a.height == b.height && a.data == b.data;
}

/// A working directory of its own, gone with the object.
class TemporaryFolder {
public:
    TemporaryFolder() : before_(std::filesystem::current_path()) {
        path_ = std::filesystem::temp_directory_path() / ("pellucid-viewer-test-" + std::to_string(::getpid()));
        std::filesystem::create_directories(path_);
        std::filesystem::current_path(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(path_);
    }

private:
    std::filesystem::path before_, path_;
};

}  // namespace pellucid::test
