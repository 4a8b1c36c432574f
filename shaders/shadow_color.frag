#version 460

// Surfaces in the shadow of the only light, where the stencil test passes.

layout(set = 0, binding = 0) uniform sampler2D shadow_colors;

layout(location = 0) out vec4 color;

void main() { color = texelFetch(shadow_colors, ivec2(gl_FragCoord.xy), 0); }
