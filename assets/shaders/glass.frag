#version 450 core
// Glass over what is already in the surface buffer: it tints the colour behind it, while depth and
// label become its own, for the labels treat everything as opaque.

in vec3 offset_in_world;
in vec2 texture_uv;
flat in vec4 surface_color;
flat in vec4 surface_traits;
flat in uint surface_id;

layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 4) uniform int textured;
layout(location = 5) uniform float tint;  // 0: only depth and label (the holes of cut-outs)
layout(location = 6) uniform vec4 cut_plane;
layout(location = 7) uniform vec3 eye;
layout(location = 8) uniform float keep_below_z;
layout(location = 9) uniform float ceiling_z;

layout(binding = 0) uniform sampler2D base_texture;

layout(location = 0) out vec4 out_color;
layout(location = 3) out float out_depth;
layout(location = 4) out uint out_id;

float depthHere() {
    return depth_span.y > 0.0 ? depth_span.x + (1.0 - gl_FragCoord.z) * depth_span.y
                              : 1.0 / gl_FragCoord.w;
}

void main() {
    vec3 p = offset_in_world + eye;
    bool above_cut = dot(p, cut_plane.xyz) > cut_plane.w && p.z > keep_below_z;
    if (surface_traits.w > 0.5 && (above_cut || p.z > ceiling_z)) discard;
    vec4 color = surface_color;
    if (textured != 0) color *= texture(base_texture, texture_uv);
    out_color = vec4(color.rgb, color.a * tint);
    out_depth = depthHere();
    out_id = surface_id;
}
