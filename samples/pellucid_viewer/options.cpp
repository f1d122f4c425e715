// SPDX-License-Identifier: MIT
#include "options.hpp"
#include "../pellucid_render/option_values.hpp"
#include "../support/command_line.hpp"
#include "../support/environment_file.hpp"
#include <pellucid/core/version.hpp>
#include <vector>

namespace pellucid::samples::viewer {
namespace {

std::vector<std::string> method_names(const char* first) {
    std::vector<std::string> names{first};
    for (const TransparencyTraits& t : all_transparencies) names.push_back(t.name);
    return names;
}
/// The enumerator whose name this is.  Precondition: there is one.
template <class E, std::size_t N>
E by_name(const char* const (&names)[N], const std::string& text) {
    std::size_t at = 0;
    while (at + 1 < N && text != names[at]) ++at;
    return static_cast<E>(at);
}
void set_method(const std::string& text, Transparency& method) {
    for (const TransparencyTraits& t : all_transparencies)
        if (text == t.name) method = t.method;
}

struct Texts {
    std::string size, transparency = "auto", against, view = view_names[0], environment, tab = tab_names[0];
};

void add_options(CLI::App& app, Options& o, Texts& t) {
    app.add_option("SCENE", o.scene, "glTF 2.0 file, .gltf or .glb; the demo scene where there is none");
    app.add_option("--backend", o.backend, "auto, vulkan or opengl")
        ->check(CLI::IsMember({"auto", "vulkan", "opengl"}));
    app.add_option("--device", o.device, "index or part of the name");
    app.add_option("--size", t.size, "WIDTHxHEIGHT of the window, panel and all (1280x720)");
    app.add_option("--transparency", t.transparency, "the left picture's method; auto is abuffer")
        ->check(CLI::IsMember(method_names("auto")));
    app.add_option("--against", t.against, "what is right of the split: a method, or the reference")
        ->check(CLI::IsMember(method_names("reference")));
    app.add_option("--split", o.choices.split, "share of the picture that is left of the split, 0 to 1 (0.5)")
        ->check(CLI::Range(0.0f, 1.0f));
    app.add_option("--view", t.view,
                   "picture; or a heat map of layers (translucent fragments), error (of radiance, against the right "
                   "picture or an exact method's), overdraw (fragments rasterised, opaque and hidden ones too)")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(view_names), std::end(view_names))));
    app.add_option("--environment", t.environment, "none, sky, or FILE.hdr (equirectangular, y up)")
        ->option_text("none|sky|FILE.hdr");
    app.add_flag("--headless", o.headless, "no window: draw a few frames and end");
    app.add_option("--frames", o.frames, "end after so many frames (without a window: 4)")
        ->check(CLI::Range(1u, 1000000u));
    app.add_flag("--measure", o.measure, "measure time and error of every method before the last frame");
    app.add_option(
        "--screenshot", o.screenshot,
        "FILE of the last frame: .png is the canvas, panel and all; .exr linear radiance of the left picture");
    app.add_flag("--hide-ui", o.choices.hide_ui, "no panel: the picture fills the canvas (F1 shows it)");
    app.add_option("--tab", t.tab, "of the panel: settings, time or error")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(tab_names), std::end(tab_names))));
    app.add_option("--pipeline-cache", o.pipeline_cache, "FILE to keep compiled pipelines in");
    app.add_flag("!--no-vsync", o.vsync, "show frames at once, not at the display's pace");
    app.add_flag("--validate", o.validate, "validation layer and GL debug output; any message fails the run");
    app.set_version_flag("--version", std::string("pellucid-viewer ") + PELLUCID_VERSION_STRING);
}

/// Reads the texts.  What is wrong, or nothing.
std::string read_texts(const Texts& t, Options& o) {
    if (!t.size.empty())
        if (std::string wrong = parse_size(t.size, o.size); !wrong.empty()) return wrong;
    set_method(t.transparency, o.choices.render.transparency);
    if (t.against == "reference") o.choices.against = Against::reference;
    if (!t.against.empty() && t.against != "reference") {
        o.choices.against = Against::method;
        set_method(t.against, o.choices.other);
    }
    o.choices.view = by_name<View>(view_names, t.view);
    o.choices.tab = by_name<Tab>(tab_names, t.tab);
    if (o.headless && o.frames == 0) o.frames = 4;
    if (o.headless) o.choices.reference_divisor = 1;  // nobody waits for a window
    if (o.headless && (o.size.width == 0 || o.size.height == 0))
        return "--size is " + std::to_string(o.size.width) + "x" + std::to_string(o.size.height) +
               ": without a window each side must be at least 1";
    if (!o.screenshot.empty() && !o.screenshot.ends_with(".png") && !o.screenshot.ends_with(".exr"))
        return "--screenshot writes .png or .exr, not '" + o.screenshot + "'";
    if (!o.screenshot.empty() && o.frames == 0)
        return "--screenshot is of the last frame: give --frames, or --headless";
    return parse_environment(t.environment, o.choices.render, o.environment);
}

}  // namespace

std::pair<Options, std::optional<int>> parse_options(int argc, char** argv) {
    Options o;
    Texts t;
    CLI::App app{"Shows a glTF 2.0 scene, and what each method of transparency costs and how wrong it is.",
                 "pellucid-viewer"};
    add_options(app, o, t);
    const auto usage = [&](const std::string& what) { return fail(app.get_name(), what, Exit::usage); };
    if (const auto status = parse_command_line(app, argc, argv)) return {o, *status};
    if (const std::string wrong = read_texts(t, o); !wrong.empty()) return {o, usage(wrong)};
    return {o, std::nullopt};
}

}  // namespace pellucid::samples::viewer
