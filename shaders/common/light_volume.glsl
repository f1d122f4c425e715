// SPDX-License-Identifier: MIT
// What one light adds to a pixel of the G-buffer.
#include "common/gbuffer_read.glsl"
#include "common/lighting.glsl"
#include "pellucid/gpu/light_volumes.h"

PUSH_BLOCK(Push) { LightVolumePush volume; };
layout(location = 0) out vec4 out_light;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    Pixel p = decode_gbuffer(at, fetch_gbuffer(at));
    out_light = vec4(0.0);
    if (!p.covered || (needs(PELLUCID_NEED_UNLIT) && p.surface.unlit)) return;
    Surface s = p.surface;
    Shading shading = make_shading(s.base, s.metallic, s.roughness, s.normal, direction_to_eye(p.position));
    LightSum sum = no_light();
    add_light_at(sum, volume.light, shading, s.base, s.metallic, p.position, p.plane);
    out_light = vec4(reflected(sum, shading), 0.0);
}
