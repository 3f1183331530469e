#version 450 core
// Shades the surface buffer. Light comes from the baked volume: direct lamp light with its
// direction and soft shadows, and indirect light from the room's surfaces. Background pixels are
// shaded, too, and discarded, because branches save nothing on the CPU.

layout(location = 0) uniform mat3 world_from_camera;
layout(location = 1) uniform vec4 unproject;
layout(location = 2) uniform vec3 camera_position;
layout(location = 3) uniform vec3 volume_low;
layout(location = 4) uniform vec3 volume_scale;  // volume texture coordinates per metre
layout(location = 5) uniform float lift_m;       // offset off the surface, out of the cell behind
                                                 // it
layout(location = 6) uniform float exposure;
layout(location = 7) uniform vec3 lamp_color;
layout(location = 8) uniform vec4 backdrop;      // linear background colour; a = 0: the sky
layout(location = 9) uniform int orthographic;
layout(location = 10) uniform float glow;        // factor of emission
layout(location = 17) uniform vec2 image_size;   // px

#ifdef MULTISAMPLED  // multisampled surface buffer
const int kSamplesPerPixel = 4;  // as in multisample_buffer.h
layout(location = 11) uniform float share;          // weight of each sample
// Sample positions, from the pixel's centre, px.
layout(location = 25) uniform vec2 offset[kSamplesPerPixel];
layout(location = 12) uniform vec2 depth_span;      // see surface.vert
#endif

#ifdef SENSOR  // accumulates linear light before the tone curve
layout(location = 13) uniform vec4 sum_lens;     // as unproject, for the accumulated image
layout(location = 14) uniform vec4 distortion;   // k1 k2 p1 p2
layout(location = 15) uniform float distortion_k3;
layout(location = 16) uniform vec4 row_time;     // slope, offset, half exposure; see weightOfRow
#endif

layout(location = 24) uniform vec3 own_color;    // light colour of the scene's own lamps

#ifdef SUN
layout(location = 18) uniform vec3 sun_irradiance;
layout(location = 19) uniform vec3 to_sun;
layout(location = 20) uniform mat3 sun_from_world;
layout(location = 21) uniform vec3 sun_eye;
layout(location = 22) uniform vec4 sun_scale;  // metres to texture coordinates, depth; m a texel
layout(location = 23) uniform float sun_blur;  // half width of the soft edge, m

layout(binding = 7) uniform sampler2DShadow sun_depth;
layout(binding = 8) uniform sampler2D sun_let_through;

// The share of sunlight that reaches a surface. The shadow's edge is as soft as the sun's disc
// makes it at a distance of a few metres.
// @param face  geometric normal, of any length; n may be smoothed or mapped
float sunAt(vec3 p, vec3 n, vec3 face) {
    // Offset the point along its face by the reach of the shadow filter. Across an outline,
    // neighbouring pixels span no face; there the offset follows n, as on a surface along the sun's
    // rays.
    vec3 off = face * (sign(dot(face, n)) / max(length(face), 1e-20));
    float leans = dot(off, to_sun);
    if (dot(off, n) < 0.2) {
        off = n;
        leans = 0.0;
    }
    float lift = (sun_blur + 2.0 * sun_scale.w) * sqrt(max(1.0 - leans * leans, 0.0)) + 0.002;
    vec3 q = sun_from_world * (p + lift * off - sun_eye);
    vec2 middle = 0.5 + q.xy * sun_scale.xy;
    vec2 apart = sun_blur * sun_scale.xy;
    // Beyond all shadow casters the depth is clamped, which means no shadow.
    float depth = max(1.0 - q.z * sun_scale.z, 0.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += texture(sun_depth, vec3(middle + vec2(x, y) * apart, depth));
        }
    }
    // At a building's outer edges half of the filter lies beyond it. Discounting that half stops
    // light leaking along the joints of floors and walls.
    return max(2.0 * sum / 9.0 - 1.0, 0.0) * texture(sun_let_through, middle).r;
}
#endif

