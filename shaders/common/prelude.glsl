// SPDX-License-Identifier: MIT
// What differs between Vulkan GLSL, OpenGL GLSL text and OpenGL SPIR-V, in one place: bindings, push data, vertex and
// instance index, specialisation constants, and the arithmetic switch of the exact build.  No other shader file asks
// which API it is built for.
#ifndef PELLUCID_PRELUDE_GLSL
#define PELLUCID_PRELUDE_GLSL
#include "pellucid/gpu/bindings.h"

#if defined(PELLUCID_VULKAN)
#define PELLUCID_SET(s, b) set = s, binding = b
#define PUSH_BLOCK(name) layout(push_constant, std430) uniform name
#define VERTEX_INDEX gl_VertexIndex
#define RECORD_INDEX gl_InstanceIndex
#define SPEC_CONSTANT(id, name, value) layout(constant_id = id) const uint name = value
#else
#define PELLUCID_SET(s, b) binding = b
#define PUSH_BLOCK(name) layout(std140, binding = PELLUCID_BIND_PUSH) uniform name
#define VERTEX_INDEX gl_VertexID
#extension GL_ARB_shader_draw_parameters : require
#define RECORD_INDEX (gl_BaseInstanceARB + gl_InstanceID)
#if defined(PELLUCID_GL_SPIRV)
#define SPEC_CONSTANT(id, name, value) layout(constant_id = id) const uint name = value
#else
// The loader writes `#define PELLUCID_SPEC_<id> <value>u` behind #version for every constant of the pipeline.
#define SPEC_CONSTANT(id, name, value) const uint name = PELLUCID_SPEC_##id
#endif
#endif

#define FRAME_BLOCK(name) layout(PELLUCID_SET(0, PELLUCID_BIND_FRAME), std140) uniform name
#define RECORD_BUFFER(name) layout(PELLUCID_SET(0, PELLUCID_BIND_RECORDS), std430) readonly buffer name
#define PASS_UNIFORMS(b, name) layout(PELLUCID_SET(1, b), std140) uniform name
#define PASS_BUFFER_READ(b, name) layout(PELLUCID_SET(1, b), std430) readonly buffer name
#define PASS_BUFFER(b, name) layout(PELLUCID_SET(1, b), std430) buffer name
#define PASS_TEXTURE(b) layout(PELLUCID_SET(1, b)) uniform
#define PASS_IMAGE(b, format) layout(PELLUCID_SET(1, b), format) uniform
#define SCENE_UNIFORMS(b, name) layout(PELLUCID_SET(2, b), std140) uniform name
#define SCENE_BUFFER_READ(b, name) layout(PELLUCID_SET(2, b), std430) readonly buffer name
#define SCENE_TEXTURE(b) layout(PELLUCID_SET(2, b)) uniform

// The exact build: every local that feeds a stored value is `EXACT`, so that both APIs give the same bits.
#if defined(PELLUCID_EXACT)
#define EXACT precise
#else
#define EXACT
#endif
#endif
