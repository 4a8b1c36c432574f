#version 460

// Discards pixels of the rectangle outside the line's width.

layout(location = 0) in vec2 pixel;
layout(location = 1) flat in vec4 ends;
layout(location = 2) flat in float radius;
layout(location = 3) flat in vec3 color;

layout(location = 0) out vec4 result;

void main() {
    const vec2 line = ends.zw - ends.xy;
    const vec2 from = pixel - ends.xy;
    const float along = clamp(dot(from, line) / max(dot(line, line), 1e-12), 0.0, 1.0);
    const vec2 away = from - along * line;
    if (dot(away, away) > radius * radius) discard;
    result = vec4(color, 0.0);
}
