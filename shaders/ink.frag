#version 460

// Ink, to be blended by the coverage that its lines left in the surfaces' alpha.

layout(push_constant) uniform Constants { vec3 ink; };  // Linear.

layout(location = 0) out vec4 color;

void main() {
    color = vec4(ink, 0.0);
}
