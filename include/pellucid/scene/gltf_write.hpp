// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Scene` → .glb, for scenes that programs make.
#include <pellucid/core/config.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/scene/scene.hpp>
#include <string>

namespace pellucid::inline v0_1 {

/// Writes one self-contained binary glTF 2.0 file: a mesh each `Mesh`, a node each instance, camera and light, in this
/// order; pictures as PNG inside.  `load_gltf` of it gives the same scene, bit by bit, as long as the scene keeps its
/// own rules: every mesh is used or not, but has triangles; tangents only where the material has a normal map; unit
/// normals; rigid views; every texture and image used by a material.  A directional or spot light's position and
/// direction become a node's frame.
/// Errors: Errc::invalid_argument where an index or a size of the scene is wrong or a material is premultiplied,
/// Errc::io.
Result<void> write_gltf(const std::string& path, const Scene& scene);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/gltf_write-inl.hpp>
#endif
