#version 460

// Discards pixels outside the disc, and pixels removed by its cuts.

layout(location = 0) in vec2 place;
layout(location = 1) flat in vec3 color;
layout(location = 2) flat in vec4 cuts;
layout(location = 3) flat in vec3 rest;

layout(location = 0) out vec4 result;
// Depth 0 is far, and rest.z is not negative. So the depth test may come before the shader.
layout(depth_less) out float gl_FragDepth;

void main() {
    if (dot(place, place) > 1.0 || dot(place, cuts.xy) < 0.0 || dot(place, cuts.zw) < 0.0 ||
        dot(place, rest.xy) < 0.0)
        discard;
    result = vec4(color, 0.0);
    gl_FragDepth = clamp(gl_FragCoord.z - rest.z * length(place), 0.0, 1.0);
}
