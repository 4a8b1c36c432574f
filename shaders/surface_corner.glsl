#ifndef RIMLINE_SHADERS_SURFACE_CORNER_GLSL
#define RIMLINE_SHADERS_SURFACE_CORNER_GLSL

// The triangles of a mesh by vertex pulling: three vertices per face, each with its corner's normal.

#include "draw.glsl"
#include "project.glsl"

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
// If the light grazes the face, the lit side by the face's bit: 1 front, 2 back. A surface seen from
// the other side is in its own shadow. The stencil is unreliable here, because the sides of the face's
// own volume lie in the surface and rounding decides which is in front. Otherwise 0: then the stencil
// is more reliable, because at a silhouette the hidden back of a surface can win a pixel at its edge.
// Shaders of colored meshes add RIMLINE_UNPAINTED for a face without a material.
layout(location = 2) flat out uint grazed_side;

const float k_grazing = 1e-3;  // Sine of the angle between light and face.

precise gl_Position;

uint side_grazed(uint face, TriangleRecord triangle) {
    const vec3 corner = instance.positions.at[triangle.v0];
    const vec3 across = cross(instance.positions.at[triangle.v1] - corner,
                              instance.positions.at[triangle.v2] - corner);
    const vec4 light_point = light.point;
    const vec3 to_light = light_point.xyz - light_point.w * corner;
    if (abs(dot(across, to_light)) > k_grazing * length(across) * length(to_light)) return 0u;
    return 2u - (light.face_words.at[face / 32u] >> (face % 32u) & 1u);
}

// Writes the outputs of corner `number` of all corners.
void write_corner(uint number) {
    const uint face = number / 3u;
    const uint corner = number % 3u;
    const TriangleRecord triangle = instance.triangles.at[face];
    const uint vertex = corner == 0u ? triangle.v0 : corner == 1u ? triangle.v1 : triangle.v2;
    grazed_side = draw.choice == 1u ? side_grazed(face, triangle) : 0u;
    position = instance.positions.at[vertex];
    normal = instance.corner_normals.at[number];
    gl_Position = clip_from_object(position);
}

#endif
