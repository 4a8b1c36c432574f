#version 460
#extension GL_GOOGLE_include_directive : require
#include "visible_ratio.glsl"

// Every pixel that a line passes through: whose middle is covered by a pixel moved along the line, which
// is a hexagon. Triangles rather than Vulkan's lines, whose pixels are the device's choice.
//
//     2 ---- 4 5        Six corners a line, 0 1 2 around its beginning, 3 4 5 around its end; the index
//     |  /    / |       buffer makes four triangles of them. Drawn is a line that runs to the right and
//     0 1 ---- 3        up; others turn the picture.

// How much nearer than it is a line is drawn, of its distance: it must win where it lies in a surface, and
// depth is rounded to a part in 2^24.
const float k_nearer = 1e-5;

precise gl_Position;

void main() {
    const LineEnds line = view.lines.at[gl_VertexIndex / 6];
    vec3 from = eye_from_vertex(line.from);
    vec3 to = eye_from_vertex(line.to);
    // In front of the near plane, where a line has a place on the screen.
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
    // Which way it runs on the screen, by signs.
    const vec2 along = clip_to.xy / clip_to.w - clip_from.xy / clip_from.w;
    const vec2 way = vec2(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0);

    const uint corner = uint(gl_VertexIndex) % 6u;
    const vec2 out_way = corner == 0u                   ? -way
                         : corner == 5u                 ? way
                         : corner == 1u || corner == 3u ? vec2(way.x, -way.y)
                                                        : vec2(-way.x, way.y);
    precise vec4 clip = corner < 3u ? clip_from : clip_to;
    clip.xy += out_way * (clip.w / view.side_px);  // Half a pixel.
    clip.z *= 1.0 + k_nearer;
    gl_Position = clip;
}
