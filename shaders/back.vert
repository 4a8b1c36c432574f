#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// The corners of back faces, moved on the screen along the normals of their vertices by the width of a line. Front
// faces get no area: their winding on the screen would not tell them after the move.

precise gl_Position;

void main() {
    const uint number = uint(gl_VertexIndex);
    const TriangleRecord triangle = instance.triangles.at[number / 3u];
    const vec3 a = instance.positions.at[triangle.v0];
    const vec3 b = instance.positions.at[triangle.v1];
    const vec3 c = instance.positions.at[triangle.v2];
    const vec4 viewpoint = instance.viewpoint;
    if (dot(cross(b - a, c - a), viewpoint.xyz - viewpoint.w * a) >= 0.0) {
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    const uint corner = number % 3u;
    vec4 clip = clip_from_object(corner == 0u ? a : corner == 1u ? b : c);
    const vec4 along = clip_from_eye(eye_from_object(instance.hull_normals.at[number]), 0.0);
    // The direction in which a point that moves along the normal starts on the screen.
    const vec2 motion = (along.xy * clip.w - clip.xy * along.w) * frame.extent;
    const float speed = length(motion);
    if (clip.w > 0.0 && speed > 0.0) {
        const vec2 ndc_per_pixel = 2.0 / (frame.extent * frame.guard);
        clip.xy += motion / speed * (2.0 * frame.line_radius) * ndc_per_pixel * clip.w;
    }
    gl_Position = clip;
}
