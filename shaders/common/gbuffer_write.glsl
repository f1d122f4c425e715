// SPDX-License-Identifier: MIT
// A surface into the G-buffer, whichever layout it has.  The entry file sets GBUFFER_LOCATION, the first target's, and
// GBUFFER_CLASSIC.
#include "common/gbuffer.glsl"
#include "common/geometry_in.glsl"

#if defined(GBUFFER_CLASSIC)
layout(location = GBUFFER_LOCATION) out vec4 out_position;
layout(location = GBUFFER_LOCATION + 1) out vec4 out_normal;
layout(location = GBUFFER_LOCATION + 2) out vec4 out_base;
layout(location = GBUFFER_LOCATION + 3) out vec4 out_material;
layout(location = GBUFFER_LOCATION + 4) out vec4 out_emissive;
#else
layout(location = GBUFFER_LOCATION) out uint out_normal;
layout(location = GBUFFER_LOCATION + 1) out vec4 out_base;
layout(location = GBUFFER_LOCATION + 2) out uint out_material;
layout(location = GBUFFER_LOCATION + 3) out vec4 out_emissive;
#endif

void write_gbuffer(Surface s) {
#if defined(GBUFFER_CLASSIC)
    EXACT vec3 world = world_from_view(view_from_depth(gl_FragCoord.xy, gl_FragCoord.z)) + frame.camera_position;
    out_position = vec4(world, 1.0);
    out_normal = vec4(s.normal, 0.0);
    out_base = vec4(s.base, 1.0);
    out_material = vec4(s.metallic, s.roughness, s.occlusion, float(surface_flags(s)) * (1.0 / 255.0));
#else
    out_normal = octahedral_encode(s.normal);
    out_base = vec4(s.base, s.occlusion);
    out_material = pack_material(s.roughness, s.metallic, surface_flags(s));
#endif
    out_emissive = vec4(min(s.emissive, vec3(65504.0)), 1.0);
}
