// SPDX-License-Identifier: MIT
#include "options.hpp"
#include "../support/command_line.hpp"
#include "../support/environment_file.hpp"
#include "option_values.hpp"
#include <pellucid/core/version.hpp>
#include <map>

namespace {

using namespace pellucid;

#if defined(PELLUCID_HAS_REFERENCE)
constexpr bool has_reference = true;
#else
constexpr bool has_reference = false;
#endif

/// Options that are read as text and looked at afterwards.
struct Texts {
    std::string size, background, environment, transparency = "auto";
    std::string layers, memory_budget, min_transmittance;
    std::vector<std::string> aovs;
    double error_budget = 0;
};

template <class E>
void add_choice(CLI::App& app, const char* flag, E& value, std::map<std::string, E> names, const char* help) {
    app.add_option(flag, value, help)->transform(CLI::CheckedTransformer(std::move(names)))->option_text("NAME");
}

void add_picture_options(CLI::App& app, Options& o, Texts& t) {
    app.add_option("--size", t.size, "WIDTHxHEIGHT of the picture (1280x720)");
    app.add_option("--camera", o.camera, "index or name of a camera of the scene");
    add_choice<GBufferLayout>(app, "--gbuffer", o.settings.gbuffer,
                              {{"compact", GBufferLayout::compact}, {"classic", GBufferLayout::classic}},
                              "compact (16 bytes a pixel) or classic (36)");
    add_choice<LightAssignment>(app, "--lighting", o.settings.lighting,
                                {{"auto", LightAssignment::automatic},
                                 {"loop", LightAssignment::loop},
                                 {"volumes", LightAssignment::volumes},
                                 {"tiled", LightAssignment::tiled},
                                 {"clustered", LightAssignment::clustered}},
                                "how lights find pixels: auto (by their number), loop (all at each), volumes (drawn), "
                                "tiled or clustered (lists)");
    add_choice<Shadows>(app, "--shadows", o.settings.shadows, {{"none", Shadows::none}, {"map", Shadows::map}},
                        "none, or map (shadow maps; with --reference, and of what --compare reference draws: exact "
                        "hard shadows)");
    app.add_option("--shadow-size", o.settings.shadow_size, "texels a side of each shadow map (1024)")
        ->option_text("N");
    add_choice<ShadingStage>(app, "--shading", o.settings.shading,
                             {{"compute", ShadingStage::compute}, {"fragment", ShadingStage::fragment}},
                             "where lighting runs: compute or fragment");
    add_choice<Brdf>(app, "--brdf", o.settings.brdf,
                     {{"gltf", Brdf::gltf},
                      {"seed", Brdf::seed},
                      {"blinn-phong", Brdf::blinn_phong},
                      {"conserving", Brdf::conserving}},
                     "gltf, conserving (no energy is lost or made), seed or blinn-phong");
    app.add_option("--environment", t.environment,
                   "none: no light but the scene's own; sky: procedural; FILE.hdr: equirectangular, y up. Seen behind "
                   "everything, unless --background is given")
        ->option_text("none|sky|FILE.hdr");
    app.add_flag("!--no-default-light", o.settings.default_light, "no sun and ambient for a scene without lights");
    app.add_option("--background", t.background, "R,G,B linear");
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
}

/// Options that some methods of transparency heed and others do not.
struct Heeded {
    const char* flag;
    bool TransparencyTraits::*by;
};
constexpr Heeded heeded[] = {{"--layers", &TransparencyTraits::layers},
                             {"--memory-budget", &TransparencyTraits::memory_budget},
                             {"--min-transmittance", &TransparencyTraits::min_transmittance},
                             {"--seed-composite", &TransparencyTraits::seed_composite},
                             {"--skyx-alpha-gain", &TransparencyTraits::skyx_alpha_gain},
                             {"--audit", &TransparencyTraits::audit}};

/// The methods with this trait, or all, in a row of words.
std::string methods(const char* joint, bool TransparencyTraits::*trait = nullptr) {
    std::vector<std::string> names;
    for (const TransparencyTraits& m : all_transparencies)
        if (trait == nullptr || m.*trait) names.push_back(m.name);
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 < names.size() ? ", " : std::string(" ") + joint + " ") + names[i];
    return text;
}

