#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// An edge becomes a capsule on the screen: the segment it projects to, widened by the line's radius.
// draw.choice is 0 for the camera's silhouette slots, 1 for the mesh's borders.

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) flat out vec2 from_pixel;
layout(location = 1) flat out vec2 to_pixel;
layout(location = 2) flat out vec2 depths;  // At both ends; linear between them on the screen.
layout(location = 3) flat out vec2 outwards;  // Across the line, where its faces are not; of length 1.

// Narrows [begin, end] of a segment to where a value that runs from `a` to `b` along it is not negative.
void clip(float a, float b, inout float begin, inout float end) {
    if (a < 0.0 && b < 0.0) end = -1.0;
    else if (a < 0.0) begin = max(begin, a / (a - b));
    else if (b < 0.0) end = min(end, a / (a - b));
}

// How far to the left of the line from `from` along `across` a face's third corner lies on the screen.
float side_of(uint face, EdgeRecord edge, vec2 from, vec2 across) {
    const TriangleRecord triangle = draw.instance.data.triangles.at[face];
    uint corner = triangle.v0;
    if (corner == edge.v0 || corner == edge.v1) corner = triangle.v1;
    if (corner == edge.v0 || corner == edge.v1) corner = triangle.v2;
    const vec4 clip =
        clip_from_object(draw.frame, draw.instance, draw.instance.data.positions.at[corner]);
    if (clip.w <= 0.0) return 0.0;
    return dot((clip.xy / clip.w * 0.5 + 0.5) * draw.frame.data.viewport - from, across);
}

void main() {
    EdgeRecord edge;
    if (draw.choice == 0u)
        edge = draw.instance.data.edges.at[draw.instance.data.slots.at[gl_PrimitiveIDIn]];
    else
        edge = draw.instance.data.borders.at[gl_PrimitiveIDIn];
    const vec4 a = clip_from_object(draw.frame, draw.instance, draw.instance.data.positions.at[edge.v0]);
    const vec4 b = clip_from_object(draw.frame, draw.instance, draw.instance.data.positions.at[edge.v1]);

    // In front of the near plane, and not farther outside the picture than a line is wide.
    const vec2 viewport = draw.frame.data.viewport;
    const float radius = draw.frame.data.line_radius + 1.0;
    const vec2 guard = 1.0 + 2.0 * radius / viewport;
    float begin = 0.0;
    float end = 1.0;
    clip(a.w - a.z, b.w - b.z, begin, end);
    clip(guard.x * a.w - a.x, guard.x * b.w - b.x, begin, end);
    clip(guard.x * a.w + a.x, guard.x * b.w + b.x, begin, end);
    clip(guard.y * a.w - a.y, guard.y * b.w - b.y, begin, end);
    clip(guard.y * a.w + a.y, guard.y * b.w + b.y, begin, end);
    if (begin > end) return;
    const vec4 clipped_a = begin == 0.0 ? a : mix(a, b, begin);
    const vec4 clipped_b = end == 1.0 ? b : mix(a, b, end);
    if (clipped_a.w <= 0.0 || clipped_b.w <= 0.0) return;

    const vec3 ndc_a = clipped_a.xyz / clipped_a.w;
    const vec3 ndc_b = clipped_b.xyz / clipped_b.w;
    const vec2 p = (ndc_a.xy * 0.5 + 0.5) * viewport;
    const vec2 q = (ndc_b.xy * 0.5 + 0.5) * viewport;
    const float len = distance(p, q);
    const vec2 along = (len > 1e-6 ? (q - p) / len : vec2(1.0, 0.0)) * radius;
    const vec2 across = vec2(-along.y, along.x);
    // Both faces of a silhouette lie to one side; the wider one tells it more surely.
    float side = side_of(edge.f0, edge, p, across);
    if (edge.f1 != k_no_face) {
        const float other = side_of(edge.f1, edge, p, across);
        if (abs(other) > abs(side)) side = other;
    }
    const vec2 outside = (side > 0.0 ? -across : across) / radius;
    const vec2 corners[4] =
        vec2[4](p - along + across, p - along - across, q + along + across, q + along - across);
    for (int i = 0; i < 4; ++i) {
        from_pixel = p;
        to_pixel = q;
        depths = vec2(ndc_a.z, ndc_b.z);
        outwards = outside;
        gl_Position = vec4(corners[i] / viewport * 2.0 - 1.0, 0.5, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
