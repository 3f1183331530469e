#version 450 core
// Blurs the ambient occlusion over its 4 x 4 pattern, ignoring pixels at other depths.

layout(binding = 3) uniform sampler2D occlusion;  // and planar depth

layout(location = 0) out float out_light;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(occlusion, 0) - 1;
    float z = texelFetch(occlusion, pixel, 0).g;
    float near = 0.03 * z + 0.02;
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            vec2 other = texelFetch(occlusion, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).rg;
            float weight = abs(other.g - z) < near ? 1.0 : 0.001;
            sum += weight * other.r;
            weights += weight;
        }
    }
    out_light = sum / weights;
}
