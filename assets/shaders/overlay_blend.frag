#version 450 core
// Blends the image of an overlay's blocks and triangles over the picture.

layout(binding = 0) uniform sampler2D overlay;

layout(location = 0) out vec4 out_rgba;

void main() {
    out_rgba = texelFetch(overlay, ivec2(gl_FragCoord.xy), 0);
    if (out_rgba.a == 0.0) discard;
}