#ifdef MULTISAMPLED
layout(binding = 0) uniform sampler2DMS colors;
layout(binding = 1) uniform sampler2DMS normals;
layout(binding = 2) uniform sampler2DMS depths;
#else
layout(binding = 0) uniform sampler2D colors;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surface;
#endif
layout(binding = 3) uniform sampler2D occlusion;
layout(binding = 4) uniform sampler3D ambient_volume;  // rgb: ambient irradiance
layout(binding = 5) uniform sampler3D lamp_volume;     // irradiance vector of the lamps; a: share
                                                       // of the scene's own lamps
layout(binding = 6) uniform sampler3D slope_volume;    // slope of the ambient light, see
                                                       // light_volume.h
#ifdef REFLECTIONS
layout(binding = 14) uniform sampler2D reflections;  // traced light; a: how much of it replaces the
                                                     // ambient reflection
#endif
layout(binding = 13) uniform sampler1D sky_colors;     // linear, by the sine of a direction's
                                                       // elevation

layout(location = 0) out vec4 out_rgb;

// Tone curve: identity up to 0.55, then a smooth roll-off, so that lamps do not clip.
vec3 toneCurve(vec3 c) {
    vec3 high = max(c - 0.55, 0.0);
    return min(c, 0.55) + 0.45 * high / (high + 0.45);
}

#ifdef SENSOR
// Inverse of the tone curve; values near 1 map to a large finite value.
vec3 beforeToneCurve(vec3 shown) {
    vec3 high = min(max(shown - 0.55, 0.0) / 0.45, 0.999);
    return min(shown, 0.55) + 0.45 * high / (1.0 - high);
}

// Integral from -1 to x of the hat function of height 1 on [-1, 1].
float hatUpTo(float x) {
    float inside = clamp(x, -1.0, 1.0);
    return 0.5 + inside - 0.5 * inside * abs(inside);
}

// Weight of this exposure sample in the sensor row that this pixel maps to through the lens. Light
// is interpolated linearly between samples, so the weight is the integral of the sample's hat
// function over the row's exposure.
float weightOfRow() {
    vec2 at = gl_FragCoord.xy * sum_lens.xy + sum_lens.zw;
    float r2 = dot(at, at);
    float radial = 1.0 + r2 * (distortion.x + r2 * (distortion.y + r2 * distortion_k3));
    float bent = at.y * radial + distortion.z * (r2 + 2.0 * at.y * at.y) +
                 2.0 * distortion.w * at.x * at.y;
    float middle = row_time.x * bent + row_time.y;
    return hatUpTo(middle + row_time.z) - hatUpTo(middle - row_time.z);
}
#endif

#if !defined(MULTISAMPLED) && !defined(SENSOR)
vec3 encode(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
               step(0.0031308, linear));
}
#endif

// The surface at one sample.
struct Seen {
    vec3 albedo;
    float special;  // metallic or emission
    vec3 normal;
    float roughness;
    float z;  // planar depth, m; 0: nothing was hit
};

#ifdef MULTISAMPLED
// Converts a depth-buffer value to planar depth, m.
float planarDepth(float depth) {
    float z = depth_span.y > 0.0 ? depth_span.x + (1.0 - depth) * depth_span.y
                                 : depth_span.x / depth;
    return depth > 0.0 ? z : 0.0;
}
#endif

// @param number  sample number; 0 without multisampling
Seen seenBy(int number) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef MULTISAMPLED
    vec4 color = texelFetch(colors, pixel, number);
    vec4 facing = texelFetch(normals, pixel, number);
    float z = planarDepth(texelFetch(depths, pixel, number).r);
#else
    vec4 color = texelFetch(colors, pixel, 0);
    vec4 facing = texelFetch(normals, pixel, 0);
    float z = texelFetch(surface, pixel, 0).r;
#endif
    return Seen(color.rgb * color.rgb, color.a, facing.xyz, abs(facing.w), z);
}

// @param at  image position, px
vec3 rayThrough(vec2 at) {
    vec2 aside = at * unproject.xy + unproject.zw;
    return world_from_camera * (orthographic != 0 ? vec3(0.0, 0.0, 1.0) : vec3(aside, 1.0));
}

