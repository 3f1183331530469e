#version 450 core
// The same positions as surface.vert, computed by the same expressions, and nothing else.

layout(location = 0) in vec3 position;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform float near_m;

void main() {
    vec3 p = camera_from_world * (position - camera_position);
    gl_Position = vec4(lens.xy * p.xy + lens.zw * p.z, near_m, p.z);
}
