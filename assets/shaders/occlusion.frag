#version 450 core
// Screen-space ambient occlusion (SSAO) at half resolution: darkens corners and contacts at a scale
// too fine for the light volume. Each sample occludes by its height above the tangent plane.

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec4 unproject;  // x scale, y scale, x offset, y offset, full pixels
layout(location = 2) uniform float pixels_per_radian;  // orthographic: pixels per metre
layout(location = 3) uniform int orthographic;

#ifdef MULTISAMPLED  // reads the first sample of the multisampled buffer
layout(location = 4) uniform vec2 depth_span;  // see surface.vert

layout(binding = 1) uniform sampler2DMS normals;
layout(binding = 2) uniform sampler2DMS depths;
#else
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surface;
#endif

layout(location = 0) out vec2 out_light;  // and planar depth, m

const float kRadius = 0.30;  // m
const int kSamples = 8;

vec3 pointAt(ivec2 pixel) {
#ifdef MULTISAMPLED
    float depth = texelFetch(depths, pixel, 0).r;
    float z = depth_span.y > 0.0 ? depth_span.x + (1.0 - depth) * depth_span.y
                                 : depth_span.x / depth;
    z = depth > 0.0 ? z : 0.0;
#else
    float z = texelFetch(surface, pixel, 0).r;
#endif
    vec2 aside = (vec2(pixel) + 0.5) * unproject.xy + unproject.zw;
    return orthographic != 0 ? vec3(aside, z) : vec3(aside, 1.0) * z;
}

#ifdef MAPS
// The geometric normal, without the normal map, from the neighbours nearest in depth.
vec3 flatNormal(vec3 p, ivec2 pixel, ivec2 size) {
    vec3 across[2];
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        vec3 before = pointAt(max(pixel - step, ivec2(0)));
        vec3 after = pointAt(min(pixel + step, size - 1));
        bool use_after = abs(after.z - p.z) <= abs(p.z - before.z) && after != p || before == p;
        across[axis] = use_after ? after - p : p - before;
    }
    vec3 n = normalize(cross(across[0], across[1]));
    vec3 along = orthographic != 0 ? vec3(0.0, 0.0, 1.0) : p;
    return dot(n, along) > 0.0 ? -n : n;
}
#endif

void main() {
#ifdef MULTISAMPLED
    ivec2 size = textureSize(depths);
#else
    ivec2 size = textureSize(surface, 0);
#endif
    ivec2 pixel = min(ivec2(gl_FragCoord.xy) * 2, size - 1);
    vec3 p = pointAt(pixel);
    if (p.z <= 0.0) {
        out_light = vec2(1.0, p.z);
        return;
    }
    vec4 facing = texelFetch(normals, pixel, 0);
    vec3 n = camera_from_world * facing.xyz;
#ifdef MAPS
    if (facing.w < 0.0) n = flatNormal(p, pixel, size);
#endif
    float reach = clamp(kRadius * pixels_per_radian / (orthographic != 0 ? 1.0 : p.z), 4.0, 160.0);
    // The sampling pattern rotates within a 4 x 4 tile; the following blur averages over the tile.
    ivec2 tile = ivec2(gl_FragCoord.xy) & 3;
    float turn = float((tile.x * 4 + ((tile.y * 7) & 15)) & 15) * (6.2831853 / 16.0);
    vec2 way = vec2(cos(turn), sin(turn));
    const mat2 next = mat2(cos(2.39996323), sin(2.39996323), -sin(2.39996323), cos(2.39996323));
    float hidden = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        float share = (float(i) + 0.5) / float(kSamples);
        ivec2 at = pixel + ivec2(round(way * (share * reach)));
        way = next * way;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
        vec3 v = pointAt(at) - p;
        float squared = dot(v, v);
        float fade = max(0.0, 1.0 - squared / (kRadius * kRadius));
        hidden += fade * max(0.0, dot(v, n) - 0.004 * p.z) / (sqrt(squared) + 0.02);
    }
    out_light = vec2(clamp(1.0 - 1.7 * hidden / float(kSamples), 0.0, 1.0), p.z);
}
