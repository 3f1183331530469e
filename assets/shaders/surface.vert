#version 450 core
// One vertex of the scene. Clip space follows the pinhole camera (x right, y down, z forward), so
// that row 0 of the image is its top. Depth is near / z, which keeps its precision at a distance
// and needs no far plane. Orthographic views have one: their depth falls linearly from 1 to 0.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 base_color;  // square root of linear colour
layout(location = 4) in vec4 traits;      // roughness, metallic, emission / 8, kind: above 1/2 is
                                          // structure, 1/4 or 3/4 shows the outside
layout(location = 5) in uint object_id;

layout(location = 0) uniform mat3 camera_from_world;
layout(location = 1) uniform vec3 camera_position;
layout(location = 2) uniform vec4 lens;  // 2 fx / w, 2 fy / h, 2 cx / w - 1, 2 cy / h - 1
layout(location = 3) uniform vec2 depth_span;  // near plane, m; depth range of an orthographic
                                               // view, m, else 0

out vec3 offset_in_world;
out vec3 normal_in_world;
out vec2 texture_uv;
flat out vec4 surface_color;
flat out vec4 surface_traits;
flat out uint surface_id;

void main() {
    offset_in_world = position - camera_position;
    vec3 p = camera_from_world * offset_in_world;
    gl_Position = depth_span.y > 0.0
                      ? vec4(lens.xy * p.xy + lens.zw, 1.0 - (p.z - depth_span.x) / depth_span.y, 1.0)
                      : vec4(lens.xy * p.xy + lens.zw * p.z, depth_span.x, p.z);
    normal_in_world = normal;
    texture_uv = vec2(uv.x, 1.0 - uv.y);
    surface_color = base_color;
    surface_traits = traits;
    surface_id = object_id;
}
