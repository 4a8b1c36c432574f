#version 460
#extension GL_GOOGLE_include_directive : require
#include "field_job.h"

// The tangential distance field at many points (engine/measure/field_pass.h). A column of workgroups computes
// some points, and each row a chunk of planes. An invocation evaluates one plane at a time for all points of
// its group, so that each piece of the function is read only once for them.

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Constants { FieldJob job; };

shared float lane_sums[k_field_group_points][k_field_tile];
shared float part_sums[k_field_group_points][8];

void main() {
    const uint lane = gl_LocalInvocationID.x;
    const uint first_point = gl_WorkGroupID.x * k_field_group_points;
    const uint chunk = job.first_chunk + gl_WorkGroupID.y;
    const uint last_tile = min((chunk + 1u) * k_field_chunk_tiles, job.tile_count);

    vec3 points[k_field_group_points];
    float sums[k_field_group_points];
    for (uint i = 0u; i < k_field_group_points; ++i) {
        points[i] = job.points.at[min(first_point + i, job.point_count - 1u)];
        sums[i] = 0.0;
    }
    for (uint tile = chunk * k_field_chunk_tiles; tile < last_tile; ++tile) {
        const FieldPlane plane = job.planes.at[tile * k_field_tile + lane];
        float distances[k_field_group_points];
        FieldPiece pieces[k_field_group_points];
        const FieldPiece outer = job.pieces.at[0];
        for (uint i = 0u; i < k_field_group_points; ++i) {
            distances[i] = dot(plane.normal, points[i]) - plane.offset;
            pieces[i] = outer;
        }
        for (uint number = 1u; number < job.piece_count; ++number) {
            const FieldPiece piece = job.pieces.at[number];
            for (uint i = 0u; i < k_field_group_points; ++i)
                if (distances[i] >= piece.from) pieces[i] = piece;
        }
        for (uint i = 0u; i < k_field_group_points; ++i) {
            const FieldPiece piece = pieces[i];
            const float t = distances[i] - piece.start;
            sums[i] += plane.weight * (((piece.c3 * t + piece.c2) * t + piece.c1) * t + piece.c0);
        }
    }

    for (uint i = 0u; i < k_field_group_points; ++i) lane_sums[i][lane] = sums[i];
    barrier();
    float part = 0.0;
    for (uint i = 0u; i < 8u; ++i) part += lane_sums[lane / 8u][lane % 8u + 8u * i];
    part_sums[lane / 8u][lane % 8u] = part;
    barrier();
    if (lane >= k_field_group_points || first_point + lane >= job.point_count) return;
    float sum = 0.0;
    for (uint i = 0u; i < 8u; ++i) sum += part_sums[lane][i];
    job.sums.at[chunk * job.point_count + first_point + lane] = sum;
}
