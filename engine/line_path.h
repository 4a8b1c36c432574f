#pragma once

// The ways from edges to line capsules. All make the same capsules (shaders/capsule.glsl) and so the same
// pixels; they differ in what the GPU has to look at. The first two draw the streamed slots, which hold
// the silhouette and nothing else. The others are what is done without such a list, kept to compare with:
// they look at the whole mesh in every frame, and need no tracker and no stream for the camera.

#include <cstdint>

namespace rimline {

enum class LinePath : std::uint8_t {
    geometry,   ///< A geometry shader on the slots, a point each.
    pulling,    ///< A vertex shader on the slots, an instance of four vertices each.
    all_edges,  ///< A geometry shader on every edge, which tests it by the planes of its faces.
    quads,      ///< A vertex shader on every edge, likewise (Card and Mitchell 2002).
    adjacency,  ///< A geometry shader on every face with its neighbors, which tests their corners.
};

constexpr bool draws_slots(LinePath path) noexcept {
    return path == LinePath::geometry || path == LinePath::pulling;
}
constexpr bool needs_geometry_shader(LinePath path) noexcept {
    return path != LinePath::pulling && path != LinePath::quads;
}

}  // namespace rimline
