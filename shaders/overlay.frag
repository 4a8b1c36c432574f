#version 460

// Blends sRGB values directly, because interface colors are designed for that.

layout(location = 0) in vec4 color;
layout(location = 1) in vec2 texture_place;
layout(location = 0) out vec4 over;

layout(set = 0, binding = 0) uniform sampler2D opacity;

void main() { over = vec4(color.rgb, color.a * textureLod(opacity, texture_place, 0.0).r); }
