#version 450 core
// Shadow map of the sun: depth, and for glass panes the transmitted share of light.

in vec3 offset_in_world;
in vec2 texture_uv;
flat in vec4 surface_color;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 4) uniform int textured;
layout(location = 5) uniform float alpha_cut;  // texels below are holes; 0: none
layout(location = 6) uniform vec3 eye;
layout(location = 7) uniform vec3 shades_low;  // surfaces outside this box cast no shadow
layout(location = 8) uniform vec3 shades_high;
layout(location = 9) uniform int glass;

layout(binding = 0) uniform sampler2D base_texture;

layout(location = 0) out float out_let_through;

void main() {
    vec3 face = cross(dFdx(offset_in_world), dFdy(offset_in_world));
    vec3 p = offset_in_world + eye;
    if (any(lessThan(p, shades_low)) || any(greaterThan(p, shades_high))) discard;
    float alpha = textured != 0 ? texture(base_texture, texture_uv).a : 1.0;
    if (alpha < alpha_cut) discard;
    out_let_through = 1.0;
    if (glass != 0) {
        // As sheetReflectance() in traced_surface.cpp.
        vec3 forward =
            vec3(camera_from_world[0].z, camera_from_world[1].z, camera_from_world[2].z);
        float away = clamp(1.0 - abs(dot(normalize(face), forward)), 0.0, 1.0);
        float away2 = away * away;
        float thrown = 0.04 + 0.96 * away2 * away2 * away;
        out_let_through = (1.0 - 2.0 * thrown / (1.0 + thrown)) * (1.0 - surface_color.a * alpha);
    }
}
