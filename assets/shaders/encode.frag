#version 450 core
// Encodes the accumulated mean, linear light, as the finished sRGB picture.

layout(binding = 0) uniform sampler2D sum;

layout(location = 0) out vec4 out_rgb;

void main() {
    vec3 linear = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb;
    out_rgb = vec4(mix(12.92 * linear,
                       1.055 * pow(max(linear, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
                       step(0.0031308, linear)), 1.0);
}
