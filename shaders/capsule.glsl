#ifndef RIMLINE_SHADERS_CAPSULE_GLSL
#define RIMLINE_SHADERS_CAPSULE_GLSL

// Converts an edge to a capsule on the screen: its projected segment, widened by the line's radius. All line
// paths make their capsules here, and line.frag computes ink from these values only, so all paths give the
// same pixels. Quads of different stages may be rasterized with different rounding, but ink ends an eighth of
// a pixel inside them. For the same reason, all computations are `precise`.

#include "draw.glsl"
#include "line_edge.glsl"
#include "project.glsl"

struct Capsule {
    vec4 ends;    // Start and end, in pixels.
    vec2 depths;  // Depths at both ends. Linear on the screen between them.
    // Unit vector across the line, away from its faces. If faces are on both sides, two_sided is 1 and
    // this is one of the two directions.
    vec2 outwards;
    float two_sided;
    vec2 dashes;  // Positions of both ends in the dash pattern, in pixels.
};

// The inputs of line.frag: ends; depths and outwards; dashes and two_sided.
#define RIMLINE_CAPSULE_VARYINGS(direction)              \
    layout(location = 0) flat direction vec4 ends;       \
    layout(location = 1) flat direction vec4 depths_out; \
    layout(location = 2) flat direction vec3 pattern;

// Clips [begin, end] of a segment to the part where a value that goes linearly from `a` to `b` is >= 0.
void clip(float a, float b, inout float begin, inout float end) {
    if (a < 0.0 && b < 0.0) end = -1.0;
    else if (a < 0.0) begin = max(begin, a / (a - b));
    else if (b < 0.0) end = min(end, a / (a - b));
}

vec3 from_camera(uint vertex) {
    precise vec3 position = instance.positions.at[vertex] - instance.camera;
    return eye_from_object(position);
}

vec2 pixel_of(vec2 ndc) {
    precise vec2 pixel = (ndc * (0.5 * frame.guard) + 0.5) * frame.extent;
    return pixel;
}

// The signed distance on the screen, along `across`, of a corner from the line through `from`.
float side_of(vec3 eye_corner, vec2 from, vec2 across) {
    const vec4 clip = clip_from_eye(eye_corner, 1.0);
    if (clip.w <= 0.0) return 0.0;
    precise vec2 away = pixel_of(clip.xy / clip.w) - from;
    precise float side = away.x * across.x + away.y * across.y;
    return side;
}

// The direction along which dash positions are measured. Lines are not chained, so each edge computes its own
// position in the pattern: the distance of its ends from a fixed point, measured along the nearest of four
// fixed directions. Within a sector of 45 degrees it depends only on the position, so dashes of consecutive
// edges join, for any tessellation. Dashes are at most 8% too long. One dash is irregular where a line enters
// the next sector. The silhouette of a fine mesh is a zigzag around the true contour, so the direction is
// perpendicular to the surface's normal.
vec2 dash_direction(vec3 a, vec3 b, vec3 corner_0, vec3 corner_1, bool has_normals, vec2 along) {
    vec2 direction = along;
    if (has_normals) {
        const vec3 normal_0 = cross(b - a, corner_0 - a);
        const vec3 normal_1 = cross(corner_1 - a, b - a);
        const vec3 sum = normal_0 + normal_1;
        const vec2 normal = sum.xy * sign(frame.clip_scale);
        const float bend = dot(normal_0, normal_1);
        // Not if the faces meet at a sharp edge, or the normal points to the viewer.
        if (bend > 0.76 * length(normal_0) * length(normal_1) && length(normal) > 0.5 * length(sum))
            direction = vec2(-normal.y, normal.x);
    }
    const float k_quarter = 0.785398163397448;
    const float angle = round(atan(direction.y, direction.x) / k_quarter) * k_quarter;
    // A line has no orientation. Of the two opposite directions, choose the one to the right, or else down.
    const vec2 counted = vec2(cos(angle), sin(angle));
    return counted.x < -1e-3 || (abs(counted.x) < 1e-3 && counted.y < 0.0) ? -counted : counted;
}

