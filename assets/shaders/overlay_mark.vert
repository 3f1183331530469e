#version 450 core
// Turns an overlay mark into a screen square around its point.

layout(location = 0) in vec3 at;
layout(location = 1) in vec3 direction;
layout(location = 2) in vec4 rgba;
layout(location = 3) in vec2 style;  // size, px; shape

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;
layout(location = 4) uniform vec2 size;
layout(location = 5) uniform float pixel_scale;
layout(location = 7) uniform float bias;  // see overlay_line.vert
layout(location = 8) uniform vec3 clip_low;  // only marks inside this box are drawn
layout(location = 9) uniform vec3 clip_high;

out vec2 offset;           // from the centre, px
flat out vec4 color;
flat out vec4 shape;       // radius, px; shape; screen direction of an arrow

void main() {
    vec3 p = camera_from_world * (at - camera_position);
    vec3 ahead = camera_from_world * direction;
    color = rgba;
    offset = vec2(0.0);
    float radius = 0.5 * style.x * pixel_scale;
    shape = vec4(radius, style.y, 0.0, 0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (any(lessThan(at, clip_low)) || any(greaterThan(at, clip_high))) return;
    if (p.z < depth_span.x) return;
    bool parallel = depth_span.y > 0.0;
    vec2 clip = parallel ? lens.xy * p.xy + lens.zw : (lens.xy * p.xy + lens.zw * p.z) / p.z;
    // Screen velocity of the point when it moves along `direction`.
    vec2 way = (parallel ? lens.xy * ahead.xy
                         : lens.xy * (ahead.xy * p.z - p.xy * ahead.z) / (p.z * p.z)) * size;
    float speed = length(way);
    if (speed > 1e-3) shape.zw = way / speed;
    int corner = gl_VertexID & 3;
    vec2 side = vec2((corner & 1) == 0 ? -1.0 : 1.0, (corner & 2) == 0 ? -1.0 : 1.0);
    offset = side * (radius + 1.6);
    float depth = parallel ? 1.0 - (p.z - bias - depth_span.x) / depth_span.y
                           : depth_span.x / ((1.0 - bias) * p.z);
    gl_Position = vec4(clip + 2.0 * offset / size, clamp(depth, 0.0, 1.0), 1.0);
}
