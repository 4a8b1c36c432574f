#ifndef RIMLINE_SHADERS_PAPER_GRID_GLSL
#define RIMLINE_SHADERS_PAPER_GRID_GLSL

const int k_grid_px = 16;

// How strong the paper's grid is at a pixel of a picture of `size`: lines a pixel wide, one of them through
// the middle, every fifth one of full `strength`.
float grid_at(ivec2 pixel, ivec2 size, float strength) {
    if (strength == 0.0) return 0.0;
    const ivec2 from_middle = abs(pixel - size / 2);
    if (any(equal(from_middle % (5 * k_grid_px), ivec2(0)))) return strength;
    return any(equal(from_middle % k_grid_px, ivec2(0))) ? 0.45 * strength : 0.0;
}

#endif
