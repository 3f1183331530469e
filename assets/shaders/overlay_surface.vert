#version 450 core
// A vertex of an overlay's block or triangle.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 rgba;
layout(location = 2) in vec2 cell;  // integers on the edges of blocks

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;  // see surface.vert
layout(location = 8) uniform vec3 clip_low;  // only what lies inside this box is drawn
layout(location = 9) uniform vec3 clip_high;

flat out vec4 color;
out vec2 on_face;
out float gl_ClipDistance[6];

void main() {
    vec3 p = camera_from_world * (position - camera_position);
    gl_Position = depth_span.y > 0.0
                      ? vec4(lens.xy * p.xy + lens.zw, 1.0 - (p.z - depth_span.x) / depth_span.y, 1.0)
                      : vec4(lens.xy * p.xy + lens.zw * p.z, depth_span.x, p.z);
    for (int i = 0; i < 3; ++i) {
        gl_ClipDistance[i] = position[i] - clip_low[i];
        gl_ClipDistance[i + 3] = clip_high[i] - position[i];
    }
    color = rgba;
    on_face = cell;
}
