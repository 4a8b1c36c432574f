#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

// The color of sample_surface.vert.

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners { vec3 at[]; };

layout(push_constant, scalar) uniform Constants {
    mat4 clip_from_world;
    vec4 color;
    Corners corners;
};

layout(location = 0) out vec4 written;

void main() { written = color; }
