#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_corner.glsl"

// Surfaces in the colors of the mesh (silhouette/mesh/face_materials.h).

layout(location = 3) out vec3 surface_color;

void main() {
    write_corner();
    const uint material = instance.face_materials.at[gl_VertexIndex / 3u];
    surface_color = instance.color;
    if (material != k_no_material) {
        surface_color = instance.materials.at[material];
        if (instance.has_corner_colors != 0u)
            surface_color *= instance.corner_colors.at[gl_VertexIndex];
    }
}
