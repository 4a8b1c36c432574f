#ifndef RIMLINE_SHADERS_BACKDROP_GLSL
#define RIMLINE_SHADERS_BACKDROP_GLSL

// The depth of a backdrop as the surface pass has it (engine/passes/backdrop_pass.h), and the opacity of the
// shadow on it. The same code writes depth and compares with it, so everything is `precise`.

#extension GL_EXT_scalar_block_layout : require

layout(push_constant, scalar) uniform Constants {
    float map_scale;
    float map_offset;
    float far;
    float relative_slack;
    float absolute_slack;
    float opacity;
    ivec2 corner;
};

layout(location = 0) out vec4 color;

void write_backdrop(float depth) {
    if (depth == far) discard;
    precise float mapped = depth * map_scale + map_offset;
    precise float farther = mapped - mapped * relative_slack - absolute_slack;
    gl_FragDepth = clamp(farther, 0.0, 1.0);
    color = vec4(0.0, 0.0, 0.0, opacity);
}

#endif
