// SPDX-License-Identifier: MIT
#include "options.hpp"
#include <pellucid/core/version.hpp>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>

namespace {

using namespace pellucid;

/// "WxH"; 0 is let through, so that the device's own sentence explains the limits.
std::string parse_size(const std::string& text, Extent2D& size) {
    unsigned long long w = 0, h = 0;
    char end = 0;
    if (std::sscanf(text.c_str(), "%llux%llu%c", &w, &h, &end) != 2 || text[0] == '-' || w > 0xFFFFFFFFull ||
        h > 0xFFFFFFFFull)
        return "'" + text + "' is not a size: write WIDTHxHEIGHT, for example 1280x720";
    size = {static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(h)};
    return {};
}

std::string parse_color(const std::string& text, glm::vec3& color) {
    char end = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%c", &color.x, &color.y, &color.z, &end) != 3)
        return "'" + text + "' is not a colour: write three linear values, for example 0.1,0.1,0.2";
    for (int i = 0; i < 3; ++i)
        if (!(color[i] >= 0.0f) || !std::isfinite(color[i]))
            return "'" + text + "' has a value that is negative or not finite";
    return {};
}

template <class E>
void add_choice(CLI::App& app, const char* flag, E& value, std::map<std::string, E> names, const char* help) {
    app.add_option(flag, value, help)->transform(CLI::CheckedTransformer(std::move(names)))->option_text("NAME");
}

}  // namespace

std::pair<Options, std::optional<int>> parse_options(int argc, char** argv) {
    Options o;
    o.settings.size = {1280, 720};
    CLI::App app{"Draws a glTF 2.0 scene, deferred-lit, with transparency.", "pellucid-render"};
    std::string size, background, environment, transparency = "auto", lighting = "auto";
    std::vector<std::string> aovs;
    app.add_option("SCENE", o.scene, "glTF 2.0 file, .gltf or .glb");
    app.add_option("--backend", o.backend, "auto, vulkan or opengl")
        ->check(CLI::IsMember({"auto", "vulkan", "opengl"}));
    app.add_option("--device", o.device, "index or part of the name; see --list-devices");
    app.add_flag("--list-devices", o.list_devices, "list the devices of every backend and what each lacks");
    app.add_option("--size", size, "WIDTHxHEIGHT of the picture (1280x720)");
    app.add_option("--camera", o.camera, "index or name of a camera of the scene");
    app.add_option("--transparency", transparency,
                   "auto, none, sorted, peel, peel-seed, dual-peel, interleaved, interleaved-skyx or abuffer")
        ->check(CLI::IsMember({"auto", "none", "sorted", "peel", "peel-seed", "dual-peel", "interleaved",
                               "interleaved-skyx", "abuffer"}));
    add_choice<GBufferLayout>(app, "--gbuffer", o.settings.gbuffer,
                              {{"compact", GBufferLayout::compact}, {"classic", GBufferLayout::classic}},
                              "compact (16 bytes a pixel) or classic (36)");
    app.add_option("--lighting", lighting, "auto or loop: every light at every pixel")
        ->check(CLI::IsMember({"auto", "loop"}));
    add_choice<ShadingStage>(app, "--shading", o.settings.shading,
                             {{"compute", ShadingStage::compute}, {"fragment", ShadingStage::fragment}},
                             "where lighting runs: compute or fragment");
    add_choice<Brdf>(app, "--brdf", o.settings.brdf,
                     {{"gltf", Brdf::gltf}, {"seed", Brdf::seed}, {"blinn-phong", Brdf::blinn_phong}},
                     "gltf, seed or blinn-phong");
    app.add_option("--environment", environment, "none: no light but the scene's own")->check(CLI::IsMember({"none"}));
    app.add_flag("!--no-default-light", o.settings.default_light, "no sun and ambient for a scene without lights");
    app.add_option("--background", background, "R,G,B linear");
    add_choice<ToneCurve>(app, "--tonemap", o.settings.tonemap,
                          {{"none", ToneCurve::none},
                           {"reinhard", ToneCurve::reinhard},
                           {"neutral", ToneCurve::neutral},
                           {"aces", ToneCurve::aces},
                           {"agx", ToneCurve::agx}},
                          "none, reinhard, neutral, aces or agx");
    app.add_option("--exposure", o.settings.exposure_ev, "stops: radiance times 2^EV")->check(CLI::Range(-64.0, 64.0));
    app.add_flag("--exact", o.settings.exact,
                 "lighting arithmetic with the same bits on both backends (about 10 % slower)");
    app.add_option("--out", o.out, "picture: .png (display), .exr or .pfm (linear, before the tone map)");
    app.add_option("--aov", aovs, "NAME=FILE: depth, normal, base_color, roughness, metallic, occlusion or emissive")
        ->allow_extra_args(false);
    app.add_option("--stats", o.stats, "FILE.json: what ran and what it took");
    app.add_option("--frames", o.frames, "frames to draw, for the timings (1)")->check(CLI::Range(1u, 1000000u));
    app.add_option("--compare", o.compare, "FILE.pfm (linear) or .png (display) to compare with");
    app.add_option("--mask", o.mask, "FILE.pgm: compare only where it is 255");
    app.add_option("--heatmap", o.heatmap, "FILE.png: where the differences are");
    double budget = 0;
    auto* budget_option = app.add_option("--error-budget", budget, "largest RMSE that --compare may find (exit 6)");
    budget_option->check(CLI::NonNegativeNumber);
    app.add_flag("--validate", o.validate, "validation layer and GL debug output; any message fails the run");
    app.add_flag("--gl-spirv", o.gl_spirv, "OpenGL: load SPIR-V instead of GLSL text");
    app.add_option("--pipeline-cache", o.pipeline_cache, "FILE to keep compiled pipelines in");
    app.set_version_flag("--version", std::string("pellucid-render ") + PELLUCID_VERSION_STRING);

    auto usage = [](const std::string& what) {
        std::fprintf(stderr, "pellucid-render: %s\n", what.c_str());
        return static_cast<int>(Exit::usage);
    };
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return {o, app.exit(e)};
        return {o, usage(std::string(e.what()) + " (--help lists the options)")};
    }
    if (!size.empty())
        if (const std::string wrong = parse_size(size, o.settings.size); !wrong.empty()) return {o, usage(wrong)};
    if (!background.empty())
        if (const std::string wrong = parse_color(background, o.settings.background); !wrong.empty())
            return {o, usage(wrong)};
    for (const Transparency t :
         {Transparency::none, Transparency::sorted, Transparency::peel, Transparency::peel_seed,
          Transparency::dual_peel, Transparency::interleaved, Transparency::interleaved_skyx, Transparency::abuffer})
        if (transparency == name(t)) o.settings.transparency = t;
    if (environment == "none") o.settings.default_light = false;
    if (budget_option->count() > 0) o.error_budget = budget;
    for (const std::string& aov : aovs) {
        const std::size_t at = aov.find('=');
        if (at == std::string::npos || at + 1 == aov.size())
            return {o, usage("--aov takes NAME=FILE, not '" + aov + "'")};
        o.aovs.emplace_back(aov.substr(0, at), aov.substr(at + 1));
    }
    o.settings.keep_gbuffer = !o.aovs.empty();
    if (o.scene.empty() && !o.list_devices) return {o, usage("no scene is named (--help lists the options)")};
    if ((!o.heatmap.empty() || o.error_budget || !o.mask.empty()) && o.compare.empty())
        return {o, usage("--heatmap, --mask and --error-budget go with --compare")};
    return {o, std::nullopt};
}
