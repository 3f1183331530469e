#version 450 core
// Marks drawn by signed distance functions: antialiased at any size, with a dark rim.

in vec2 offset;
flat in vec4 color;
flat in vec4 shape;

layout(location = 5) uniform float pixel_scale;
layout(location = 6) uniform float opacity;

layout(location = 0) out vec4 out_rgba;

float bar(vec2 p, vec2 half_size) {
    vec2 d = abs(p) - half_size;
    return length(max(d, 0.0)) + min(max(d.x, d.y), 0.0);
}

// Signed distance to the mark's outline, px; negative inside. Shape numbers are those of
// OverlayMark.
float outline(vec2 p, float radius) {
    int kind = int(shape.y + 0.5);
    float stroke = max(0.16 * radius, 0.75 * pixel_scale);
    if (kind == 1) {
        vec2 turned = vec2(p.x + p.y, p.y - p.x) * 0.70710678;
        float arm = 1.41421356 * radius - stroke;
        return min(bar(turned, vec2(arm, stroke)), bar(turned, vec2(stroke, arm)));
    }
    if (kind == 2) return bar(p, vec2(0.886 * radius));  // same area as a dot
    if (kind == 3) return abs(length(p) - (radius - stroke)) - stroke;
    if (kind == 4 && dot(shape.zw, shape.zw) > 0.5) {
        // An arrow head pointing along its direction.
        vec2 q = vec2(dot(p, shape.zw), abs(dot(p, vec2(-shape.w, shape.z)))) / radius;
        float side = dot(q - vec2(1.0, 0.0), vec2(0.4243, 0.9055));
        return max(side, -q.x - 0.6) * radius;
    }
    return length(p) - radius;
}

void main() {
    float away = outline(offset, shape.x);
    float core = clamp(0.5 - away, 0.0, 1.0);
    // A strong rim would hide thin strokes.
    float strength = int(shape.y + 0.5) == 1 ? 0.4 : 0.7;
    float rim = strength * clamp(1.6 - away, 0.0, 1.0);
    float cover = max(core, rim);
    float body = cover > 0.0 ? core / cover : 0.0;
    vec3 rgb = mix(vec3(0.08), color.rgb, body);
    out_rgba = vec4(rgb, color.a * cover * opacity);
}