vec3 positionOf(float z, vec2 at, vec3 ray) {
    vec2 aside = at * unproject.xy + unproject.zw;
    return camera_position + (orthographic != 0 ? world_from_camera * vec3(aside, z) : ray * z);
}

// Response of a GGX layer to directional light of irradiance 1, in units where a white diffuse
// surface returns 1. Uses Schlick's Fresnel approximation and Hammon's approximation of Smith
// masking (PBR Diffuse Lighting for GGX+Smith Microsurfaces, 2017).
vec3 highlight(vec3 n, vec3 view, vec3 to_light, vec3 f0, float alpha) {
    vec3 facet = normalize(view + to_light);
    float light = max(dot(n, to_light), 0.0);
    float eye = max(dot(n, view), 0.001);
    float facing = max(dot(n, facet), 0.0);
    float spread = facing * facing * (alpha * alpha - 1.0) + 1.0;
    float shape = 0.5 * alpha * alpha * light /
                  (spread * spread * mix(2.0 * light * eye, light + eye, alpha) + 1e-6);
    float grazing = 1.0 - max(dot(view, facet), 0.0);
    float grazing2 = grazing * grazing;
    return (f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing)) * shape;
}

// Share of uniform ambient light that a GGX layer reflects: a fit for single scattering (Karis,
// Physically Based Shading on Mobile, 2014) with compensation for multiple scattering (Turquin,
// Practical multiple scattering compensation, 2019).
struct Layer {
    vec3 thrown_back;
    vec3 gain;
};

Layer layerOf(float eye, vec3 f0, float roughness) {
    vec4 fit = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float grazing = 1.04 * (min(fit.x * fit.x, exp2(-9.28 * max(eye, 0.0))) * fit.x + fit.y);
    vec3 gain = 1.0 + f0 * (1.0 / (fit.z + fit.w) - 1.0);
    return Layer(max(f0 * (fit.z - grazing) + fit.w + grazing, vec3(0.0)) * gain, gain);
}

// Linear light before the tone curve.
vec3 lightFrom(Seen seen, vec2 pixel) {
    vec3 ray = rayThrough(pixel);
    vec3 n = seen.normal;
    vec3 albedo = seen.albedo;
    float metallic = seen.special < 0.5 ? seen.special * 2.0 : 0.0;
    float emission = seen.special > 0.5 ? (seen.special - 0.5) * 16.0 : 0.0;

    vec3 p = positionOf(seen.z, pixel, ray);
    vec3 at = (p + n * lift_m - volume_low) * volume_scale;
    vec3 around = texture(ambient_volume, at).rgb;
    vec3 slope = texture(slope_volume, at).xyz;
    vec4 lamps = texture(lamp_volume, at);
    vec3 lamp = lamps.xyz;
    vec3 lamp_light = mix(lamp_color, own_color, lamps.a);

    float lamp_strength = length(lamp);
    vec3 to_lamp = lamp_strength > 0.0 ? lamp / lamp_strength : n;
    float facing_lamp = max(0.0, dot(n, to_lamp));
    vec3 ambient = around * (1.0 + dot(slope, n));

    // Half-resolution occlusion, already blurred within depth edges.
    float open = texture(occlusion, gl_FragCoord.xy / image_size).r;
    // Interreflection in brightly coloured corners reduces the darkening.
    vec3 open_color = mix(vec3(open), vec3(1.0), 0.35 * albedo * (1.0 - open));

    vec3 irradiance = ambient * open_color +
                      lamp_light * (lamp_strength * facing_lamp * mix(1.0, open, 0.5));
#ifdef SUN
    float slant = dot(n, to_sun);
    vec3 face = cross(dFdx(p), dFdy(p));
    vec3 sun = slant > 0.0 ? sun_irradiance * sunAt(p, n, face) : vec3(0.0);
    irradiance += sun * slant;
#endif
    vec3 lit = albedo * (1.0 - metallic) * irradiance;

    // Highlights of the lamps and a blurred reflection of the room.
    vec3 view = -normalize(ray);
    vec3 mirror = reflect(-view, n);
    vec3 f0 = mix(vec3(0.04), albedo, metallic);
    // The slope of radiance is 1.5 times that of irradiance.
    vec3 room = around * max(0.0, 1.0 + 1.5 * dot(slope, mirror));
#ifdef REFLECTIONS
    // Traced for the pixel's centre. Rough surfaces beside a mirror (threshold as in
    // traced_reflections.cpp) do not use it.
    vec4 traced = texelFetch(reflections, ivec2(gl_FragCoord.xy), 0);
    room = mix(room * open, traced.rgb, seen.roughness < 0.3 ? traced.a : 0.0);
#else
    room *= open;
#endif
    // Lamps have an extent, here a fixed widening of the highlight; on mirrors it would show as a
    // halo.
    float alpha = max(seen.roughness * seen.roughness, 0.002);
    float lamp_alpha = min(alpha + min(0.2 * seen.roughness, 0.1), 1.0);
    Layer layer = layerOf(dot(n, view), f0, seen.roughness);
    vec3 shiny = layer.thrown_back * room +
                 layer.gain * lamp_light *
                     (lamp_strength * highlight(n, view, to_lamp, f0, lamp_alpha));

#ifdef SUN
    shiny += layer.gain * sun * highlight(n, view, to_sun, f0, max(alpha, 0.02));
#endif

    return exposure * (lit + shiny) + glow * emission * albedo;
}

