#version 450 core
// Depth and label only; every surface is opaque.

in vec3 offset_in_world;
flat in vec4 surface_traits;
flat in uint surface_id;

layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 6) uniform vec4 cut_plane;   // see surface.frag
layout(location = 7) uniform vec3 eye;
layout(location = 8) uniform float keep_below_z;
layout(location = 9) uniform float ceiling_z;
layout(location = 15) uniform vec3 clip_low;  // only what lies inside this box is drawn
layout(location = 16) uniform vec3 clip_high;

layout(location = 3) out float out_depth;
layout(location = 4) out uint out_id;

float depthHere() {
    return depth_span.y > 0.0 ? depth_span.x + (1.0 - gl_FragCoord.z) * depth_span.y
                              : 1.0 / gl_FragCoord.w;
}

// Steeper surfaces, m per pixel, are marked. Rasterisation is exact to a hundredth of a pixel,
// which on gentler surfaces is less than half a millimetre of depth.
const float kSteep = 0.05;

// Negative where the surface is so steep that its rasterised depth is unreliable; see
// readDrawnDepth().
float markedDepth(float z) {
    if (depth_span.y > 0.0) return z;
    float slope = fwidth(gl_FragCoord.w) * z * z;
    return slope < kSteep && z > 0.0 ? z : -abs(z);
}

void main() {
    float marked = markedDepth(depthHere());
#ifdef CUT
    vec3 p = offset_in_world + eye;
    bool above_cut = dot(p, cut_plane.xyz) > cut_plane.w && p.z > keep_below_z;
    if (surface_traits.w > 0.5 && (above_cut || p.z > ceiling_z)) discard;
    if (any(lessThan(p, clip_low)) || any(greaterThan(p, clip_high))) discard;
#endif
    out_depth = marked;
    out_id = surface_id;
}
