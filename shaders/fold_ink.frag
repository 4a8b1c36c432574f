#version 460

// Ink by the coverage of lines in an image of its own, premultiplied: for surfaces whose alpha is opacity.

layout(set = 0, binding = 0) uniform sampler2D coverage;

layout(push_constant) uniform Constants { vec3 ink; };  // Linear.

layout(location = 0) out vec4 color;

void main() {
    const float covered = texelFetch(coverage, ivec2(gl_FragCoord.xy), 0).a;
    color = vec4(ink * covered, covered);
}
