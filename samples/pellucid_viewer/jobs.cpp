// SPDX-License-Identifier: MIT
#include "jobs.hpp"
#include "pictures.hpp"
#include "../support/reference_picture.hpp"
#include <pellucid/measure/quality.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

namespace pellucid::samples::viewer {

Result<Loaded> load_scene(const std::string& file) {
    const auto start = std::chrono::steady_clock::now();
    Loaded out;
    if (file.empty()) {
        out = {.scene = std::make_shared<const Scene>(make_demo_scene()), .name = "demo scene"};
    } else {
        PELLUCID_TRY(Scene scene, load_gltf(file));
        out = {.scene = std::make_shared<const Scene>(std::move(scene)),
               .name = file.substr(file.find_last_of('/') + 1)};
    }
    out.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return out;
}

#if defined(PELLUCID_HAS_REFERENCE)
bool has_reference() {
    return true;
}

Result<ReferencePicture> draw_reference(std::shared_ptr<const Scene> scene, const Camera& camera,
                                        const RenderSettings& settings, TaskControl& control) {
    reference::RenderOptions how = reference_options(*scene, settings);
    how.threads = std::max(1u, std::thread::hardware_concurrency() - 1);  // one is left to the window
    how.user = &control;
    how.progress = [](void* user, double fraction) { static_cast<TaskControl*>(user)->fraction = fraction; };
    how.stop = &control.stop;
    PELLUCID_TRY(reference::Picture picture, reference::render(*scene, camera, how));
    if (!picture.complete) return Error{Errc::invalid_argument, "the reference picture was cancelled"};
    return ReferencePicture{settings, camera, std::move(scene), std::move(picture.radiance)};
}
#else
bool has_reference() {
    return false;
}

Result<ReferencePicture> draw_reference(std::shared_ptr<const Scene>, const Camera&, const RenderSettings&,
                                        TaskControl&) {
    return Error{Errc::unsupported, "this program was built without the reference renderer (PELLUCID_REFERENCE=OFF)"};
}
#endif

Result<Quality> judge(const ImageF& test, const ImageF& truth) {
    using M = measure::QualityMetrics;
    PELLUCID_TRY(const measure::QualityReport report,
                 measure::quality(test, truth, {.metrics = M::errors | M::tone_mapped_psnr | M::ldr_flip}));
    return Quality{.rmse = report.absolute->rmse,
                   .max = report.absolute->max,
                   .psnr = report.tone_mapped_psnr->psnr,
                   .flip = report.ldr_flip->mean,
                   .different = report.absolute->different_pixels,
                   .nonfinite = report.absolute->nonfinite + report.absolute->nonfinite_reference};
}

Image8 tone_mapped(const RenderSettings& settings, const ImageF& radiance) {
    return display_picture(settings, radiance);
}

std::string free_file_name(const char* ending) {
    for (int n = 1;; ++n) {
        const std::string file = "pellucid-viewer-" + std::to_string(n) + ending;
        if (!std::filesystem::exists(file)) return file;
    }
}

ImageF rgb(const ImageF& picture) {
    ImageF out(picture.width, picture.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        std::copy_n(&picture.data[picture.channels * i], 3, &out.data[3 * i]);
    return out;
}

}  // namespace pellucid::samples::viewer
