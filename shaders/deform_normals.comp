#version 460
#extension GL_GOOGLE_include_directive : require
#include "deform_job.h"

// Shading normals from current positions. Each group of corners (silhouette/mesh/corner_normals.h)
// gets the mean of its faces' normals, weighted by their angles at the vertex.

layout(local_size_x = RIMLINE_DEFORM_GROUP) in;

vec3 unit(vec3 v) {
    const float max_component = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return max_component > 0.0 ? normalize(v / max_component) : vec3(0.0);
}

vec3 corner_of(TriangleRecord t, uint corner) {
    return job.data.positions.at[corner == 0u ? t.v0 : corner == 1u ? t.v1 : t.v2];
}

// xyz: the normal of the corner's face, 0 if it has no area. w: the face's angle at the corner.
vec4 face_at(uint corner) {
    const TriangleRecord t = job.data.triangles.at[corner / 3u];
    const uint c = corner % 3u;
    const vec3 here = corner_of(t, c);
    const vec3 a = unit(corner_of(t, (c + 1u) % 3u) - here);
    const vec3 b = unit(corner_of(t, (c + 2u) % 3u) - here);
    const vec3 across = cross(a, b);
    const float sine = length(across);
    // The arc tangent of (0, 0), where corners coincide, is undefined.
    return vec4(unit(across), sine > 0.0 ? atan(sine, dot(a, b)) : 0.0);
}

void main() {
    const uint group = invocation_index();
    if (group >= job.data.group_count) return;
    const uint begin = job.data.group_begin.at[group];
    const uint end = job.data.group_begin.at[group + 1u];
    vec3 sum = vec3(0.0);
    for (uint i = begin; i < end; ++i) {
        const vec4 face = face_at(job.data.group_corners.at[i]);
        sum += face.w * face.xyz;
    }
    // If the normals cancel, each corner gets its face's own normal.
    const bool cancels = dot(sum, sum) < 1e-12;
    const vec3 shared_normal = cancels ? vec3(0.0, 1.0, 0.0) : normalize(sum);
    for (uint i = begin; i < end; ++i) {
        const uint corner = job.data.group_corners.at[i];
        vec3 normal = shared_normal;
        if (cancels) {
            const vec3 own = face_at(corner).xyz;
            if (own != vec3(0.0)) normal = own;
        }
        job.data.corner_normals.at[corner] = normal;
    }
}
