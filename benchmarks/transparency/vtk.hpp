// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A peer: VTK's dual depth peeling and plain blending of the same scene, in a process of its own, where it is
/// installed (Debian: python3-vtk9, xvfb).
#include <cstdlib>
#include <pellucid/scene/image_file.hpp>
#include "support/conversation.hpp"
#include "transparency/results.hpp"

namespace pellucid::bench {

namespace detail {

/// A word of a shell command, whatever is in it.
[[nodiscard]] inline std::string shell_word(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// What follows `"key": ` in one line of JSON that the script prints; empty where there is no such key.
[[nodiscard]] inline std::string after_key(const std::string& json, const std::string& key) {
    const std::size_t at = json.find("\"" + key + "\": ");
    return at == std::string::npos ? std::string() : json.substr(at + key.size() + 4);
}

}  // namespace detail

/// VTK with one scene and one method, ready to draw frames in turn with us.
class VtkScene final : public Peer {
public:
    /// `method`: "dual-peel" or "plain".  Errors: io where the script fails; internal where VTK does not peel.
    [[nodiscard]] static Result<std::unique_ptr<VtkScene>> open(const std::string& command, const Case& c,
                                                                const Truth& truth, const std::string& method) {
        std::unique_ptr<VtkScene> out(new VtkScene);
        char options[200];
        std::snprintf(options, sizeof options, " --size %ux%u --background %.8f,%.8f,%.8f --serve 2>/dev/null",
                      truth.radiance.width, truth.radiance.height, static_cast<double>(c.background.x),
                      static_cast<double>(c.background.y), static_cast<double>(c.background.z));
        PELLUCID_TRY(out->script_, Conversation::start("exec " + command + " " + detail::shell_word(c.file) +
                                                       " --method " + method + options));
        PELLUCID_TRY(const std::string about, out->script_.ask("", '{'));
        const std::string program = detail::after_key(about, "program");
        out->row = {.kind = RowKind::peer,
                    .method = program.substr(1, program.find('"', 1) - 1) + " " + method,
                    .remark = method == "dual-peel" ? "colours of 8 bits" : "in the order of the file"};
        out->exact = method == "dual-peel";
        if (out->exact && !detail::after_key(about, "peeled").starts_with("true"))
            return Error{Errc::internal, "VTK did not peel: its driver lacks something"};

        const std::filesystem::path file =
            std::filesystem::temp_directory_path() / ("pellucid-vtk-" + std::to_string(getpid()) + ".pfm");
        PELLUCID_TRY(const std::string written, out->script_.ask("picture " + file.string(), '{'));
        Result<ImageF> drawn = read_pfm(file.string());
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
        if (!drawn) return drawn.error();
        PELLUCID_TRY(out->row.quality, judge(*drawn, truth.radiance, truth.stable));
        return out;
    }

    Result<double> frame() override {
        PELLUCID_TRY(const std::string answer, script_.ask("frame", '{'));
        const double milliseconds = std::strtod(detail::after_key(answer, "ms").c_str(), nullptr);
        if (!(milliseconds > 0)) return Error{Errc::parse, "VTK's script gave no time but: " + answer};
        return milliseconds;
    }

private:
    Conversation script_;
};

/// The command that runs VTK's script, up to the scene's name.
/// Errors: a sentence about what is missing on this machine.
[[nodiscard]] inline Result<std::string> find_vtk() {
    const std::string script = find_file(nullptr, "benchmarks/transparency", "vtk_depth_peeling.py");
    if (script.empty()) return Error{Errc::io, "VTK is not measured: vtk_depth_peeling.py is not beside the program"};
    const auto works = [](const std::string& command) {
        return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
    };
    if (!works("command -v xvfb-run"))
        return Error{Errc::io, "VTK is not measured: there is no xvfb-run (Debian: xvfb)"};
    for (const std::string python : {"python3", "/usr/bin/python3"})
        if (works(python + " -c 'import numpy, vtkmodules'"))
            return "xvfb-run -a " + python + " " + detail::shell_word(script);
    return Error{Errc::io, "VTK is not measured: no python3 here has the module vtkmodules (Debian: python3-vtk9)"};
}

}  // namespace pellucid::bench
