// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// glTF 2.0 files (.gltf, .glb) → `Scene`, for files that nobody has checked.
///
/// Every value is checked against the format's rules before it is used: types, ranges, references, byte ranges of
/// accessors (also sparse ones), node hierarchy, non-finite numbers.  Tables that address memory (buffers, views,
/// accessors, meshes, images) are read by our own code from the checked JSON; tinygltf parses the descriptive ones
/// (materials, textures, nodes, cameras, lights) and sees nothing that has not passed the checks.
///
/// Read: triangle lists, strips and fans; metallic-roughness materials; COLOR_0, TEXCOORD_0, TEXCOORD_1; cameras; node
/// hierarchy (transforms multiplied in double); KHR_lights_punctual, KHR_materials_unlit, KHR_texture_transform,
/// KHR_materials_emissive_strength, KHR_mesh_quantization.  Passed over with a warning: points and lines, animations,
/// skins and morph targets (the rest pose is shown), extensions that are used but not required.
/// Instances follow the scene's roots depth first in file order, primitives in file order within a node: draw order.
/// Negative and non-uniform scales stay in the instance's matrix.
#include <pellucid/core/config.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/scene/image_file.hpp>
#include <pellucid/scene/scene.hpp>
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1 {

/// What a file may ask for.  A file beyond a limit is refused before the memory is taken.
struct GltfLimits {
    std::uint64_t max_file_bytes = std::uint64_t{2} << 30u;    ///< [B] of all files read, the document included
    std::uint64_t max_json_bytes = std::uint64_t{128} << 20u;  ///< [B] of JSON, embedded base64 data included
    std::uint32_t max_json_depth = 64;                         ///< arrays and objects inside each other
    std::uint64_t max_scene_bytes = std::uint64_t{4} << 30u;   ///< [B] of what is made from them, pictures apart
    /// The same may not be larger than this many times the bytes it comes from, plus 16 MiB: primitives that share an
    /// accessor each get their own copy of what they use of it, and an empty object of three bytes still is a material.
    std::uint32_t max_growth = 128;
    std::uint64_t max_all_image_bytes = std::uint64_t{4} << 30u;  ///< [B] of all pictures decoded
    std::uint32_t max_node_depth = 1024;
    ImageLimits image = {};  ///< for each picture
};

/// Reads a .gltf or .glb file (told apart by its first bytes) and the files it names, which are looked up beside it;
/// addresses with a scheme (http:, file:) or an absolute path are refused.
/// Errors: Errc::io where a file cannot be read, Errc::parse where its content is not valid or beyond a limit,
/// Errc::out_of_memory; the message is "<file>: <JSON pointer>: what, the value, the limit".
Result<Scene> load_gltf(const std::string& path, const GltfLimits& limits = {});

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/gltf-inl.hpp>
#endif
