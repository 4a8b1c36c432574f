#ifndef RIMLINE_SHADERS_HATCH_GLSL
#define RIMLINE_SHADERS_HATCH_GLSL

// Pen strokes that show a tone. Strokes are intersections of the surface with parallel planes that are
// fixed to the object. They follow the shape like contours, and move with the object. The plane
// distances are powers of two, so that strokes have about the same density everywhere on the screen.
// Towards the next level every second stroke becomes thinner until it disappears (the nesting of tonal
// art maps: Praun, Hoppe, Webb, Finkelstein, Real-Time Hatching, 2001, here without maps). Other strokes
// become wider, so the inked share of the surface equals the tone's density at every level.
//
//     period p:   |     .     |     .     |     .     |        . strokes of odd number, thinner towards
//     period 2p:  |           |           |           |          the next level
//
// For tones too dark for one layer, a second layer crosses the first.

#include "draw.glsl"

float random_of(float value) {
    uint bits = value == 0.0 ? 0u : floatBitsToUint(value);  // -0.0, too.
    bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
    return float((bits ^ (bits >> 16u)) >> 8u) / 16777216.0;
}

// The steps along the surface per pixel to the right and up, in the mesh's coordinates. They use the
// smooth normal, not differences between pixels, because strokes must not show the triangles.
void surface_steps(vec3 position, vec3 normal, out vec3 right_step, out vec3 up_step) {
    const mat3 scaled_axes = transpose(instance.eye_from_object);
    const vec3 from_camera = position - instance.camera;
    const vec2 clip_w = frame.clip_w;
    const float w = clip_w.x * dot(scaled_axes[2], from_camera) + clip_w.y;
    const mat3 axes = instance.inverse_scale * scaled_axes;
    const vec3 ray = clip_w.x == 0.0 ? -axes[2] : normalize(from_camera);
    const float pixel = instance.inverse_scale * 2.0 * w /
                        (abs(frame.clip_scale.x) * frame.guard * frame.extent.x);
    const float facing = min(dot(normal, ray), -0.12);
    right_step = pixel * (axes[0] - ray * (dot(normal, axes[0]) / facing));
    up_step = pixel * (axes[1] - ray * (dot(normal, axes[1]) / facing));
}

// A point on a surface, in the mesh's coordinates.
struct HatchedPlace {
    vec3 from_center;
    vec3 normal;
    vec3 right_step;
    vec3 up_step;
};

// The distance moved along `direction`, perpendicular to the planes, per pixel to the right and up.
vec2 passing(vec3 direction, HatchedPlace place) {
    return vec2(dot(direction, place.right_step), dot(direction, place.up_step));
}

// Ink of the planes perpendicular to `direction`. `density` is the share of the surface to ink.
float strokes_ink(vec3 direction, float density, HatchedPlace place) {
    const float spacing = frame.hatch_spacing;
    const float along = dot(direction, place.from_center);
    const float gradient = max(length(passing(direction, place)), 1e-30);
    const float level = log2(spacing * gradient);
    const float period = ldexp(1.0, int(floor(level)));  // exp2() may round.
    const float between = fract(level);
    const float odd_share = 1.0 - between;
    const float number = round(along / period);
    // Random number of this stroke, equal on all levels.
    const float own = random_of(number * period);
    const float share = mod(number, 2.0) == 0.0 ? 1.0 : odd_share;
    const float pixels = period / gradient;  // Distance between strokes.
    const float width = share * (0.8 + 0.4 * own) * 2.0 * density * pixels / (1.0 + odd_share);
    const float away = abs(along / period - number + 0.16 * (own - 0.5)) * pixels;
    return min(clamp(0.5 * width + 0.5 - away, 0.0, 1.0), width);
}

// One layer: planes perpendicular to `direction`. A share `replaced` is replaced by planes perpendicular
// to `other`.
float layer_ink(vec3 direction, vec3 other, float replaced, float density, HatchedPlace place) {
    float ink = 0.0;
    if (replaced < 1.0) ink = strokes_ink(direction, (1.0 - replaced) * density, place);
    if (replaced > 0.0) ink = max(ink, strokes_ink(other, replaced * density, place));
    return ink;
}

// How nearly the planes perpendicular to `direction` are parallel to the surface. They would then cut it
// in unclear strokes.
float flatness(vec3 direction, HatchedPlace place) {
    return smoothstep(0.80, 0.92, abs(dot(direction, place.normal)));
}

// How parallel the strokes of two directions are on the screen: 1 if parallel, 0 if perpendicular.
float alikeness(vec3 a, vec3 b, HatchedPlace place) {
    const vec2 over_a = passing(a, place);
    const vec2 over_b = passing(b, place);
    return abs(dot(over_a, over_b)) / max(length(over_a) * length(over_b), 1e-30);
}

// The ink at a point of a surface. `density` is the share to ink. `normal` is a unit vector that faces
// the viewer. Position and normal are in the mesh's coordinates.
float hatch_ink(vec3 position, vec3 normal, float density) {
    const float k_min_density = 0.02;  // Lower densities get no strokes.
    const float k_single = 0.26;       // Higher densities get a second layer.
    if (density < k_min_density) return 0.0;
    // Oblique to all axes, because planes of models are often axis-aligned.
    const vec3 k_first = vec3(0.5345, 0.8018, 0.2673);
    const vec3 k_second = vec3(-0.7807, 0.4880, 0.3904);
    const vec3 k_third = vec3(0.3554, -0.4443, 0.8224);
    HatchedPlace place;
    place.from_center = position - instance.center;
    place.normal = normal;
    surface_steps(position, normal, place.right_step, place.up_step);
    const float first = density < k_single ? density : k_single + 0.5 * (density - k_single);
    const float second = 1.0 - (1.0 - density) / (1.0 - first);
    const float first_replaced = flatness(k_first, place);
    float paper = 1.0 - layer_ink(k_first, k_third, first_replaced, first, place);
    if (second >= k_min_density) {
        // Strokes must cross those of the first layer. Parallel strokes would only blur them.
        const float along = alikeness(k_first, k_second, place);
        const float other_along = alikeness(k_first, k_third, place);
        const float blurred = smoothstep(0.6, 0.8, along) * smoothstep(0.0, 0.2, along - other_along);
        const float replaced = (1.0 - first_replaced) * max(flatness(k_second, place), blurred);
        paper *= 1.0 - layer_ink(k_second, k_third, replaced, second, place);
    }
    return 1.0 - paper;
}

#endif