// Returns false if no part of the edge is in the picture.
bool make_capsule(LineEdge edge, out Capsule capsule) {
    // Start at the lower vertex number, so that the result does not depend on the face.
    if (edge.v0 > edge.v1) edge = LineEdge(edge.v1, edge.v0, edge.corner_1, edge.corner_0);
    const vec3 eye_a = from_camera(edge.v0);
    const vec3 eye_b = from_camera(edge.v1);
    const vec4 a = clip_from_eye(eye_a, 1.0);
    const vec4 b = clip_from_eye(eye_b, 1.0);

    // Clips to the near plane, and to the picture widened by the line's width.
    const float radius = frame.line_radius + RIMLINE_INK_REACH;
    precise vec2 reach = (1.0 + 2.0 * radius / frame.extent) / frame.guard;
    precise float begin = 0.0;
    precise float end = 1.0;
    clip(a.w - a.z, b.w - b.z, begin, end);
    clip(reach.x * a.w - a.x, reach.x * b.w - b.x, begin, end);
    clip(reach.x * a.w + a.x, reach.x * b.w + b.x, begin, end);
    clip(reach.y * a.w - a.y, reach.y * b.w - b.y, begin, end);
    clip(reach.y * a.w + a.y, reach.y * b.w + b.y, begin, end);
    if (begin > end) return false;
    precise vec4 clipped_a = begin == 0.0 ? a : a + (b - a) * begin;
    precise vec4 clipped_b = end == 1.0 ? b : a + (b - a) * end;
    if (clipped_a.w <= 0.0 || clipped_b.w <= 0.0) return false;

    precise vec3 ndc_a = clipped_a.xyz / clipped_a.w;
    precise vec3 ndc_b = clipped_b.xyz / clipped_b.w;
    const vec2 p = pixel_of(ndc_a.xy);
    const vec2 q = pixel_of(ndc_b.xy);
    precise vec2 span = q - p;
    precise float len = sqrt(span.x * span.x + span.y * span.y);
    precise vec2 along = len > 1e-6 ? span / len : vec2(1.0, 0.0);
    const vec2 across = vec2(-along.y, along.x);
    // Both faces of a silhouette lie on one side. The wider one decides it more reliably.
    const bool has_0 = edge.corner_0 != k_no_corner;
    const bool has_1 = edge.corner_1 != k_no_corner;
    const vec3 eye_0 = has_0 ? from_camera(edge.corner_0) : eye_a;
    const vec3 eye_1 = has_1 ? from_camera(edge.corner_1) : eye_a;
    const float side_0 = has_0 ? side_of(eye_0, p, across) : 0.0;
    const float side_1 = has_1 ? side_of(eye_1, p, across) : 0.0;
    const float side = abs(side_1) > abs(side_0) ? side_1 : side_0;

    capsule.ends = vec4(p, q);
    capsule.depths = vec2(ndc_a.z, ndc_b.z);
    capsule.outwards = side > 0.0 ? -across : across;
    const bool may_be_two_sided =
        draw.choice == RIMLINE_LINES_CREASE || frame.frozen_lines != 0u;
    capsule.two_sided = may_be_two_sided && side_0 * side_1 < 0.0 ? 1.0 : 0.0;
    capsule.dashes = vec2(0.0);
    if (frame.dash_period > 0.0) {
        const bool is_contour = has_0 && has_1 && draw.choice != RIMLINE_LINES_CREASE;
        const vec2 counted = dash_direction(eye_a, eye_b, eye_0, eye_1, is_contour, along);
        // Measured from the center of the mesh, so that dashes move with the mesh.
        const vec4 center = clip_from_object(instance.center);
        const vec2 anchor = center.w > 0.0 ? pixel_of(center.xy / center.w) : vec2(0.0);
        capsule.dashes = vec2(dot(p - anchor, counted), dot(q - anchor, counted));
    }
    return true;
}

// Corner 0 to 3, in triangle strip order, of a quad around the capsule and the edge of its ink.
vec4 capsule_corner(vec4 ends, uint corner) {
    const vec2 p = ends.xy;
    const vec2 q = ends.zw;
    const float radius = frame.line_radius + RIMLINE_INK_REACH;
    const float len = distance(p, q);
    const vec2 along = (len > 1e-6 ? (q - p) / len : vec2(1.0, 0.0)) * radius;
    const vec2 across = vec2(-along.y, along.x) * ((corner & 1u) == 0u ? 1.0 : -1.0);
    const vec2 place = corner < 2u ? p - along + across : q + along + across;
    return vec4((place / frame.extent * 2.0 - 1.0) / frame.guard, 0.5, 1.0);
}

#endif
