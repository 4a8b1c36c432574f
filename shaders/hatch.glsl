#ifndef RIMLINE_SHADERS_HATCH_GLSL
#define RIMLINE_SHADERS_HATCH_GLSL

// Pen strokes in which a tone lies. Strokes are where parallel planes, fixed to the object, cut its
// surface: they run around its forms like contours and move with it, not with the screen. So that they
// are equally dense everywhere on the screen, distances between planes are powers of two, and towards
// the next level every other stroke grows thin and goes (the nesting of tonal art maps: Praun, Hoppe,
// Webb, Finkelstein, Real-Time Hatching, 2001, here without maps). Widths make up for it: the share of
// the surface that is inked is the tone's at every level.
//
//     period p:   |     .     |     .     |     .     |        . strokes of odd number, thinner towards
//     period 2p:  |           |           |           |          the next level
//
// Darker than one layer can be, a second crosses the first.

#include "draw.glsl"

float random_of(float value) {
    uint bits = floatBitsToUint(value);
    bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
    return float((bits ^ (bits >> 16u)) >> 8u) / 16777216.0;
}

// How far the surface goes on for each pixel to the right and up, in the mesh's coordinates. From its
// smooth normal, not by differences of neighboring pixels: strokes must not show the triangles.
void surface_steps(vec3 position, vec3 normal, out vec3 right_step, out vec3 up_step) {
    const mat3 axes = transpose(instance.eye_from_object);
    const vec3 from_camera = position - instance.camera;
    const vec2 clip_w = frame.clip_w;
    const float w = clip_w.x * dot(axes[2], from_camera) + clip_w.y;
    const vec3 ray = clip_w.x == 0.0 ? -axes[2] : normalize(from_camera);
    const float pixel = 2.0 * w / (abs(frame.clip_scale.x) * frame.guard *
                                   frame.extent.x);
    const float facing = min(dot(normal, ray), -0.12);
    right_step = pixel * (axes[0] - ray * (dot(normal, axes[0]) / facing));
    up_step = pixel * (axes[1] - ray * (dot(normal, axes[1]) / facing));
}

// A place on a surface, in the mesh's coordinates.
struct HatchedPlace {
    vec3 from_middle;
    vec3 normal;
    vec3 right_step;
    vec3 up_step;
};

// How fast one passes the planes across `direction`, each pixel to the right and up.
vec2 passing(vec3 direction, HatchedPlace place) {
    return vec2(dot(direction, place.right_step), dot(direction, place.up_step));
}

// Ink of the planes across `direction` where a share `density` of the surface is to be inked.
float strokes_ink(vec3 direction, float density, HatchedPlace place) {
    const float spacing = frame.hatch_spacing;
    const float along = dot(direction, place.from_middle);
    const float gradient = length(passing(direction, place));
    const float level = log2(spacing * gradient);
    const float period = exp2(floor(level));
    const float between = fract(level);
    const float odd_share = 1.0 - between;
    const float number = round(along / period);
    // Of the stroke itself, whichever level it is seen at.
    const float own = random_of(number * period);
    const float share = mod(number, 2.0) == 0.0 ? 1.0 : odd_share;
    const float pixels = period / gradient;  // From stroke to stroke.
    const float width = share * (0.8 + 0.4 * own) * 2.0 * density * pixels / (1.0 + odd_share);
    const float away = abs(along / period - number + 0.16 * (own - 0.5)) * pixels;
    return min(clamp(0.5 * width + 0.5 - away, 0.0, 1.0), width);
}

// One layer: planes across `direction`, of which a share `replaced` gives way to those across `other`.
float layer_ink(vec3 direction, vec3 other, float replaced, float density, HatchedPlace place) {
    float ink = 0.0;
    if (replaced < 1.0) ink = strokes_ink(direction, (1.0 - replaced) * density, place);
    if (replaced > 0.0) ink = max(ink, strokes_ink(other, replaced * density, place));
    return ink;
}

// How much planes across `direction` run along the surface: they would cut it in no clear strokes.
float flatness(vec3 direction, HatchedPlace place) {
    return smoothstep(0.80, 0.92, abs(dot(direction, place.normal)));
}

// How much the strokes of two directions run alike on the screen: 1 where they do, 0 at right angles.
float alikeness(vec3 a, vec3 b, HatchedPlace place) {
    const vec2 over_a = passing(a, place);
    const vec2 over_b = passing(b, place);
    return abs(dot(over_a, over_b)) / max(length(over_a) * length(over_b), 1e-30);
}

// The ink at a place of a surface of which a share `density` is to be inked. `normal` is of length 1 and
// faces the viewer; both in the mesh's coordinates.
float hatch_ink(vec3 position, vec3 normal, float density) {
    const float k_least = 0.02;    // Thinner strokes are left out,
    const float k_single = 0.26;   // and denser ones crossed.
    if (density < k_least) return 0.0;
    // Oblique to all axes, for along them models have their planes.
    const vec3 k_first = vec3(0.5345, 0.8018, 0.2673);
    const vec3 k_second = vec3(-0.7807, 0.4880, 0.3904);
    const vec3 k_third = vec3(0.3554, -0.4443, 0.8224);
    HatchedPlace place;
    place.from_middle = position - instance.center;
    place.normal = normal;
    surface_steps(position, normal, place.right_step, place.up_step);
    const float first = density < k_single ? density : k_single + 0.5 * (density - k_single);
    const float second = 1.0 - (1.0 - density) / (1.0 - first);
    const float first_replaced = flatness(k_first, place);
    float paper = 1.0 - layer_ink(k_first, k_third, first_replaced, first, place);
    if (second >= k_least) {
        // Strokes must cross those of the first layer: along them they would only blur them.
        const float along = alikeness(k_first, k_second, place);
        const float other_along = alikeness(k_first, k_third, place);
        const float blurred = smoothstep(0.6, 0.8, along) * smoothstep(0.0, 0.2, along - other_along);
        const float replaced = (1.0 - first_replaced) * max(flatness(k_second, place), blurred);
        paper *= 1.0 - layer_ink(k_second, k_third, replaced, second, place);
    }
    return 1.0 - paper;
}

#endif
