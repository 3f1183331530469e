#version 450 core
// An axis-aligned box as twelve triangles, without vertex buffers; for the uniforms see
// surface.vert.

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;
layout(location = 4) uniform vec3 low;
layout(location = 5) uniform vec3 high;

// Corner numbers; bits 0, 1, 2 select high x, y, z. Two triangles per side.
const int kCorners[36] = int[36](0, 2, 4, 4, 2, 6, 1, 3, 5, 5, 3, 7, 0, 1, 4, 4, 1, 5,
                                 2, 3, 6, 6, 3, 7, 0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7);

void main() {
    int corner = kCorners[gl_VertexID];
    vec3 position = mix(low, high, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    vec3 p = camera_from_world * (position - camera_position);
    gl_Position = depth_span.y > 0.0
                      ? vec4(lens.xy * p.xy + lens.zw, 1.0 - (p.z - depth_span.x) / depth_span.y, 1.0)
                      : vec4(lens.xy * p.xy + lens.zw * p.z, depth_span.x, p.z);
}
