// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What is drawn and how: the methods, and the scenes by name or by file.
#include <cstdlib>
#include <filesystem>
#include <pellucid/renderer/needs.hpp>
#include <pellucid/renderer/settings.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <string>
#include <vector>

namespace pellucid::bench {

/// Where a method's picture must be within its documented bound, or nothing is timed.
enum class Exact : std::uint8_t { nowhere, unlit_scenes, everywhere };

struct Method {
    Transparency value = Transparency::sorted;
    Exact exact = Exact::nowhere;
    const char* remark = "";
};
/// The first one is what all others are a multiple of.
inline constexpr Method methods[] = {{Transparency::sorted, Exact::nowhere, "whole objects, back to front"},
                                     {Transparency::peel, Exact::everywhere, "exact"},
                                     {Transparency::peel_seed, Exact::nowhere, "six layers of 8 bits"},
                                     {Transparency::dual_peel, Exact::nowhere, "exact but for equal depths"},
                                     {Transparency::interleaved_skyx, Exact::nowhere, "one surface a pixel"},
                                     {Transparency::interleaved, Exact::unlit_scenes, "exact but for light"},
                                     {Transparency::abuffer, Exact::everywhere, "exact"}};

struct Case {
    std::string name, title;
    Scene scene;
    Camera camera;
    glm::vec3 background = RenderSettings{}.background;
    bool default_light = true;
    std::string file;      ///< that it was read from; empty: made by the program
    bool peers = false;    ///< unlit and of one colour a face: other programs draw the same
    bool lit = false;      ///< light falls on any surface
    bool sampled = false;  ///< any surface has a texture: filters differ between devices

    [[nodiscard]] RenderSettings settings(Extent2D size, Transparency method) const {
        return {.size = size, .transparency = method, .background = background, .default_light = default_light};
    }
    [[nodiscard]] bool exact(const Method& method) const {
        return method.exact == Exact::everywhere || (method.exact == Exact::unlit_scenes && !lit);
    }
};

namespace detail {

struct NamedScene {
    const char* name;
    const char* title;
    Scene (*make)();
};
inline const NamedScene made_scenes[] = {{"demo", "demo scene", [] { return make_demo_scene(); }},
                                         {"teapots", "110 teapots", [] { return make_teapot_grid(); }},
                                         {"peeling", "peeling scene", [] { return make_peeling_scene(); }},
                                         {"chain", "linked chain", [] { return make_linked_chain(); }},
                                         {"planes", "intersecting planes", [] { return make_intersecting_planes(); }},
                                         {"quads", "random quads", [] { return make_random_quads(); }},
                                         {"glass", "lit glass", [] { return make_lit_glass(); }}};

/// Files of scenes that have an independent reference, and the settings that it was made with: no environment.
struct KnownFile {
    const char* name;
    const char* stem;
    const char* title;
    glm::vec3 background;
    bool peers;
};
inline constexpr KnownFile known_files[] = {
    {"S1", "S1_random_quads", "S1 random quads", {0.10196078f, 0.12156863f, 0.16078431f}, true},
    {"S2", "S2_intersecting_planes", "S2 intersecting planes", {0.2f, 0.2f, 0.21960784f}, true},
    {"S3", "S3_linked_chain", "S3 linked chain", {0.25098039f, 0.25882353f, 0.29803922f}, true},
    {"L1", "L1_lit", "L1 lit", {0.03921569f, 0.03921569f, 0.05098039f}, false}};

/// " S1 S2 …".
[[nodiscard]] inline std::string scene_names() {
    std::string out;
    for (const KnownFile& known : known_files) out += std::string(" ") + known.name;
    for (const NamedScene& made : made_scenes) out += std::string(" ") + made.name;
    return out;
}

}  // namespace detail

/// The folder that the running program lies in.
[[nodiscard]] inline std::filesystem::path program_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path(".") : program.parent_path();
}

/// Where a file of the project lies: in the folder that an environment variable names, or else beside the program, or
/// in a folder of the source tree or of one of the two folders above it.  Empty where there is none.
[[nodiscard]] inline std::string find_file(const char* variable, const std::string& in_sources,
                                           const std::string& file) {
    namespace fs = std::filesystem;
    std::vector<fs::path> folders;
    if (const char* given = variable ? std::getenv(variable) : nullptr; given && *given) {
        folders.push_back(given);
    } else {
        const fs::path sources = PELLUCID_BENCH_SOURCES;
        folders = {program_folder(), program_folder() / "scenes", sources / in_sources,
                   sources.parent_path() / in_sources, sources.parent_path().parent_path() / in_sources};
    }
    for (const fs::path& folder : folders) {
        std::error_code error;
        if (fs::is_regular_file(folder / file, error)) return (folder / file).string();
    }
    return {};
}

/// The scene of that name (S1, S2, S3, L1, or one that the program makes), or of that glTF file, which is seen by its
/// own first camera, or by one that frames it on pictures of `size`.
/// Errors: io where the file of a known name is not there; invalid_argument for another name; those of `load_gltf`.
[[nodiscard]] inline Result<Case> load_case(const std::string& name, Extent2D size) {
    Case out{.name = name};
    for (const detail::NamedScene& made : detail::made_scenes)
        if (name == made.name) out.scene = made.make(), out.title = made.title;
    if (out.scene.instances.empty()) {
        for (const detail::KnownFile& known : detail::known_files) {
            const bool by_name = name == known.name;
            if (!by_name && std::filesystem::path(name).stem() != known.stem) continue;
            out.name = known.name;
            out.title = known.title;
            out.background = known.background;
            out.default_light = false;
            out.peers = known.peers;
            out.file =
                by_name ? find_file("PELLUCID_SCENES", "shared/scenes", std::string(known.stem) + ".gltf") : name;
            if (out.file.empty())
                return Error{Errc::io, "the scene " + name + " is left out: " + known.stem +
                                           ".gltf is neither in the folder that PELLUCID_SCENES names nor beside the "
                                           "program"};
        }
        if (out.file.empty()) {
            out.file = name;
            out.name = out.title = std::filesystem::path(name).stem().string();
            if (!std::filesystem::exists(name))
                return Error{Errc::invalid_argument,
                             "--scene '" + name + "' is neither a file nor one of" + detail::scene_names()};
        }
        PELLUCID_TRY(out.scene, load_gltf(out.file));
    }
    out.camera = out.scene.cameras.empty() ? frame_scene(out.scene, size) : out.scene.cameras.front();
    for (const Instance& instance : out.scene.instances) {
        const Material& m = out.scene.materials[out.scene.meshes[instance.mesh].material];
        out.lit = out.lit || (!m.unlit && (out.default_light || !out.scene.lights.empty()));
    }
    out.sampled = !out.scene.textures.empty();
    return out;
}

}  // namespace pellucid::bench
