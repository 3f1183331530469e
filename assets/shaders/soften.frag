#version 450 core
// Averages the occlusion over its 4 x 4 pattern, leaving out what lies at another depth.

layout(binding = 2) uniform sampler2D surface;
layout(binding = 3) uniform sampler2D occlusion;

layout(location = 0) out float out_light;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(occlusion, 0) - 1;
    ivec2 full_last = textureSize(surface, 0) - 1;
    float z = texelFetch(surface, min(pixel * 2, full_last), 0).r;
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
            float other = texelFetch(surface, min(at * 2, full_last), 0).r;
            float weight = abs(other - z) < 0.03 * z + 0.02 ? 1.0 : 0.001;
            sum += weight * texelFetch(occlusion, at, 0).r;
            weights += weight;
        }
    }
    out_light = sum / weights;
}
