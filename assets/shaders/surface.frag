#version 450 core
// Fills the surface buffer (G-buffer) with the surface at each pixel's centre. Shading follows in a
// later pass, once per pixel.

in vec3 offset_in_world;
in vec3 normal_in_world;
in vec2 texture_uv;
flat in vec4 surface_color;
flat in vec4 surface_traits;
flat in uint surface_id;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 6) uniform vec4 cut_plane;   // structure above it is cut, see view.h
layout(location = 7) uniform vec3 eye;
layout(location = 8) uniform float keep_below_z;
layout(location = 9) uniform float ceiling_z;
layout(location = 15) uniform vec3 clip_low;  // only what lies inside this box is drawn
layout(location = 16) uniform vec3 clip_high;

layout(location = 13) uniform vec2 emission_share;  // factors of emission: lamps; objects that show
                                                    // the outside
layout(location = 14) uniform float outside_dark;  // square root of the dimming of the outside

layout(binding = 0) uniform sampler2D base_texture;

#ifdef MAPS
layout(location = 10) uniform ivec4 has_map;  // normal, roughness, metallic, emission
layout(location = 11) uniform float normal_scale;
layout(location = 12) uniform vec3 emission_factor;

layout(binding = 9) uniform sampler2D normal_map;
layout(binding = 10) uniform sampler2D roughness_map;  // green
layout(binding = 11) uniform sampler2D metallic_map;   // blue
layout(binding = 12) uniform sampler2D emission_map;

// Emission below this is not drawn. Equal to kFaintestEmission in surface_kind.h.
const float kFaintest = 0.0625;
#endif

layout(location = 0) out vec4 out_color;     // rgb: square root of linear colour; a: metallic or
                                             // emission
layout(location = 1) out vec4 out_normal;    // xyz: on the visible side; w: roughness, negative
                                             // where a map turned the normal
layout(location = 2) out float out_surface;  // planar depth of the shaded surface, m
layout(location = 3) out float out_depth;    // planar depth of the labelled surface, m
layout(location = 4) out uint out_id;

// Weaker emission is less than one step of the 8-bit buffer.
const float kLeastShine = 0.03;

// Linear value of an sRGB colour: a cubic fit, within 0.7 of 255 steps.
vec3 decode(vec3 srgb) {
    return srgb * (0.059573 + srgb * (0.361492 + srgb * (0.900017 - 0.321082 * srgb)));
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

#ifdef MAPS
vec3 to_u;  // tangents along u and v
vec3 to_v;

void findFrame() {
    vec3 right = dFdx(offset_in_world);
    vec3 down = dFdy(offset_in_world);
    vec2 uv_right = dFdx(texture_uv) * vec2(1.0, -1.0);  // v grows upwards
    vec2 uv_down = dFdy(texture_uv) * vec2(1.0, -1.0);
    float turn = sign(uv_right.x * uv_down.y - uv_right.y * uv_down.x);
    to_u = (right * uv_down.y - down * uv_right.y) * turn;
    to_v = (down * uv_right.x - right * uv_down.x) * turn;
}

// Applies the normal map to the smoothed normal, in the local frame of u and v.
vec3 mappedNormal(vec3 n) {
    vec3 along_u = to_u - dot(to_u, n) * n;
    vec3 said = 2.0 * texture(normal_map, texture_uv).xyz - 1.0;
    if (!(dot(along_u, along_u) > 0.0)) return n;
    along_u = normalize(along_u);
    vec3 across = cross(n, along_u);
    if (dot(across, to_v) < 0.0) across = -across;
    return normalize(normal_scale * (said.x * along_u + said.y * across) +
                     max(said.z, 0.01) * n);
}
#endif

// The normal on the visible side, whatever the winding order. A smoothed normal is flipped together
// with its face. Near an outline it may still point away from the viewer; then it is projected onto
// the outline, because a visible surface does not face away.
vec3 seenNormal(vec3 face, vec3 along) {
    if (dot(face, along) > 0.0) face = -face;
    vec3 n = normalize(normal_in_world);
    float side = dot(n, face) < 0.0 ? -1.0 : 1.0;
#ifdef MAPS
    if (has_map.x != 0) n = mappedNormal(n);
#endif
    n *= side;
    return normalize(n - max(dot(n, along), 0.0) * along);
}

void main() {
    float z = depthHere();
    float marked = markedDepth(z);
    // Derivatives come before any discard: discarded neighbours have none.
    vec3 face = cross(dFdx(offset_in_world), dFdy(offset_in_world));
#ifdef MAPS
    findFrame();
#endif
#ifdef CUT
    vec3 p = offset_in_world + eye;
    bool above_cut = dot(p, cut_plane.xyz) > cut_plane.w && p.z > keep_below_z;
    if (surface_traits.w > 0.5 && (above_cut || p.z > ceiling_z)) discard;
    if (any(lessThan(p, clip_low)) || any(greaterThan(p, clip_high))) discard;
#endif
    vec3 color = surface_color.rgb;
#ifdef TEXTURED
    vec4 texel = texture(base_texture, texture_uv);
#ifdef HOLES
    if (texel.a < 0.5) discard;
#endif
    color *= sqrt(decode(texel.rgb));
#endif
    vec3 forward = vec3(camera_from_world[0].z, camera_from_world[1].z, camera_from_world[2].z);
    vec3 n = seenNormal(face, depth_span.y > 0.0 ? forward : normalize(offset_in_world));
    bool outside = abs(abs(surface_traits.w - 0.5) - 0.25) < 0.1;
    float share = outside ? emission_share.y : emission_share.x;
    float metallic = surface_traits.y;
#ifdef MAPS
    if (has_map.z != 0) metallic *= texture(metallic_map, texture_uv).b;
#endif
    float shine = 8.0 * surface_traits.z * share;
    float special = shine > kLeastShine ? 0.5 + min(shine, 8.0) / 16.0 : 0.49 * metallic;
    // Surfaces that emit daylight turn dark without it.
    if (outside && surface_traits.z > 0.0) color *= outside_dark;
    float roughness = surface_traits.x;
#ifdef MAPS
    if (has_map.y != 0) roughness *= texture(roughness_map, texture_uv).g;
    // Ambient occlusion uses the unmapped normal, see occlusion.frag.
    if (has_map.x != 0) roughness = -max(roughness, 0.001);
    if (has_map.w != 0) {
        if (outside) share *= outside_dark * outside_dark;
        vec3 shining = texture(emission_map, texture_uv).rgb;
        vec3 emission = min(emission_factor * decode(shining) * share, 8.0);
        float strongest = max(emission.r, max(emission.g, emission.b));
        if (outside && strongest > 0.0) color *= outside_dark;
        if (strongest >= kFaintest) {
            color = sqrt(emission / strongest);
            special = 0.5 + strongest / 16.0;
        }
    }
#endif
    out_color = vec4(color, special);
    out_normal = vec4(n, roughness);
    out_surface = z;
    out_depth = marked;
    out_id = surface_id;
}
