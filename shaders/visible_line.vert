#version 460
#extension GL_GOOGLE_include_directive : require
#include "visible_ratio.glsl"

// Covers every pixel that a line passes through. The area swept by a pixel along the line is a hexagon,
// and a pixel counts if its center is inside. Uses triangles, because for Vulkan's lines the device
// chooses the pixels.
//
//     2 ---- 4 5        Six corners per line: 0 1 2 around its start, 3 4 5 around its end. The index
//     |  /    / |       buffer makes four triangles. The drawing shows a line to the right and up. For
//     0 1 ---- 3        other directions it is mirrored.

// Lines are drawn nearer by this share of their distance. A line in a surface must pass the depth test,
// although depth is rounded to 1 part in 2^24.
const float k_nearer = 1e-5;

precise gl_Position;

void main() {
    const LineEnds line = view.lines.at[gl_VertexIndex / 6];
    vec3 from = eye_from_vertex(line.from);
    vec3 to = eye_from_vertex(line.to);
    // Clips to the near plane, because points behind it have no position on the screen.
    const float from_distance = -from.z - view.near_distance;
    const float to_distance = -to.z - view.near_distance;
    if (from_distance < 0.0 && to_distance < 0.0) {
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    const vec3 crossing = mix(from, to, from_distance / (from_distance - to_distance));
    if (from_distance < 0.0) from = crossing;
    if (to_distance < 0.0) to = crossing;

    const vec4 clip_from = clip_from_eye(from);
    const vec4 clip_to = clip_from_eye(to);
    // The direction on the screen, as signs.
    const vec2 along = clip_to.xy / clip_to.w - clip_from.xy / clip_from.w;
    const vec2 direction = vec2(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0);

    const uint corner = uint(gl_VertexIndex) % 6u;
    const vec2 outward = corner == 0u                   ? -direction
                         : corner == 5u                 ? direction
                         : corner == 1u || corner == 3u ? vec2(direction.x, -direction.y)
                                                        : vec2(-direction.x, direction.y);
    precise vec4 clip = corner < 3u ? clip_from : clip_to;
    clip.xy += outward * (clip.w / view.side_px);  // Half a pixel.
    clip.z *= 1.0 + k_nearer;
    gl_Position = clip;
}
