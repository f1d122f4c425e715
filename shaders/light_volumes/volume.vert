#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A light's sphere or cone.  Corners that triangles share are computed alike, so the volume is closed.
#include "common/scene.glsl"
#include "pellucid/gpu/light_volumes.h"

PASS_BUFFER_READ(PELLUCID_VOLUMES_MESH, MeshBuffer) { vec4 corners[]; };
PUSH_BLOCK(Push) { LightVolumePush volume; };
invariant gl_Position;
precise gl_Position;

void main() {
    LightRecord light = lights[volume.light];
    vec3 corner = corners[volume.first_corner + uint(VERTEX_INDEX)].xyz;
    precise vec3 e = light.position + corner * volume.reach;
    if (volume.first_corner != 0u) {
        precise vec3 z = -light.to_light;
        precise vec3 x = cross3(abs(z.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), z);
        x = unit(x);
        precise vec3 y = cross3(z, x);
        e = light.position + z * (corner.z * volume.reach);
        e = e + x * (corner.x * volume.width);
        e = e + y * (corner.y * volume.width);
    }
    gl_Position = clip_position(e);
}
