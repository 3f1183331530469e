#version 450 core
// A line with round ends and antialiased edges. Wide lines get a thin dark rim, to stand out from
// bright and dark backgrounds.

noperspective in vec2 place;
flat in vec4 color;
flat in vec3 shape;

layout(location = 6) uniform float opacity;

layout(location = 0) out vec4 out_rgba;

void main() {
    float away = length(vec2(max(max(-place.x, place.x - shape.x), 0.0), place.y));
    float radius = max(shape.y, 0.5);
    float core = clamp(radius + 0.5 - away, 0.0, 1.0);
    float rim = 0.0;
    if (shape.z > 0.0) {
        float beyond = abs(mod(place.x, 2.0 * shape.z) - 0.5 * shape.z) - 0.5 * shape.z;
        core *= clamp(0.5 - beyond, 0.0, 1.0);
    } else if (shape.y > 0.9 && place.x >= 0.0 && place.x <= shape.x) {
        rim = 0.45 * clamp(radius + 1.4 - away, 0.0, 1.0);
    }
    float cover = max(core, rim);
    float thin = min(1.0, 2.0 * shape.y);  // lines thinner than a pixel become fainter instead
    float body = cover > 0.0 ? core / cover : 0.0;
    out_rgba = vec4(color.rgb * mix(0.25, 1.0, body), color.a * cover * thin * opacity);
}
