// SPDX-License-Identifier: MIT
// A surface from a global primitive id and a pixel alone, in any stage: what compute rasterisers and visibility buffers
// stand on.  Vertices are pulled, attributes interpolated perspective-correctly by 2D homogeneous edge functions (Olano
// and Greer 1997), and texture derivatives are those of the pixel's 2×2 quad, as dFdxFine and dFdyFine take them.
#ifndef PELLUCID_PRIMITIVE_GLSL
#define PELLUCID_PRIMITIVE_GLSL
#include "common/surface.glsl"

// Index of the record whose draw holds `primitive`; records [first, first + frame.draw_count) ascend in first_primitive.
uint record_of_primitive(uint first, uint primitive) {
    uint low = 0u;
    uint high = frame.draw_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (records[first + middle].first_primitive <= primitive)
            low = middle;
        else
            high = middle;
    }
    return first + low;
}

struct Triangle {
    vec3 a;  // clip x, y, w of its corners
    vec3 b;
    vec3 c;
};

// Perspective-correct barycentric coordinates of a pixel centre; they may lie outside the triangle (quad neighbours).
// `facing` gets a positive value where the corners run counter-clockwise on screen.
vec3 barycentrics(Triangle t, vec2 fragcoord, out float facing) {
    vec2 ndc = vec2(fragcoord.x * frame.pixel.x - 1.0, 1.0 - fragcoord.y * frame.pixel.y);
    precise vec2 a = t.a.xy - ndc * t.a.z;
    precise vec2 b = t.b.xy - ndc * t.b.z;
    precise vec2 c = t.c.xy - ndc * t.c.z;
    precise vec3 e = vec3(b.x * c.y - b.y * c.x, c.x * a.y - c.y * a.x, a.x * b.y - a.y * b.x);
    facing = e.x + e.y + e.z;
    return e * (1.0 / facing);
}

// The attributes of `primitive` at `pixel`; `material` gets its index.
Attributes rebuild_attributes(uint first_record, uint primitive, ivec2 pixel, out uint material) {
    DrawRecord draw = records[record_of_primitive(first_record, primitive)];
    material = draw.material;
    uint at = draw.first_index + 3u * (primitive - draw.first_primitive);
    Vertex v0 = vertices[draw.first_vertex + indices[at]];
    Vertex v1 = vertices[draw.first_vertex + indices[at + 1u]];
    Vertex v2 = vertices[draw.first_vertex + indices[at + 2u]];
    Triangle t = Triangle(clip_position(view_position(draw, v0.position)).xyw,
                          clip_position(view_position(draw, v1.position)).xyw,
                          clip_position(view_position(draw, v2.position)).xyw);
    float facing;
    float ignored;
    vec3 w = barycentrics(t, vec2(pixel) + 0.5, facing);
    Attributes a;
    mat3 normal_from_object = mat3(draw.normal_x, draw.normal_y, draw.normal_z);
    a.normal = normalize(normal_from_object * v0.normal) * w.x + normalize(normal_from_object * v1.normal) * w.y +
               normalize(normal_from_object * v2.normal) * w.z;
    mat3 axes = mat3(draw.axis_x, draw.axis_y, draw.axis_z);
    bool mirrored = (draw.flags & PELLUCID_DRAW_MIRRORED) != 0u;
    a.tangent = vec4(0.0);
    if (needs(PELLUCID_NEED_NORMAL_MAPS)) {
        a.tangent.xyz = normalize(axes * v0.tangent.xyz) * w.x + normalize(axes * v1.tangent.xyz) * w.y +
                        normalize(axes * v2.tangent.xyz) * w.z;
        a.tangent.w = mirrored ? -v0.tangent.w : v0.tangent.w;
    }
    a.color = vec4(1.0);
    if ((draw.flags & PELLUCID_DRAW_COLORS) != 0u)
        a.color = unpack_color(v0.color) * w.x + unpack_color(v1.color) * w.y + unpack_color(v2.color) * w.z;
    vec4 uv0 = vec4(v0.u0, v0.v0, v0.uv1);
    vec4 uv1 = vec4(v1.u0, v1.v0, v1.uv1);
    vec4 uv2 = vec4(v2.u0, v2.v0, v2.uv1);
    a.uv = uv0 * w.x + uv1 * w.y + uv2 * w.z;
    vec3 wx = barycentrics(t, vec2(pixel.x ^ 1, pixel.y) + 0.5, ignored);
    vec3 wy = barycentrics(t, vec2(pixel.x, pixel.y ^ 1) + 0.5, ignored);
    a.uv_dx = (uv0 * wx.x + uv1 * wx.y + uv2 * wx.z - a.uv) * ((pixel.x & 1) == 0 ? 1.0 : -1.0);
    a.uv_dy = (uv0 * wy.x + uv1 * wy.y + uv2 * wy.z - a.uv) * ((pixel.y & 1) == 0 ? 1.0 : -1.0);
    a.front = (facing > 0.0) != mirrored;
    return a;
}
#endif
