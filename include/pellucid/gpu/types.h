// SPDX-License-Identifier: MIT
// Makes a struct file of gpu/ valid both as C++20 and as GLSL 4.50, with one layout (std140 = std430 = C++).
// Rules: a vec3 starts at a multiple of 16 and is followed by a scalar; no arrays of scalars; sizes are multiples
// of 16.
#ifndef PELLUCID_GPU_TYPES_H
#define PELLUCID_GPU_TYPES_H
#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <type_traits>
namespace pellucid::inline v0_1::gpu {
using uint = std::uint32_t;
struct alignas(8) vec2 {
    float x = 0, y = 0;
};
struct vec3 {
    float x = 0, y = 0, z = 0;
};  // 12 bytes: a scalar packs behind it, as in GLSL
struct alignas(16) vec4 {
    float x = 0, y = 0, z = 0, w = 0;
};
struct alignas(8) uvec2 {
    uint x = 0, y = 0;
};
struct alignas(16) uvec4 {
    uint x = 0, y = 0, z = 0, w = 0;
};
}  // namespace pellucid::inline v0_1::gpu
#define PELLUCID_GPU_BEGIN namespace pellucid::inline v0_1::gpu {
#define PELLUCID_GPU_END }
#define PELLUCID_GPU_DEFAULT(value) = value
#define PELLUCID_GPU_SIZE(type, bytes)                                                                   \
    static_assert(sizeof(type) == (bytes) && (bytes) % 16 == 0, #type " has another size than in GLSL"); \
    static_assert(std::is_standard_layout_v<type> && std::is_trivially_copyable_v<type>);
#define PELLUCID_GPU_OFFSET(type, member, bytes) \
    static_assert(offsetof(type, member) == (bytes), #type "::" #member " is elsewhere than in GLSL");
#else
#define PELLUCID_GPU_BEGIN
#define PELLUCID_GPU_END
#define PELLUCID_GPU_DEFAULT(value)
#define PELLUCID_GPU_SIZE(type, bytes)
#define PELLUCID_GPU_OFFSET(type, member, bytes)
#endif
#endif
