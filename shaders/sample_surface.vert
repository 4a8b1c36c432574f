#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

// A renderer that exists already (tools/samples/foreign_renderer.h) draws triangles in one color. It shares
// nothing with Rimline's shaders.

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners { vec3 at[]; };

layout(push_constant, scalar) uniform Constants {
    mat4 clip_from_world;
    vec4 color;
    Corners corners;  // Three for each triangle.
};

void main() { gl_Position = clip_from_world * vec4(corners.at[gl_VertexIndex], 1.0); }
