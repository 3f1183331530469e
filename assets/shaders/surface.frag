#version 450 core
// Fills the surface buffer: everything later passes need to know of the point a pixel's centre
// sees. Lighting comes after, once a pixel.

in vec3 offset_in_world;
in vec3 normal_in_world;
in vec2 texture_uv;
flat in vec4 surface_color;
flat in vec4 surface_traits;
flat in uint surface_id;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 4) uniform int textured;
layout(location = 5) uniform float alpha_cut;  // texels below are holes; 0: none
layout(location = 6) uniform vec4 cut_plane;   // structure above it is left away, see view.h
layout(location = 7) uniform vec3 eye;
layout(location = 8) uniform float keep_below_z;
layout(location = 9) uniform float ceiling_z;

layout(binding = 0) uniform sampler2D base_texture;

layout(location = 0) out vec4 out_color;     // square root of linear; a: metallic or emission
layout(location = 1) out vec4 out_normal;    // on the side that is seen; w: roughness
layout(location = 2) out float out_surface;  // planar depth of the lit surface, m
layout(location = 3) out float out_depth;    // planar depth of the label, m
layout(location = 4) out uint out_id;

float depthHere() {
    return depth_span.y > 0.0 ? depth_span.x + (1.0 - gl_FragCoord.z) * depth_span.y
                              : 1.0 / gl_FragCoord.w;
}

// The normal on the side that is seen, whichever way the file winds the face. That of a smoothed
// face is turned by the face: near the outline it may look a little past the side by itself, and
// there it is laid along the outline, for a surface that is seen does not face away.
vec3 seenNormal(vec3 face, vec3 along) {
    if (dot(face, along) > 0.0) face = -face;
    vec3 n = normalize(normal_in_world);
    if (dot(n, face) < 0.0) n = -n;
    return normalize(n - max(dot(n, along), 0.0) * along);
}

void main() {
    // Before anything is left away: neighbours that end early have no place to compare with.
    vec3 face = cross(dFdx(offset_in_world), dFdy(offset_in_world));
    vec3 p = offset_in_world + eye;
    bool above_cut = dot(p, cut_plane.xyz) > cut_plane.w && p.z > keep_below_z;
    if (surface_traits.w > 0.5 && (above_cut || p.z > ceiling_z)) discard;
    vec4 color = surface_color;
    if (textured != 0) {
        vec4 texel = texture(base_texture, texture_uv);
        if (texel.a < alpha_cut) discard;
        // Texels are sRGB, close enough to a square; the vertex colour is a square root already.
        color.rgb *= texel.rgb;
        color.a *= texel.a;
    }
    vec3 forward = vec3(camera_from_world[0].z, camera_from_world[1].z, camera_from_world[2].z);
    vec3 n = seenNormal(face, depth_span.y > 0.0 ? forward : normalize(offset_in_world));
    float special = surface_traits.z > 0.0 ? 0.5 + 0.5 * surface_traits.z
                                           : 0.49 * surface_traits.y;
    out_color = vec4(color.rgb, special);
    out_normal = vec4(n, surface_traits.x);
    float z = depthHere();
    out_surface = z;
    out_depth = z;
    out_id = surface_id;
}
