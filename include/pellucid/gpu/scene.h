// SPDX-License-Identifier: MIT
// The scene as every stage of every pass sees it (vertex pulling: any stage, compute too, can evaluate any surface).
// Everything is in view space: an instance's view_from_object and every light are put there in double on the CPU, so no
// shader subtracts or rotates large coordinates.
#ifndef PELLUCID_GPU_SCENE_H
#define PELLUCID_GPU_SCENE_H
#include "pellucid/gpu/types.h"

#define PELLUCID_MATERIAL_DOUBLE_SIDED 1u
#define PELLUCID_MATERIAL_UNLIT 2u
#define PELLUCID_MATERIAL_MASK 4u            // discard where alpha < cutoff
#define PELLUCID_MATERIAL_BLEND 8u           // alpha is kept; it is 1 everywhere else
#define PELLUCID_MATERIAL_PREMULTIPLIED 16u  // radiance is not multiplied by alpha

#define PELLUCID_DRAW_MIRRORED 1u  // the instance's matrix has a negative determinant: facing is inverted
#define PELLUCID_DRAW_COLORS 2u    // the mesh has vertex colours; an interpolated 1 need not be 1, so none are not read

// Specialisation constant 0: what the scene needs (renderer/needs.hpp).  A branch for anything else is not compiled.
#define PELLUCID_NEED_TEXTURES 1u
#define PELLUCID_NEED_NORMAL_MAPS 2u
#define PELLUCID_NEED_VERTEX_COLORS 4u
#define PELLUCID_NEED_SECOND_UV 8u
#define PELLUCID_NEED_EMISSIVE 16u  // emissive or unlit surfaces: radiance that no light makes
#define PELLUCID_NEED_ALPHA_MASK 32u
#define PELLUCID_NEED_DIRECTIONAL 64u
#define PELLUCID_NEED_POINTS 128u
#define PELLUCID_NEED_SPOTS 256u
#define PELLUCID_NEED_UNLIT 512u
#define PELLUCID_NEED_AMBIENT 1024u
#define PELLUCID_NEED_OCCLUSION 2048u
#define PELLUCID_NEED_NORMALS 4096u          // a light falls on a lit surface, or the G-buffer is kept to be read
#define PELLUCID_NEED_LIGHT_RANGES 2097152u  // a light ends somewhere
#define PELLUCID_NEED_ALL (8191u | PELLUCID_NEED_LIGHT_RANGES)
// Beside them, how lights find pixels (passes/light_lists.hpp); neither: every light is tried at every pixel.
#define PELLUCID_NEED_LIGHT_TILES 8192u
#define PELLUCID_NEED_LIGHT_CLUSTERS 16384u
#define PELLUCID_NEED_LIGHT_VOLUMES \
    32768u  // opaque surfaces: lights with a range are added by passes/light_volumes.hpp
#define PELLUCID_NEED_LIGHT_BLOCK 1048576u  // no lists, and all lights are in the uniform block
// What a setting asks for.
#define PELLUCID_NEED_SKY 65536u           // the procedural sky shines
#define PELLUCID_NEED_ENVIRONMENT 131072u  // a picture of an environment shines
#define PELLUCID_NEED_BACKDROP 262144u     // and is seen where nothing else is
#define PELLUCID_NEED_SHADOWS 524288u      // a light has a shadow map (gpu/shadow_map.h)

// Specialisation constant 1: the reflectance model.
#define PELLUCID_BRDF_GLTF 0u
#define PELLUCID_BRDF_SEED 1u
#define PELLUCID_BRDF_BLINN_PHONG 2u
#define PELLUCID_BRDF_CONSERVING 3u

#define PELLUCID_TEXTURE_ARRAYS 8  // arrays that the whole scene's textures are gathered in
#define PELLUCID_NO_PRIMITIVE 0xFFFFFFFFu

PELLUCID_GPU_BEGIN

