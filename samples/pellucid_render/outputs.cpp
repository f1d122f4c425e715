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
using nlohmann::ordered_json;

namespace {

std::string ending(const std::string& file) {
    return std::filesystem::path(file).extension().string();
}

ordered_json summary(const measure::Summary& s) {
    return {{"median", s.median}, {"low", s.min}, {"high", s.max}, {"count", s.count}};
}

}  // namespace

std::vector<OutputFile> output_files(const Options& options) {
    const std::vector<std::string> picture{".png", ".exr", ".pfm"};
    std::vector<OutputFile> files;
    if (!options.out.empty()) files.push_back({options.out, picture});
    for (const auto& [name, file] : options.aovs) files.push_back({file, picture});
    if (!options.heatmap.empty()) files.push_back({options.heatmap, {".png"}});
    if (!options.stats.empty()) files.push_back({options.stats, {".json"}});
    return files;
}

Result<void> check_writable(const OutputFile& wanted) {
    const std::string& file = wanted.file;
    if (std::find(wanted.endings.begin(), wanted.endings.end(), ending(file)) == wanted.endings.end()) {
        std::string endings;
        for (const std::string& e : wanted.endings)
            endings += (endings.empty() ? "" : e == wanted.endings.back() ? " or " : ", ") + e;
        return Error{Errc::invalid_argument, "'" + file + "' must end in " + endings};
    }
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

namespace {

/// `.png` writes `display`, without its alpha; `.pfm` and `.exr` write `linear`.
Result<void> write_picture(const std::string& file, const Drawn& drawn) {
    if (ending(file) == ".exr") return write_exr(file, drawn.linear);
    if (ending(file) == ".pfm") return write_pfm(file, drawn.linear);
    Image8 rgb(drawn.display.width, drawn.display.height, 3);
    for (std::size_t i = 0; i < rgb.data.size() / 3; ++i)
        std::copy_n(drawn.display.data.data() + 4 * i, 3, rgb.data.data() + 3 * i);
    return write_png(file, rgb);
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

ordered_json passes_of(const Report& report) {
    ordered_json passes = ordered_json::array();
    for (const PassReport& pass : report.stats.passes) {
        ordered_json entry{{"name", pass.name}, {"ran", pass.ran}};
        if (!pass.ran) entry["why_not"] = pass.reason;
        for (const PassTime& time : report.pass_times)
            if (time.name == pass.name) entry["gpu_ms"] = summary(time.ms);
        passes.push_back(entry);
    }
    return passes;
}

ordered_json settings_of(const Report& report, const RenderSettings& s) {
    ordered_json json{{"transparency", report.translucency.method},
                      {"shadows", name(s.shadows)},
                      {"environment", name(s.environment.kind)},
                      {"brdf", name(s.brdf)},
                      {"tonemap", name(s.tonemap)}};
    if (report.device)
        json.update({{"gbuffer", name(s.gbuffer)},
                     {"lighting", name(report.stats.lighting)},
                     {"shading", name(s.shading)},
                     {"exact", s.exact}});
    return json;
}

ordered_json stats_of(const Options& options, const Report& report) {
    const RenderSettings& s = options.settings;
    const rhi::DeviceInfo cpu{.backend = "reference", .name = "CPU", .driver = "none", .api = "none"};
    const rhi::DeviceInfo& device = report.device ? *report.device : cpu;
    ordered_json json{{"backend", device.backend},
                      {"device", device.name},
                      {"driver", device.driver},
                      {"api", device.api},
                      {"size", {s.size.width, s.size.height}},
                      {"settings", settings_of(report, s)},
                      {"frames", options.frames},
                      {"frame_ms", summary(report.frame_ms)},
                      {"load_to_first_frame_ms", report.load_to_first_frame_ms},
                      {"passes", passes_of(report)},
                      {"translucency", to_json(report.translucency, s)}};
    ordered_json resources = ordered_json::array();
    for (const TextureReport& r : report.stats.resources)
        resources.push_back({{"name", r.name}, {"bytes", r.bytes}, {"shares_memory", r.shared}});
    json["resources"] = resources;
    json["bytes"] = report.stats.bytes;
    json["pipelines"] = report.stats.pipelines;
    json["draws"] = report.stats.draws;
    json["triangles"] = report.stats.triangles;
    json["lights"] = report.stats.lights;
    if (report.device) {
        const std::string& why = report.stats.lighting_why;
        json["lighting"] = {{"method", name(report.stats.lighting)}, {"why", why.empty() ? "asked for" : why}};
    }
    if (report.device && s.shadows != Shadows::none) {
        const RenderStats& r = report.stats;
        json["shadows"] = {{"method", name(r.shadows)}, {"why", r.shadows_why.empty() ? "asked for" : r.shadows_why},
                           {"size", s.shadow_size},     {"lights", r.shadow_lights},
                           {"maps", r.shadow_maps},     {"drawn", r.shadows_drawn}};
    }
    if (report.comparison) json["comparison"] = ordered_json::parse(report.comparison->json);
    json["warnings"] = report.stats.warnings;
    return json;
}

Result<void> write_text(const std::string& file, const std::string& text) {
    std::FILE* out = std::fopen(file.c_str(), "wb");
    if (!out) return Error{Errc::io, "'" + file + "' cannot be written"};
    const bool complete = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    if (std::fclose(out) != 0 || !complete) return Error{Errc::io, "'" + file + "' could not be written whole"};
    return {};
}

/// Says what the comparison and the audit found.  \returns the exit status.
Exit say_findings(const Options& options, const Report& report) {
    Exit status = Exit::done;
    if (const auto& found = report.comparison) {
        std::printf("%s\n", found->text.c_str());
        if (found->heat_map)
            std::printf(
                "heat map %s: logarithmic from %.3g (dark) to %.3g (white); black: equal; magenta: left out or not "
                "finite\n",
                options.heatmap.c_str(), found->heat_map->low, found->heat_map->high);
        if (!found->within_budget) {
            std::fprintf(stderr, "pellucid-render: the RMSE %.4g is not within the error budget %.4g\n", found->rmse,
                         *options.error_budget);
            status = Exit::error_budget;
        }
    }
    if (const auto& audit = report.translucency.audit) {
        std::printf("audit: %llu of %llu pixels composited another number of fragments than were counted\n",
                    static_cast<unsigned long long>(audit->different), static_cast<unsigned long long>(audit->pixels));
        if (audit->different > 0 && report.translucency.exact) {
            std::fprintf(
                stderr,
                "pellucid-render: the audit failed: %s is exact, and yet %llu pixels composited up to %u fragments "
                "more or fewer than there are\n",
                report.translucency.method.c_str(), static_cast<unsigned long long>(audit->different), audit->max);
            status = Exit::failed;
        }
    }
    return status;
}

}  // namespace

Result<int> finish(const Options& options, const Drawn& drawn, const std::vector<Channel>& channels, Report& report,
                   const std::string& text) {
    for (std::string& warning : warnings(report.translucency)) report.stats.warnings.push_back(std::move(warning));
    for (const std::string& warning : report.stats.warnings)
        std::fprintf(stderr, "pellucid-render: warning: %s\n", warning.c_str());
    if (!options.out.empty()) PELLUCID_CHECK(write_picture(options.out, drawn));
    for (const Channel& channel : channels) PELLUCID_CHECK(write_values(channel.file, channel.values));
    if (report.comparison && report.comparison->heat_map)
        PELLUCID_CHECK(write_png(options.heatmap, report.comparison->heat_map->rgb));
    if (!options.stats.empty()) PELLUCID_CHECK(write_text(options.stats, stats_of(options, report).dump(2) + "\n"));
    const Exit status = say_findings(options, report);
    std::printf("%s%s%s\n", text.c_str(), options.out.empty() ? "" : ", ", options.out.c_str());
    return static_cast<int>(status);
}
