#version 450 core
// Positions only, computed by the same expressions as in surface.vert so that they are identical.

layout(location = 0) in vec3 position;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;  // near plane, m; depth range of an orthographic
                                               // view, m, else 0

void main() {
    vec3 p = camera_from_world * (position - camera_position);
    gl_Position = depth_span.y > 0.0
                      ? vec4(lens.xy * p.xy + lens.zw, 1.0 - (p.z - depth_span.x) / depth_span.y, 1.0)
                      : vec4(lens.xy * p.xy + lens.zw * p.z, depth_span.x, p.z);
}