// Group 0, binding PELLUCID_BIND_FRAME.
/// What is the same for all of a view: projection, lights, exposure.  Uniform block of group 0.
struct FrameParams {
    vec4 world_x;  // columns of world_from_view (its rotation); w unused
    vec4 world_y;
    vec4 world_z;
    vec4 clip_scale;        // sx, sy, ox, oy of ClipFromView
    vec4 clip_depth;        // zz, zw, wz, ww of ClipFromView
    vec4 view_scale;        // 1/sx, 1/sy; z, w unused
    vec4 pixel;             // 2/width, 2/height, width, height
    vec3 ambient;           // [cd/m²] constant radiance from everywhere
    float exposure;         // factor before the tone map
    vec3 background;        // linear radiance where nothing is
    float environment_lod;  // last level of the prefiltered environment
    vec3 camera_position;   // [m] world, rounded to float: only the classic G-buffer needs it
    uint draw_count;
    // One past the last directional light, the last point or spot light that reaches everywhere, and the last one of
    // all (they are stored in this order); w: first word of the slices' lists.
    uvec4 light_ends;
    uvec4 light_grid;   // tiles in a row, lists a tile, words a list, words of a list that summarise the others
    vec4 light_slices;  // slice = log2(distance along the view) x + y, in 0 … z
};
PELLUCID_GPU_SIZE(FrameParams, 208)
PELLUCID_GPU_OFFSET(FrameParams, ambient, 112)
PELLUCID_GPU_OFFSET(FrameParams, light_ends, 160)

// Group 0, binding PELLUCID_BIND_RECORDS: one an instance, in draw order; the base instance is its index.
/// Where an instance is, and what it is made of.  One an instance, in group 0.
struct DrawRecord {
    vec3 axis_x;  // columns of view_from_object
    uint first_vertex;
    vec3 axis_y;
    uint first_index;
    vec3 axis_z;
    uint first_primitive;  // global primitive id of the draw's triangle 0; grows with the record's index
    vec3 origin;
    uint material;
    vec3 normal_x;  // columns of the inverse transpose of view_from_object's 3×3 part, scaled
    uint flags;     // PELLUCID_DRAW_*
    vec3 normal_y;
    uint triangle_count;
    vec3 normal_z;
    uint instance;  // its place in the draw order
    uvec4 reserved;
};
PELLUCID_GPU_SIZE(DrawRecord, 128)
PELLUCID_GPU_OFFSET(DrawRecord, origin, 48)
PELLUCID_GPU_OFFSET(DrawRecord, normal_z, 96)

// Scene group, PELLUCID_BIND_VERTICES.
/// A vertex as it is pulled from the storage buffer of the scene.
struct Vertex {
    vec3 position;  // [m] object space
    float u0;
    vec3 normal;  // unit
    float v0;
    vec4 tangent;  // xyz unit, w = ±1
    vec2 uv1;
    uvec2 color;  // linear straight RGBA, 4 × unorm16, red in the low bits of x
};
PELLUCID_GPU_SIZE(Vertex, 64)
PELLUCID_GPU_OFFSET(Vertex, tangent, 32)
PELLUCID_GPU_OFFSET(Vertex, color, 56)

/// Which layer of which array a material samples, and how.
struct TextureUse {
    vec4 matrix;  // u' = x u + y v + offset.x, v' = z u + w v + offset.y (KHR_texture_transform)
    vec2 offset;
    uint place;  // 0: no texture; else bits 0…7 array + 1, 8…23 layer, 24 texture-coordinate set
    uint reserved;
};
PELLUCID_GPU_SIZE(TextureUse, 32)

// Scene group, PELLUCID_BIND_MATERIALS.
/// A material in the table of the scene.
struct MaterialRecord {
    vec4 base_color;
    vec3 emissive;
    float alpha_cutoff;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    uint flags;  // PELLUCID_MATERIAL_*
    uint reserved0;
    uint reserved1;
    uint reserved2;
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    TextureUse occlusion_texture;
    TextureUse emissive_texture;
};
PELLUCID_GPU_SIZE(MaterialRecord, 224)
PELLUCID_GPU_OFFSET(MaterialRecord, base_color_texture, 64)

// Scene group, PELLUCID_BIND_LIGHTS: in the order of FrameParams::light_ends.  Where PELLUCID_LIGHT_BLOCK or fewer are
// looped over they are read from the uniform block, PELLUCID_BIND_LIGHT_BLOCK, which GPUs read faster.
#define PELLUCID_LIGHT_BLOCK 64
/// A light in view space.
struct LightRecord {
    vec3 position;                // [m] view; unused for directional lights
    float inverse_range_squared;  // [1/m²] 0: unlimited
    vec3 to_light;                // view, unit, against the way the light travels: directional and spot
    float spot_scale;             // 1 / (cos inner - cos outer); 0: a point light
    vec3 intensity;               // colour times [lx] or [cd]
    float spot_edge;              // 1 - cos outer
};
PELLUCID_GPU_SIZE(LightRecord, 48)

PELLUCID_GPU_END
#endif
