// SPDX-License-Identifier: MIT
#include "state.hpp"
#include "../support/environment_file.hpp"
#include <cstdio>
#include <utility>

namespace pellucid::samples::viewer {
namespace {

constexpr double rest_before_reference = 0.3;  // [s] that the camera has stood still

/// The result of a task that is done, or nothing; an error is said.
template <class T>
std::optional<T> take(Task<T>& task, State& state) {
    std::optional<Result<T>> result = task.take();
    if (!result) return std::nullopt;
    if (!*result) {
        state.say(result->error().message, true);
        return std::nullopt;
    }
    return std::move(**result);
}
template <class T>
std::optional<Progress> progress(const Task<T>& task) {
    if (!task.running()) return std::nullopt;
    return Progress{task.what(), task.fraction()};
}

}  // namespace

bool same(const Camera& a, const Camera& b) {
    return a.projection == b.projection && a.vertical_fov == b.vertical_fov && a.half_width == b.half_width &&
           a.half_height == b.half_height && a.near == b.near && a.far == b.far &&
           a.world_from_view == b.world_from_view;
}

void State::show(Loaded scene, Extent2D picture) {
    loaded = std::move(scene);
    ++scene_number;
    rig.start(*loaded.scene, picture);
    facts.scene = loaded.name;
    facts.cameras = rig.names();
    facts.quality.reset();
    drawing.cancel();
    reference.reset();
    declined_ = false;
}

void State::open(const std::string& file) {
    const auto ends = [&](const char* ending) { return file.ends_with(ending); };
    if (ends(".hdr")) {
        environment.start("reading " + file, [file](TaskControl&) { return read_environment(file); });
    } else if (ends(".glb") || ends(".gltf")) {
        loading.start("reading " + file, [file](TaskControl&) { return load_scene(file); });
    } else {
        say("'" + file + "' is neither a scene (.glb, .gltf) nor an environment (.hdr)", true);
    }
}

void State::poll(Extent2D picture) {
    if (auto scene = take(loading, *this)) {
        say(scene->name + " is shown", false);
        show(std::move(*scene), picture);
    }
    if (auto read = take(environment, *this)) {
        choices.render.environment.picture = std::move(*read);
        choices.render.environment.kind = EnvironmentKind::picture;
        say("the environment is shown", false);
    }
    const bool was_drawing = drawing.running();
    if (auto drawn = take(drawing, *this)) {
        reference = std::move(*drawn);
        ++reference_number;
    } else if (was_drawing && !drawing.running()) {
        declined_ = true;
    }
    if (auto judged = take(judging, *this)) {
        facts.quality = std::move(*judged);
        facts.quality_is_old = false;
    }
    if (requests.cancel_reference && drawing.running()) {
        drawing.cancel();
        declined_ = true;
    }
    requests.cancel_reference = false;
    if (requests.camera) rig.choose(*std::exchange(requests.camera, std::nullopt));
    facts.camera = rig.chosen();
    if (!same(camera, rig.camera())) {
        camera = rig.camera();
        ++camera_number;
        facts.quality_is_old = true;
    }
    facts.loading = loading.running() ? progress(loading) : progress(environment);
    facts.reference = progress(drawing);
    facts.judging = progress(judging);
}

std::string State::occasion(const RenderSettings& s) const {
    char text[320];
    std::snprintf(text, sizeof text, "scene %llu camera %llu %ux%u %s %s %d %g %g %g %s %p %d %d",
                  static_cast<unsigned long long>(scene_number), static_cast<unsigned long long>(camera_number),
                  s.size.width, s.size.height, name(s.shadows), name(s.brdf), s.default_light,
                  static_cast<double>(s.background.x), static_cast<double>(s.background.y),
                  static_cast<double>(s.background.z), name(s.environment.kind),
                  static_cast<const void*>(s.environment.picture.get()), s.environment.backdrop, s.exact);
    return text;
}

RenderSettings State::reference_settings(const RenderSettings& left) const {
    const std::uint32_t d = choices.reference_divisor;
    return {.size = {std::max(left.size.width / d, 1u), std::max(left.size.height / d, 1u)},
            .shadows = left.shadows,
            .brdf = left.brdf,
            .background = left.background,
            .environment = left.environment,
            .default_light = left.default_light};
}

const ReferencePicture* State::fitting_reference(const RenderSettings& left) const {
    const bool fits = reference && reference->scene == loaded.scene && viewer::same(reference->camera, camera) &&
                      viewer::same(reference->settings, reference_settings(left));
    return fits ? &*reference : nullptr;
}

void State::want_reference(const RenderSettings& left, bool again) {
    facts.reference_is_old = reference.has_value() && !fitting_reference(left);
    if (!again && (fitting_reference(left) || rig.rest() < rest_before_reference)) return;
    const RenderSettings settings = reference_settings(left);
    const std::string of = occasion(settings);
    if (!again && of == drawing_of_ && (drawing.running() || declined_)) return;
    drawing_of_ = of;
    declined_ = false;
    drawing.start("the reference, " + std::to_string(settings.size.width) + "x" + std::to_string(settings.size.height),
                  [scene = loaded.scene, at = camera, settings](TaskControl& control) {
                      return draw_reference(scene, at, settings, control);
                  });
}

}  // namespace pellucid::samples::viewer