void add_transparency_options(CLI::App& app, Options& o, Texts& t) {
    std::vector<std::string> names{"auto"};
    for (const TransparencyTraits& m : all_transparencies) names.push_back(m.name);
    app.add_option("--transparency", t.transparency,
                   std::string("auto, which is ") + name(o.settings.transparency) + ": exact for every scene; or " +
                       methods("or"))
        ->check(CLI::IsMember(names));
    using T = TransparencyTraits;
    app.add_option("--layers", t.layers,
                   "at most so many layers of " + methods("and", &T::layers) +
                       " (all there are; peel-seed: 6; each of dual-peel is one from the front "
                       "and one from the back)")
        ->option_text("N");
    app.add_option("--memory-budget", t.memory_budget,
                   "for the fragments that " + methods("and", &T::memory_budget) +
                       " store: a number of bytes, or one with K, M or G (what the device can bind)")
        ->option_text("BYTES");
    app.add_option("--min-transmittance", t.min_transmittance,
                   "in [0,1): " + methods("and", &T::min_transmittance) +
                       " end a pixel where no more than this share of the light gets through (0)")
        ->option_text("T");
    app.add_flag("--seed-composite", o.settings.seed_composite,
                 methods("and", &T::seed_composite) + ": composite with the factors that its document has by mistake");
    app.add_flag("--skyx-alpha-gain", o.settings.skyx_alpha_gain,
                 methods("and", &T::skyx_alpha_gain) +
                     ": the picture's alpha (which an .exr file has) grows by 1.1 a layer, as it once did");
    app.add_flag("--audit", o.settings.audit,
                 "compare the fragments that " + methods("and", &T::audit) +
                     " composite with those that are counted (exit 1 where they differ)");
}

void add_output_options(CLI::App& app, Options& o, Texts& t) {
    app.add_flag("--reference", o.reference,
                 "draw with the double-precision reference renderer, on the CPU, instead of on a device");
    app.add_option("--out", o.out, "picture: .png (display), .exr or .pfm (linear, before the tone map)");
    app.add_option("--aov", t.aovs, "NAME=FILE: depth, normal, base_color, roughness, metallic, occlusion or emissive")
        ->allow_extra_args(false);
    app.add_option("--stats", o.stats, "FILE.json: what ran and what it took");
    app.add_option("--frames", o.frames, "frames to draw, for the timings (1)")->check(CLI::Range(1u, 1000000u));
    app.add_option("--compare", o.compare,
                   "FILE.pfm (linear) or .png (display) to compare with; or the word reference: what the reference "
                   "renderer draws, in its stable pixels, the others apart");
    app.add_option("--mask", o.mask, "FILE.pgm: compare only where it is 255, the rest apart");
    app.add_option("--heatmap", o.heatmap, "FILE.png: where the differences are");
    app.add_option("--error-budget", t.error_budget, "largest RMSE that --compare may find (exit 6)")
        ->check(CLI::NonNegativeNumber);
}

/// Reads the texts.  What is wrong, or nothing.
std::string read_texts(const CLI::App& app, const Texts& t, Options& o) {
    std::string wrong;
    const auto read = [&](const std::string& text, auto&& parse, auto& value) {
        if (wrong.empty() && !text.empty()) wrong = parse(text, value);
    };
    read(t.size, parse_size, o.settings.size);
    read(t.background, parse_color, o.settings.background);
    const auto read_named = [&](const char* flag, const std::string& text, auto&& parse, auto& value) {
        if (!wrong.empty() || app[flag]->count() == 0) return;
        wrong = parse(text, value);
        if (!wrong.empty()) wrong = std::string(flag) + ": " + wrong;
    };
    read_named("--layers", t.layers, parse_layers, o.settings.max_layers);
    read_named("--memory-budget", t.memory_budget, parse_bytes, o.settings.memory_budget);
    read_named("--min-transmittance", t.min_transmittance, parse_transmittance, o.settings.min_transmittance);
    if (!wrong.empty()) return wrong;
    o.chose_transparency = t.transparency != "auto";
    for (const TransparencyTraits& m : all_transparencies)
        if (t.transparency == m.name) o.settings.transparency = m.method;
    wrong = samples::parse_environment(t.environment, o.settings, o.environment);
    if (!wrong.empty()) return wrong;
    o.settings.environment.backdrop = t.background.empty();
    if (app["--error-budget"]->count() > 0) o.error_budget = t.error_budget;
    for (const std::string& aov : t.aovs) {
        const std::size_t at = aov.find('=');
        if (at == std::string::npos || at + 1 == aov.size()) return "--aov takes NAME=FILE, not '" + aov + "'";
        o.aovs.emplace_back(aov.substr(0, at), aov.substr(at + 1));
    }
    o.settings.keep_gbuffer = !o.aovs.empty();
    return {};
}

