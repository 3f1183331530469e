#version 450 core
// Turns an overlay line into a screen rectangle slightly larger than the line.

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 rgba;
layout(location = 3) in vec4 style;  // width and dash, px; whether it joins another line at from,
                                     // at to

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;
layout(location = 3) uniform vec2 depth_span;
layout(location = 4) uniform vec2 size;  // of the image, px
layout(location = 5) uniform float pixel_scale;
// Draws lines on a surface in front of it: a share of the depth, in orthographic views metres.
layout(location = 7) uniform float bias;
layout(location = 8) uniform vec3 clip_low;  // only what lies inside this box is drawn
layout(location = 9) uniform vec3 clip_high;

noperspective out vec2 place;  // along the line from its start, and across it, px
flat out vec4 color;
flat out vec3 shape;  // length, radius, dash, px

vec2 onScreen(vec3 p) {
    vec2 clip = depth_span.y > 0.0 ? lens.xy * p.xy + lens.zw
                                   : (lens.xy * p.xy + lens.zw * p.z) / p.z;
    return 0.5 * (clip + 1.0) * size;
}

// Shortens the line to its part inside the clipping box; returns false if there is none.
bool clipToBox(inout vec3 p, inout vec3 q) {
    vec3 way = q - p;
    float first = 0.0;
    float last = 1.0;
    for (int i = 0; i < 3; ++i) {
        if (way[i] == 0.0) {
            if (p[i] < clip_low[i] || p[i] > clip_high[i]) return false;
            continue;
        }
        float s = (clip_low[i] - p[i]) / way[i];
        float t = (clip_high[i] - p[i]) / way[i];
        first = max(first, min(s, t));
        last = min(last, max(s, t));
    }
    if (first > last) return false;
    vec3 start = p;
    if (first > 0.0) p = start + first * way;
    if (last < 1.0) q = start + last * way;
    return true;
}

void main() {
    vec3 start = from;
    vec3 end = to;
    bool inside = clipToBox(start, end);
    vec3 a = camera_from_world * (start - camera_position);
    vec3 b = camera_from_world * (end - camera_position);
    float near_m = depth_span.x;
    color = rgba;
    shape = vec3(0.0, 0.5 * style.x * pixel_scale, style.y * pixel_scale);
    place = vec2(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the clip volume: nothing is drawn
    if (!inside || (a.z < near_m && b.z < near_m)) return;
    if (a.z < near_m) a = mix(b, a, (b.z - near_m) / (b.z - a.z));
    if (b.z < near_m) b = mix(a, b, (a.z - near_m) / (a.z - b.z));
    vec2 p = onScreen(a);
    vec2 q = onScreen(b);
    // Depth as in surface.vert: linear in screen space for both projections.
    vec2 depths = depth_span.y > 0.0
                      ? 1.0 - (vec2(a.z, b.z) - bias - depth_span.x) / depth_span.y
                      : depth_span.x / ((1.0 - bias) * vec2(a.z, b.z));
    vec2 way = q - p;
    float along = length(way);
    way = along > 1e-4 ? way / along : vec2(1.0, 0.0);
    shape.x = along;
    // Free ends are round. Joined ends are cut, so that each pixel belongs to one line; otherwise
    // overlapping translucent ends would show as beads.
    float reach = max(shape.y, 0.5) + (shape.y > 0.9 ? 1.4 : 0.6);
    int corner = gl_VertexID & 3;
    bool at_end = (corner & 1) != 0;
    float beyond = (at_end ? style.w : style.z) > 0.5 ? 0.0 : reach;
    place.x = at_end ? along + beyond : -beyond;
    place.y = (corner & 2) == 0 ? -reach : reach;
    float depth = mix(depths.x, depths.y, along > 1e-4 ? place.x / along : 0.0);
    vec2 at = p + place.x * way + place.y * vec2(-way.y, way.x);
    gl_Position = vec4(2.0 * at / size - 1.0, clamp(depth, 0.0, 1.0), 1.0);
}
