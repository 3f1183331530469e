#version 450 core
// Edge antialiasing of the finished picture (FXAA-like): where brightness jumps, the pixel is
// blended along the edge. The edge direction comes from brightness at the pixel's four corners.
// Flat areas stay unchanged.

layout(binding = 0) uniform sampler2D picture;

layout(location = 0) out vec4 out_rgb;

float brightness(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

void main() {
    vec2 texel = 1.0 / vec2(textureSize(picture, 0));
    vec2 at = gl_FragCoord.xy * texel;
    vec3 here = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    // Each corner is the mean of the four pixels around it.
    float nw = brightness(texture(picture, at + vec2(-0.5, -0.5) * texel).rgb);
    float ne = brightness(texture(picture, at + vec2(0.5, -0.5) * texel).rgb);
    float sw = brightness(texture(picture, at + vec2(-0.5, 0.5) * texel).rgb);
    float se = brightness(texture(picture, at + vec2(0.5, 0.5) * texel).rgb);
    float low = min(min(nw, ne), min(sw, se));
    float high = max(max(nw, ne), max(sw, se));
    if (high - low < max(0.03, 0.08 * high)) {
        out_rgb = vec4(here, 1.0);
        return;
    }
    // The gradient runs across the edge. A short filter along the edge smooths stair steps and
    // keeps pixels beside the edge.
    vec2 gradient = vec2(ne + se - nw - sw, sw + se - nw - ne);
    vec2 along = normalize(vec2(-gradient.y, gradient.x) + 1e-5) * texel;
    vec3 sum = 0.28 * texture(picture, at).rgb;
    sum += 0.22 * (texture(picture, at - 0.9 * along).rgb + texture(picture, at + 0.9 * along).rgb);
    sum += 0.14 * (texture(picture, at - 2.1 * along).rgb + texture(picture, at + 2.1 * along).rgb);
    out_rgb = vec4(sum, 1.0);
}