/// Options that this method of transparency does not heed.
std::string check_method(const CLI::App& app, const Options& o) {
    const TransparencyTraits& method = traits(o.settings.transparency);
    for (const Heeded& option : heeded)
        if (app[option.flag]->count() > 0 && !(method.*option.by))
            return std::string(option.flag) + " goes with --transparency " + methods("or", option.by) +
                   ", and means nothing to " + method.name + (o.chose_transparency ? "" : " (auto)");
    if (o.settings.audit && o.settings.min_transmittance > 0)
        return "--audit composites every fragment, so --min-transmittance ends no pixel: leave out one of them";
    return {};
}

/// Options that cannot go with the reference renderer.
std::string check_reference(const CLI::App& app, const Options& o) {
    if (!o.reference && !o.against_reference()) return {};
    const std::string asked = o.reference ? "--reference" : "--compare reference";
    if (!has_reference)
        return asked + " needs the reference renderer, and this program was built without it (PELLUCID_REFERENCE=OFF)";
    if (!o.reference) return {};
    if (o.against_reference())
        return "--reference draws nothing on a device that --compare reference could judge: leave out one of them, or "
               "write ./reference for a file of that name";
    if (o.chose_transparency && o.settings.transparency != Transparency::none)
        return std::string(
                   "--reference composites every fragment, exactly, on the CPU: of --transparency it takes auto and "
                   "none, not ") +
               name(o.settings.transparency);
    std::vector<const char*> of_devices{"--backend",  "--device",         "--gbuffer",  "--lighting",
                                        "--shading",  "--exact",          "--validate", "--aov",
                                        "--gl-spirv", "--pipeline-cache", "--frames",   "--shadow-size"};
    for (const Heeded& option : heeded) of_devices.push_back(option.flag);
    for (const char* flag : of_devices)
        if (app[flag]->count() > 0)
            return std::string(flag) + " is about drawing on a device, and --reference draws on the CPU: leave it out";
    return {};
}

}  // namespace

std::pair<Options, std::optional<int>> parse_options(int argc, char** argv) {
    Options o;
    o.settings.size = {1280, 720};
    Texts t;
    CLI::App app{"Draws a glTF 2.0 scene, deferred-lit, with transparency.", "pellucid-render"};
    app.add_option("SCENE", o.scene, "glTF 2.0 file, .gltf or .glb");
    app.add_option("--backend", o.backend, "auto, vulkan or opengl")
        ->check(CLI::IsMember({"auto", "vulkan", "opengl"}));
    app.add_option("--device", o.device, "index or part of the name; see --list-devices");
    app.add_flag("--list-devices", o.list_devices, "list the devices of every backend and what each lacks");
    add_picture_options(app, o, t);
    add_transparency_options(app, o, t);
    add_output_options(app, o, t);
    app.add_flag("--validate", o.validate, "validation layer and GL debug output; any message fails the run");
    app.add_flag("--gl-spirv", o.gl_spirv, "OpenGL: load SPIR-V instead of GLSL text");
    app.add_option("--pipeline-cache", o.pipeline_cache, "FILE to keep compiled pipelines in");
    app.set_version_flag("--version", std::string("pellucid-render ") + PELLUCID_VERSION_STRING);

    const auto usage = [&](const std::string& what) { return samples::fail(app.get_name(), what, Exit::usage); };
    if (const auto status = samples::parse_command_line(app, argc, argv)) return {o, *status};
    if (const std::string wrong = read_texts(app, t, o); !wrong.empty()) return {o, usage(wrong)};
    if (o.scene.empty() && !o.list_devices) return {o, usage("no scene is named (--help lists the options)")};
    if (const std::string wrong = check_reference(app, o); !wrong.empty()) return {o, usage(wrong)};
    if (const std::string wrong = check_method(app, o); !wrong.empty()) return {o, usage(wrong)};
    if (o.gl_spirv && o.backend == "vulkan") return {o, usage("--gl-spirv goes with --backend opengl")};
    if (app["--shadow-size"]->count() > 0 && o.settings.shadows == Shadows::none)
        return {o, usage("--shadow-size goes with --shadows map")};
    if ((!o.heatmap.empty() || o.error_budget || !o.mask.empty()) && o.compare.empty())
        return {o, usage("--heatmap, --mask and --error-budget go with --compare")};
    return {o, std::nullopt};
}
