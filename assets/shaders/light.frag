#version 450 core
// Lights surface buffers. Light comes from the baked volume: the light of the lamps, with its
// direction and soft shadows, and the light that the room's surfaces throw back. Where nothing is
// hit it is worked out, too, and left: on the processor branches save nothing.

layout(location = 0) uniform mat3 world_from_camera;
layout(location = 1) uniform vec4 unproject;
layout(location = 2) uniform vec3 camera_position;
layout(location = 3) uniform vec3 volume_low;
layout(location = 4) uniform vec3 volume_scale;  // volume texture coordinates per metre
layout(location = 5) uniform float lift_m;       // off the surface, out of the cell behind it
layout(location = 6) uniform float exposure;
layout(location = 7) uniform vec3 lamp_color;
layout(location = 8) uniform vec4 backdrop;      // linear, where nothing is hit; a = 0: the sky
layout(location = 9) uniform int orthographic;
layout(location = 10) uniform float glow;        // of emission, for one unit
layout(location = 17) uniform vec2 image_size;   // px

#ifdef LOOKS  // several looks at each pixel, as light
const int kLooks = 4;  // as in look_images.h
layout(location = 11) uniform float share;          // of each in the mean
layout(location = 25) uniform vec2 offset[kLooks];  // from the pixel's middle, px
layout(location = 12) uniform vec2 depth_span;      // see surface.vert
#endif

#ifdef SENSOR  // light before the tone curve is added up
layout(location = 13) uniform vec4 sum_lens;     // as unproject, of the sum
layout(location = 14) uniform vec4 distortion;   // k1 k2 p1 p2
layout(location = 15) uniform float distortion_k3;
layout(location = 16) uniform vec4 row_time;     // slope, offset, half exposure; see weightOfRow
#endif

layout(location = 24) uniform vec3 own_color;    // of the scene's own lamps

#ifdef SUN
layout(location = 18) uniform vec3 sun_irradiance;
layout(location = 19) uniform vec3 to_sun;
layout(location = 20) uniform mat3 sun_from_world;
layout(location = 21) uniform vec3 sun_eye;
layout(location = 22) uniform vec4 sun_scale;  // metres to texture coordinates, depth; m a texel
layout(location = 23) uniform float sun_blur;  // half width of the soft edge, m

layout(binding = 7) uniform sampler2DShadow sun_depth;
layout(binding = 8) uniform sampler2D sun_let_through;

// The share of the sun's light that reaches a surface; the edge of a shadow is as soft as the
// sun's disc makes it a few metres away.
// @param face  across the surface as it is, of any length; n may be smoothed or a map's
float sunAt(vec3 p, vec3 n, vec3 face) {
    // Off the surface, as far as a texel of the filter may lie above or below it. Neighbours across
    // an outline span no face: there as far off as from one along the sun's light.
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
    // Beyond all that casts shadows there is no depth left, and no shadow either.
    float depth = max(1.0 - q.z * sun_scale.z, 0.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += texture(sun_depth, vec3(middle + vec2(x, y) * apart, depth));
        }
    }
    // Beside the far edges of a building half of the filter looks past all of it: that half lets
    // nothing through, or light would leak along the joints of floors and walls.
    return max(2.0 * sum / 9.0 - 1.0, 0.0) * texture(sun_let_through, middle).r;
}
#endif

#ifdef LOOKS
layout(binding = 0) uniform sampler2DMS colors;
layout(binding = 1) uniform sampler2DMS normals;
layout(binding = 2) uniform sampler2DMS depths;
#else
layout(binding = 0) uniform sampler2D colors;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surface;
#endif
layout(binding = 3) uniform sampler2D occlusion;
layout(binding = 4) uniform sampler3D ambient_volume;  // rgb: irradiance from all around
layout(binding = 5) uniform sampler3D lamp_volume;     // irradiance vector of the lamps; a: own share
layout(binding = 6) uniform sampler3D slope_volume;    // of the ambient light, see light_volume.h
#ifdef REFLECTIONS
layout(binding = 14) uniform sampler2D reflections;  // light; a: share of it in place of the room's
#endif
layout(binding = 13) uniform sampler1D sky_colors;     // linear, by the sine of a way's height

layout(location = 0) out vec4 out_rgb;

// Leaves dark and middle tones alone and rolls off towards white, so that lamps do not clip.
vec3 toneCurve(vec3 c) {
    vec3 high = max(c - 0.55, 0.0);
    return min(c, 0.55) + 0.45 * high / (high + 0.45);
}

#ifdef SENSOR
// What the tone curve makes this of; of full white something very bright.
vec3 beforeToneCurve(vec3 shown) {
    vec3 high = min(max(shown - 0.55, 0.0) / 0.45, 0.999);
    return min(shown, 0.55) + 0.45 * high / (1.0 - high);
}

// The integral of a hat of height 1 that stands on -1 to 1, from there to x.
float hatUpTo(float x) {
    float inside = clamp(x, -1.0, 1.0);
    return 0.5 + inside - 0.5 * inside * abs(inside);
}

// What share the look has of the sensor's row that looks here through its lens. Light changes evenly
// from one look to the next: a row has the integral of the look's hat over its exposure.
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

#if !defined(LOOKS) && !defined(SENSOR)
vec3 encode(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
               step(0.0031308, linear));
}
#endif

