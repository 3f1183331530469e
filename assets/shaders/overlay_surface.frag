#version 450 core
// Draws the frontmost block or triangle of an overlay per pixel into a separate image. Block edges
// are one pixel wide and fade where blocks become too small.

flat in vec4 color;
in vec2 on_face;

layout(location = 3) uniform vec2 depth_span;
layout(location = 4) uniform vec2 opacity;  // in front of and behind the scene's surfaces
layout(location = 5) uniform float bias;    // see overlay_line.vert

layout(binding = 0) uniform sampler2D surface;

layout(location = 0) out vec4 out_rgba;

void main() {
    vec2 per_pixel = max(fwidth(on_face), vec2(1e-6));
    vec2 from_edge = (0.5 - abs(fract(on_face) - 0.5)) / per_pixel;
    float edge = 1.0 - smoothstep(0.3, 1.3, min(from_edge.x, from_edge.y));
    edge *= smoothstep(4.0, 12.0, 1.0 / max(per_pixel.x, per_pixel.y));
    float z = depth_span.y > 0.0 ? depth_span.x + (1.0 - gl_FragCoord.z) * depth_span.y
                                 : 1.0 / gl_FragCoord.w;
    float nearer = depth_span.y > 0.0 ? z - bias : z * (1.0 - bias);
    float scene = abs(texelFetch(surface, ivec2(gl_FragCoord.xy), 0).r);
    float share = scene > 0.0 && nearer > scene ? opacity.y : opacity.x;
    float alpha = mix(color.a, min(1.0, 1.35 * color.a), edge);
    out_rgba = vec4(color.rgb * (1.0 - 0.3 * edge), alpha * share);
}
