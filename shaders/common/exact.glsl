// SPDX-License-Identifier: MIT
// Arithmetic that may be asked to give the same bits on every API.  Drivers expand composite built-ins (dot, normalize,
// mix, sqrt, division) in their own order; the exact build spells them out and forbids contraction, the default build
// leaves them to the driver.
#ifndef PELLUCID_EXACT_GLSL
#define PELLUCID_EXACT_GLSL

#if defined(PELLUCID_EXACT)
float dot3(vec3 a, vec3 b) {
    precise float s = a.x * b.x;
    s = s + a.y * b.y;
    s = s + a.z * b.z;
    return s;
}
vec3 unit(vec3 v) {
    precise vec3 u = v * inversesqrt(dot3(v, v));
    return u;
}
vec3 cross3(vec3 a, vec3 b) {
    precise vec3 p = vec3(a.y * b.z, a.z * b.x, a.x * b.y);
    precise vec3 q = vec3(a.z * b.y, a.x * b.z, a.y * b.x);
    precise vec3 c = p - q;
    return c;
}
float root(float x) {
    precise float y = max(x, 1e-30);
    precise float r = y * inversesqrt(y);
    return r;
}
float quotient(float a, float b) {
    precise float r = 1.0 / b;
    precise float q = a * r;
    return q;
}
vec3 blend3(vec3 a, vec3 b, float t) {
    precise vec3 d = b - a;
    precise vec3 r = d * t;
    r = a + r;
    return r;
}
#else
float dot3(vec3 a, vec3 b) { return dot(a, b); }
vec3 unit(vec3 v) { return normalize(v); }
vec3 cross3(vec3 a, vec3 b) { return cross(a, b); }
float root(float x) { return sqrt(x); }
float quotient(float a, float b) { return a / b; }
vec3 blend3(vec3 a, vec3 b, float t) { return mix(a, b, t); }
#endif

// dot3 with the same bits in both builds: for positions, depths and sort keys.
float dot3_always(vec3 a, vec3 b) {
    precise float s = a.x * b.x;
    s = s + a.y * b.y;
    s = s + a.z * b.z;
    return s;
}
#endif