vec3 skyAt(vec2 pixel) {
    float rise = normalize(rayThrough(pixel)).z;
    return backdrop.a > 0.0 ? backdrop.rgb : texture(sky_colors, 0.5 + 0.5 * rise).rgb;
}

// Both are always computed: texture lookups need the derivatives of neighbouring pixels.
vec3 shown(Seen seen, vec2 pixel) {
    vec3 light = toneCurve(lightFrom(seen, pixel));
    vec3 sky = skyAt(pixel);
    return seen.z > 0.0 ? light : sky;
}

#ifdef MULTISAMPLED
// Whether two samples receive the same light and lie on a straight part of the tone curve.
bool alike(Seen a, Seen b) {
    return abs(a.z - b.z) <= 0.02 * a.z && dot(a.normal, b.normal) >= 0.99 * sign(a.z) &&
           abs(a.roughness - b.roughness) < 0.03 && abs(a.special - b.special) < 0.02 &&
           (a.special > 0.5) == (b.special > 0.5) && distance(a.albedo, b.albedo) < 0.1;
}
#endif

void main() {
#if defined(ALIKE)
    // Pixels whose samples agree are shaded once; another variant shades the samples of the rest.
    Seen first = seenBy(0);
    Seen mean = first;
    bool same = true;
    for (int i = 1; i < kSamplesPerPixel; ++i) {
        Seen other = seenBy(i);
        same = same && alike(first, other);
        mean.albedo += other.albedo;
        mean.normal += other.normal;
        mean.z += other.z;
    }
    mean.albedo /= float(kSamplesPerPixel);
    mean.normal = mean.z > 0.0 ? normalize(mean.normal) : mean.normal;
    mean.z /= float(kSamplesPerPixel);
    out_rgb = vec4(float(kSamplesPerPixel) * share * shown(mean, gl_FragCoord.xy), 1.0);
    if (!same) discard;  // last, because neighbouring pixels need its derivatives
#elif defined(MULTISAMPLED)
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kSamplesPerPixel; ++i) sum += shown(seenBy(i), gl_FragCoord.xy + offset[i]);
    out_rgb = vec4(share * sum, 1.0);  // averages linear light
#elif defined(SENSOR)
    Seen seen = seenBy(0);
    vec3 light = lightFrom(seen, gl_FragCoord.xy);
    vec3 sky = beforeToneCurve(skyAt(gl_FragCoord.xy));
    out_rgb = weightOfRow() * vec4(seen.z > 0.0 ? light : sky, 1.0);
#else
    out_rgb = vec4(encode(shown(seenBy(0), gl_FragCoord.xy)), 1.0);
#endif
}
