#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_color.glsl"
#include "surface_corner.glsl"

// Surfaces in the colors of the mesh, with textures. A draw is of faces with one texture.

layout(location = 3) out vec3 surface_color;
layout(location = 4) out vec2 uv;
layout(location = 5) out vec2 center_uv;

void main() {
    const uint number =
        3u * instance.textured_faces.at[gl_VertexIndex / 3u] + gl_VertexIndex % 3u;
    write_corner(number);
    grazed_side |= unpainted(number);
    surface_color = color_of_corner(number);
    uv = instance.corner_uvs.at[number];
    center_uv = uv;
}