// What a look sees.
struct Seen {
    vec3 albedo;
    float special;  // metallic or emission
    vec3 normal;
    float roughness;
    float z;  // 0: nothing
};

#ifdef LOOKS
// Planar depth of what has this value in the depth buffer, m.
float planarDepth(float depth) {
    float z = depth_span.y > 0.0 ? depth_span.x + (1.0 - depth) * depth_span.y
                                 : depth_span.x / depth;
    return depth > 0.0 ? z : 0.0;
}
#endif

// @param look  of several; otherwise there is one
Seen seenBy(int look) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef LOOKS
    vec4 color = texelFetch(colors, pixel, look);
    vec4 facing = texelFetch(normals, pixel, look);
    float z = planarDepth(texelFetch(depths, pixel, look).r);
#else
    vec4 color = texelFetch(colors, pixel, 0);
    vec4 facing = texelFetch(normals, pixel, 0);
    float z = texelFetch(surface, pixel, 0).r;
#endif
    return Seen(color.rgb * color.rgb, color.a, facing.xyz, abs(facing.w), z);
}

// @param at  in the image, px
vec3 rayThrough(vec2 at) {
    vec2 aside = at * unproject.xy + unproject.zw;
    return world_from_camera * (orthographic != 0 ? vec3(0.0, 0.0, 1.0) : vec3(aside, 1.0));
}

vec3 positionOf(float z, vec2 at, vec3 ray) {
    vec2 aside = at * unproject.xy + unproject.zw;
    return camera_position + (orthographic != 0 ? world_from_camera * vec3(aside, z) : ray * z);
}

// What a GGX layer makes of light from one direction, of irradiance 1 across it: with Schlick's
// Fresnel and Hammon's approximation of Smith's masking (PBR Diffuse Lighting for GGX+Smith
// Microsurfaces, 2017). In the unit of irradiance, which a white surface throws back whole.
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

// The share that a GGX layer throws back of the same light from everywhere: a fit (Karis, Physically
// Based Shading on Mobile, 2014) of single reflections, and what gives back those from facet to facet
// (Turquin, Practical multiple scattering compensation, 2019).
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

// Before the tone curve.
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

    // The occlusion of a quarter of the pixels, brought up without crossing depth edges.
    float open = texture(occlusion, gl_FragCoord.xy / image_size).r;
    // Light thrown around in a corner of a bright colour darkens less.
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
    // Radiance has half as much again of the irradiance's slope.
    vec3 room = around * max(0.0, 1.0 + 1.5 * dot(slope, mirror));
#ifdef REFLECTIONS
    // Of what the pixel's middle sees. Rough things beside a mirror (as in traced_reflections.cpp)
    // have no part in it.
    vec4 traced = texelFetch(reflections, ivec2(gl_FragCoord.xy), 0);
    room = mix(room * open, traced.rgb, seen.roughness < 0.3 ? traced.a : 0.0);
#else
    room *= open;
#endif
    // A lamp is as wide as a hand at arm's length; mirrors would show it in a halo.
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

// Both are worked out: light is looked up by what neighbours see, too.
vec3 shown(Seen seen, vec2 pixel) {
    vec3 light = toneCurve(lightFrom(seen, pixel));
    vec3 sky = skyAt(pixel);
    return seen.z > 0.0 ? light : sky;
}

#ifdef LOOKS
// Whether light falls on both in the same way, and the tone curve is straight between them.
bool alike(Seen a, Seen b) {
    return abs(a.z - b.z) <= 0.02 * a.z && dot(a.normal, b.normal) >= 0.99 * sign(a.z) &&
           abs(a.roughness - b.roughness) < 0.03 && abs(a.special - b.special) < 0.02 &&
           (a.special > 0.5) == (b.special > 0.5) && distance(a.albedo, b.albedo) < 0.1;
}
#endif

void main() {
#if defined(ALIKE)
    // Where all see the same, it is lit once; the others are left to the shader that lights each.
    Seen first = seenBy(0);
    Seen mean = first;
    bool same = true;
    for (int i = 1; i < kLooks; ++i) {
        Seen other = seenBy(i);
        same = same && alike(first, other);
        mean.albedo += other.albedo;
        mean.normal += other.normal;
        mean.z += other.z;
    }
    mean.albedo /= float(kLooks);
    mean.normal = mean.z > 0.0 ? normalize(mean.normal) : mean.normal;
    mean.z /= float(kLooks);
    out_rgb = vec4(float(kLooks) * share * shown(mean, gl_FragCoord.xy), 1.0);
    if (!same) discard;  // last: neighbours look up light by it
#elif defined(LOOKS)
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kLooks; ++i) sum += shown(seenBy(i), gl_FragCoord.xy + offset[i]);
    out_rgb = vec4(share * sum, 1.0);  // the mean is taken of light
#elif defined(SENSOR)
    Seen seen = seenBy(0);
    vec3 light = lightFrom(seen, gl_FragCoord.xy);
    vec3 sky = beforeToneCurve(skyAt(gl_FragCoord.xy));
    out_rgb = weightOfRow() * vec4(seen.z > 0.0 ? light : sky, 1.0);
#else
    out_rgb = vec4(encode(shown(seenBy(0), gl_FragCoord.xy)), 1.0);
#endif
}
