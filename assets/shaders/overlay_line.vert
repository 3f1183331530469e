#version 450 core
// A line of an overlay becomes a rectangle on the screen, a little larger than the line itself.

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 rgba;
layout(location = 3) in vec4 style;  // width and dash, px; joined at from, joined at to

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;
layout(location = 4) uniform vec2 size;  // of the picture, px
layout(location = 5) uniform float pixel_scale;

flat out vec4 ends;       // px
flat out vec2 end_depth;  // what is linear on the screen: 1 / depth, orthographic: depth
flat out vec4 color;
flat out vec4 shape;      // radius and dash, px; joined

vec2 onScreen(vec3 p) {
    vec2 clip = depth_span.y > 0.0 ? lens.xy * p.xy + lens.zw
                                   : (lens.xy * p.xy + lens.zw * p.z) / p.z;
    return 0.5 * (clip + 1.0) * size;
}

void main() {
    vec3 a = camera_from_world * (from - camera_position);
    vec3 b = camera_from_world * (to - camera_position);
    float near_m = depth_span.x;
    color = rgba;
    shape = vec4(0.5 * style.x * pixel_scale, style.y * pixel_scale, style.zw);
    ends = vec4(0.0);
    end_depth = vec2(1.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside: nothing is drawn
    if (a.z < near_m && b.z < near_m) return;
    if (a.z < near_m) a = mix(b, a, (b.z - near_m) / (b.z - a.z));
    if (b.z < near_m) b = mix(a, b, (a.z - near_m) / (a.z - b.z));
    vec2 p = onScreen(a);
    vec2 q = onScreen(b);
    ends = vec4(p, q);
    end_depth = depth_span.y > 0.0 ? vec2(a.z, b.z) : 1.0 / vec2(a.z, b.z);

    vec2 way = q - p;
    float along = length(way);
    way = along > 1e-4 ? way / along : vec2(1.0, 0.0);
    float reach = shape.x + 2.0;
    int corner = gl_VertexID & 3;
    vec2 at = ((corner & 1) == 0 ? p - reach * way : q + reach * way) +
              ((corner & 2) == 0 ? -reach : reach) * vec2(-way.y, way.x);
    gl_Position = vec4(2.0 * at / size - 1.0, 0.5, 1.0);
}
