// SPDX-License-Identifier: MIT
#include "outputs.hpp"
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/image_file.hpp>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

using namespace pellucid;

namespace {

std::string ending(const std::string& file) {
    return std::filesystem::path(file).extension().string();
}

nlohmann::ordered_json summary(const measure::Summary& s) {
    return {{"median", s.median}, {"low", s.min}, {"high", s.max}, {"count", s.count}};
}

}  // namespace

std::vector<std::string> output_files(const Options& options) {
    std::vector<std::string> files;
    for (const std::string* file : {&options.out, &options.stats, &options.heatmap})
        if (!file->empty()) files.push_back(*file);
    for (const auto& [name, file] : options.aovs) files.push_back(file);
    return files;
}

Result<void> check_writable(const std::string& file) {
    const std::string e = ending(file);
    if (e != ".png" && e != ".exr" && e != ".pfm" && e != ".json")
        return Error{Errc::invalid_argument, "'" + file + "' ends in neither .png, .exr, .pfm nor .json"};
    const std::filesystem::path path(file);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return Error{Errc::io, "'" + file + "' cannot be written: there is no folder " + folder.string()};
    if (::access(folder.c_str(), W_OK) != 0 || std::filesystem::is_directory(path, ignored))
        return Error{Errc::io, "'" + file + "' cannot be written: " + folder.string() + " does not allow it"};
    return {};
}

Result<Camera> choose_camera(const Scene& scene, const Options& options) {
    const std::string& wanted = options.camera;
    if (wanted.empty()) {
        const Extent2D size = options.settings.size;
        return scene.cameras.empty() ? frame_scene(scene, {std::max(1u, size.width), std::max(1u, size.height)})
                                     : scene.cameras.front();
    }
    for (const Camera& camera : scene.cameras)
        if (camera.name == wanted) return camera;
    char* end = nullptr;
    const unsigned long index = std::strtoul(wanted.c_str(), &end, 10);
    if (*end == 0 && wanted[0] != '-' && index < scene.cameras.size()) return scene.cameras[index];
    return Error{Errc::invalid_argument, "the scene has " + std::to_string(scene.cameras.size()) +
                                             " cameras and none is called or numbered '" + wanted + "'"};
}

Result<void> write_picture(const std::string& file, const ImageF& linear, const Image8& display) {
    if (ending(file) == ".png") {
        Image8 rgb(display.width, display.height, 3);
        for (std::size_t i = 0; i < rgb.data.size() / 3; ++i)
            std::copy_n(display.data.data() + 4 * i, 3, rgb.data.data() + 3 * i);
        return write_png(file, rgb);
    }
    return ending(file) == ".exr" ? write_exr(file, linear) : write_pfm(file, linear);
}

Result<void> write_values(const std::string& file, const ImageF& values) {
    if (ending(file) != ".png") return ending(file) == ".exr" ? write_exr(file, values) : write_pfm(file, values);
    Image8 shown(values.width, values.height, 3);
    for (std::size_t i = 0; i < shown.data.size(); ++i) {
        const float v = values.data[i];
        shown.data[i] = static_cast<std::uint8_t>(std::lround(255.0f * (v > 0 ? std::min(v, 1.0f) : 0.0f)));
    }
    return write_png(file, shown);
}

Result<void> write_stats(const std::string& file, const Options& options, const Report& report) {
    using nlohmann::ordered_json;
    const RenderSettings& s = options.settings;
    ordered_json json{{"backend", report.device->backend},
                      {"device", report.device->name},
                      {"driver", report.device->driver},
                      {"api", report.device->api},
                      {"size", {s.size.width, s.size.height}},
                      {"settings",
                       {{"transparency", name(s.transparency)},
                        {"gbuffer", name(s.gbuffer)},
                        {"lighting", "loop"},
                        {"shading", name(s.shading)},
                        {"brdf", name(s.brdf)},
                        {"tonemap", name(s.tonemap)},
                        {"exact", s.exact}}},
                      {"frames", options.frames},
                      {"frame_ms", summary(report.frame_ms)},
                      {"load_to_first_frame_ms", report.load_to_first_frame_ms}};
    ordered_json passes = ordered_json::array();
    for (const PassReport& pass : report.stats.passes) {
        ordered_json entry{{"name", pass.name}, {"ran", pass.ran}};
        if (!pass.ran) entry["why_not"] = pass.reason;
        for (const PassTime& time : report.pass_times)
            if (time.name == pass.name) entry["gpu_ms"] = summary(time.ms);
        passes.push_back(entry);
    }
    json["passes"] = passes;
    ordered_json resources = ordered_json::array();
    for (const TextureReport& r : report.stats.resources)
        resources.push_back({{"name", r.name}, {"bytes", r.bytes}, {"shares_memory", r.shared}});
    json["resources"] = resources;
    json["bytes"] = report.stats.bytes;
    json["pipelines"] = report.stats.pipelines;
    json["draws"] = report.stats.draws;
    json["triangles"] = report.stats.triangles;
    json["lights"] = report.stats.lights;
    if (report.comparison) {
        json["comparison"] = ordered_json::parse(report.comparison->json);
        json["comparison"]["with"] = options.compare;
    }
    json["warnings"] = report.stats.warnings;
    std::FILE* out = std::fopen(file.c_str(), "wb");
    if (!out) return Error{Errc::io, "'" + file + "' cannot be written"};
    const std::string text = json.dump(2) + "\n";
    const bool complete = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    if (std::fclose(out) != 0 || !complete) return Error{Errc::io, "'" + file + "' could not be written whole"};
    return {};
}
