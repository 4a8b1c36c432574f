#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_color.glsl"
#include "surface_corner.glsl"

// Surfaces in the colors of the mesh.

layout(location = 3) out vec3 surface_color;

void main() {
    write_corner(gl_VertexIndex);
    grazed_side |= unpainted(gl_VertexIndex);
    surface_color = color_of_corner(gl_VertexIndex);
}
