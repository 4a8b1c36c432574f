#version 460

// Ink, blended with the line coverage in the surfaces' alpha.

layout(push_constant) uniform Constants { vec3 ink; };  // Linear.

layout(location = 0) out vec4 color;

void main() {
    color = vec4(ink, 0.0);
}
