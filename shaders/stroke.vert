#version 460
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"

// The rectangle on the screen around a line and its round ends, with the depths of the ends.

layout(location = 0) out vec2 pixel;
layout(location = 1) flat out vec4 ends;  // Ends of the line, in pixels.
layout(location = 2) flat out float radius;
layout(location = 3) flat out vec3 color;

vec3 lifted(vec3 position, float lift) {
    const bool is_orthographic = cloud.clip_w.x == 0.0;
    const float max_lift = is_orthographic ? lift : 0.5 * distance(cloud.camera, position);
    return position + min(lift, max_lift) * towards_camera(position);
}

vec2 pixel_of(vec4 clip) { return clip.xy / clip.w * cloud.guard * cloud.half_extent; }

void main() {
    const StrokeRecord stroke = cloud.strokes.at[gl_InstanceIndex];
    const vec4 from = clip_from_world(lifted(stroke.from, stroke.lifts.x));
    const vec4 to = clip_from_world(lifted(stroke.to, stroke.lifts.y));
    radius = stroke.radius * cloud.scale;
    color = linear_from_srgb(unpackUnorm4x8(stroke.color).rgb);
    // Lines are short. A line that reaches behind the near plane is not drawn.
    if (from.w <= 0.0 || to.w <= 0.0 || from.z > from.w || to.z > to.w) {
        pixel = vec2(0.0);
        ends = vec4(0.0);
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    ends = vec4(pixel_of(from), pixel_of(to));
    const vec2 line = ends.zw - ends.xy;
    const vec2 along = dot(line, line) > 1e-12 ? normalize(line) : vec2(1.0, 0.0);
    const vec2 corner = corner_of(gl_VertexIndex);
    const float reach = radius + 1.0;
    pixel = (corner.x < 0.0 ? ends.xy : ends.zw) +
            reach * (corner.x * along + corner.y * vec2(-along.y, along.x));
    const float depth = corner.x < 0.0 ? from.z / from.w : to.z / to.w;
    gl_Position = vec4(pixel / (cloud.guard * cloud.half_extent), depth, 1.0);
}
