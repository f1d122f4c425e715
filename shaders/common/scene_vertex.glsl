// SPDX-License-Identifier: MIT
// The vertex stage of every pass that draws the scene: one text, so that depth is equal bit for bit between passes.
#include "common/scene.glsl"

invariant gl_Position;
precise gl_Position;
layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_tangent;
layout(location = 2) out vec4 out_uv;
layout(location = 3) out vec4 out_color;
layout(location = 4) flat out uvec4 out_draw;
layout(location = 5) flat out vec4 out_base_color;
layout(location = 6) flat out vec4 out_factors;
layout(location = 7) flat out vec4 out_emissive;

void main() {
    DrawRecord draw = records[RECORD_INDEX];
    Vertex v = vertices[VERTEX_INDEX];
    gl_Position = clip_position(view_position(draw, v.position));

    // Some drivers do not drop what the next stage ignores, so what no stage needs is not computed.
    out_normal = vec3(0.0, 0.0, 1.0);
    if (needs(PELLUCID_NEED_NORMALS)) {
        precise vec3 n = draw.normal_x * v.normal.x;
        n = n + draw.normal_y * v.normal.y;
        n = n + draw.normal_z * v.normal.z;
        out_normal = n * inversesqrt(max(dot3_always(n, n), 1e-30));
    }
    out_tangent = vec4(0.0);
    if (needs(PELLUCID_NEED_NORMAL_MAPS)) {
        precise vec3 t = draw.axis_x * v.tangent.x;
        t = t + draw.axis_y * v.tangent.y;
        t = t + draw.axis_z * v.tangent.z;
        t = t * inversesqrt(max(dot3_always(t, t), 1e-30));
        // A mirrored instance turns the handedness of its tangent frames.
        float w = (draw.flags & PELLUCID_DRAW_MIRRORED) != 0u ? -v.tangent.w : v.tangent.w;
        out_tangent = vec4(t, w);
    }
    out_uv = needs(PELLUCID_NEED_TEXTURES) ? vec4(v.u0, v.v0, v.uv1) : vec4(0.0);
    out_color = needs(PELLUCID_NEED_VERTEX_COLORS) ? unpack_color(v.color) : vec4(1.0);
    // Once a vertex instead of once a fragment; what a fragment stage does not read is not loaded.
    out_draw = uvec4(draw.material, draw.flags | materials[draw.material].flags << 16u, draw.first_primitive, draw.instance);
    out_base_color = materials[draw.material].base_color;
    out_factors = needs(PELLUCID_NEED_NORMALS | PELLUCID_NEED_ALPHA_MASK | PELLUCID_NEED_OCCLUSION)
                      ? vec4(materials[draw.material].metallic, materials[draw.material].roughness,
                             materials[draw.material].alpha_cutoff, materials[draw.material].occlusion_strength)
                      : vec4(0.0);
    out_emissive = needs(PELLUCID_NEED_EMISSIVE | PELLUCID_NEED_NORMAL_MAPS)
                       ? vec4(materials[draw.material].emissive, materials[draw.material].normal_scale)
                       : vec4(0.0);
}
