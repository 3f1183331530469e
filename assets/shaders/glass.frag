#version 450 core
// Glass over the surface buffer. It tints the colour behind it and, at grazing angles, whitens it
// with the reflected room. Shading follows later and assumes the room is about as bright as the
// surface behind. In depth and label, glass is opaque.

in vec3 offset_in_world;
in vec3 normal_in_world;
in vec2 texture_uv;
flat in vec4 surface_color;
flat in vec4 surface_traits;
flat in uint surface_id;

layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 4) uniform int textured;
layout(location = 5) uniform float tint;  // 0: write depth and label only (also for the holes of
                                          // cut-outs)
layout(location = 6) uniform vec4 cut_plane;
layout(location = 7) uniform vec3 eye;
layout(location = 8) uniform float keep_below_z;
layout(location = 9) uniform float ceiling_z;
layout(location = 15) uniform vec3 clip_low;  // only what lies inside this box is drawn
layout(location = 16) uniform vec3 clip_high;

layout(binding = 0) uniform sampler2D base_texture;

layout(location = 0) out vec4 out_color;
layout(location = 3) out float out_depth;
layout(location = 4) out uint out_id;

const float kRoom = 0.75;  // square root of a room's albedo

// Reflectance of both faces of a thin sheet, with Schlick's Fresnel approximation.
float sheetReflectance() {
    float facing = abs(dot(normalize(normal_in_world), normalize(offset_in_world)));
    float face = 0.04 + 0.96 * pow(1.0 - facing, 5.0);
    return 2.0 * face / (1.0 + face);
}

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
    vec3 p = offset_in_world + eye;
    bool above_cut = dot(p, cut_plane.xyz) > cut_plane.w && p.z > keep_below_z;
    if (surface_traits.w > 0.5 && (above_cut || p.z > ceiling_z)) discard;
    if (any(lessThan(p, clip_low)) || any(greaterThan(p, clip_high))) discard;
    vec4 color = surface_color;
    if (textured != 0) color *= texture(base_texture, texture_uv);
    float reflected = sqrt(sheetReflectance());  // exact over black, slightly too strong over white
    float tinted = (1.0 - reflected) * color.a;
    float share = reflected + tinted;
    out_color = vec4((reflected * vec3(kRoom) + tinted * color.rgb) / share, share * tint);
    out_depth = marked;
    out_id = surface_id;
}
