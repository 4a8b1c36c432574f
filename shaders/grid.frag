#version 460

// The paper's grid, blended over the surfaces by alpha. Lines are one picture pixel wide. One line goes
// through the center, and every fifth line has full strength.

layout(push_constant) uniform Constants {
    vec4 grid;   // Linear. Alpha is the strength of every fifth line.
    ivec2 size;  // Of the picture, in its pixels.
    int scale;   // Surface pixels per picture pixel, along each axis.
};

layout(location = 0) out vec4 color;

const int k_grid_px = 16;

void main() {
    const ivec2 from_center = abs(ivec2(gl_FragCoord.xy) / scale - size / 2);
    if (!any(equal(from_center % k_grid_px, ivec2(0)))) discard;
    const bool is_fifth = any(equal(from_center % (5 * k_grid_px), ivec2(0)));
    color = vec4(grid.rgb, is_fifth ? grid.a : 0.45 * grid.a);
}
