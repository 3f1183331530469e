#version 450 core
// A line with round ends and soft edges. Wide lines get a thin dark rim, so that they stand out
// from a bright wall as from a dark floor.

flat in vec4 ends;
flat in vec2 end_depth;
flat in vec4 color;
flat in vec4 shape;

layout(location = 3) uniform vec2 depth_span;
layout(location = 6) uniform vec2 opacity;  // before and behind the scene's surfaces
// A line on a floor is not in it: share of the depth, in orthographic views metres.
layout(location = 7) uniform float bias;

layout(binding = 0) uniform sampler2D surface;

layout(location = 0) out vec4 out_rgba;

void main() {
    vec2 way = ends.zw - ends.xy;
    float whole = length(way);
    vec2 offset = gl_FragCoord.xy - ends.xy;
    float along = whole > 1e-4 ? dot(offset, way) / whole : 0.0;
    // Where lines join each pixel belongs to one of them, or translucent ones would show beads.
    if ((shape.z > 0.5 && along < 0.0) || (shape.w > 0.5 && along >= whole)) discard;
    float t = whole > 1e-4 ? clamp(along / whole, 0.0, 1.0) : 0.0;
    float away = length(offset - t * way);
    float radius = max(shape.x, 0.5);
    float thin = min(1.0, 2.0 * shape.x);  // below a pixel wide: fainter, not thinner
    float core = clamp(radius + 0.5 - away, 0.0, 1.0);
    if (shape.y > 0.0) {
        float beyond = abs(mod(along, 2.0 * shape.y) - 0.5 * shape.y) - 0.5 * shape.y;
        core *= clamp(0.5 - beyond, 0.0, 1.0);
    }
    float rim = 0.0;
    if (shape.x > 0.9 && shape.y == 0.0 && along >= 0.0 && along <= whole) {
        rim = 0.45 * clamp(radius + 1.4 - away, 0.0, 1.0);
    }
    float cover = max(core, rim);
    if (cover <= 0.0) discard;

    float depth = mix(end_depth.x, end_depth.y, t);
    float nearer = depth_span.y > 0.0 ? depth - bias : (1.0 - bias) / depth;
    float scene = texelFetch(surface, ivec2(gl_FragCoord.xy), 0).r;
    float share = scene > 0.0 && nearer > scene ? opacity.y : opacity.x;
    vec3 rgb = mix(0.25 * color.rgb, color.rgb, core / cover);
    out_rgba = vec4(rgb, color.a * cover * thin * share);
}
