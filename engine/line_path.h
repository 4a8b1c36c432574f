#pragma once

// The methods that make line capsules of edges. All make the same capsules (shaders/capsule.glsl) and thus
// the same pixels; they differ in the data that the GPU reads. The first two draw the streamed slots, which
// hold exactly the silhouette. The others are comparators, methods without such a list: they read the whole
// mesh in every frame, and need no tracker and no stream for the camera.

#include <cstdint>

namespace rimline {

enum class LinePath : std::uint8_t {
    automatic,  ///< Geometry or pulling, by the device (passes/line_path_choice.h).
    geometry,   ///< A geometry shader over the slots, one point for each.
    pulling,    ///< A vertex shader over the slots, an instance of four vertices for each.
    all_edges,  ///< A geometry shader over all edges; tests each by its faces' planes.
    quads,      ///< A vertex shader over all edges; same test (Card, Mitchell 2002).
    adjacency,  ///< A geometry shader over all faces and their neighbors; tests corners.
};

/// Automatic draws slots, and takes a path that needs no geometry shader where there is none.
constexpr bool draws_slots(LinePath path) noexcept {
    return path == LinePath::automatic || path == LinePath::geometry || path == LinePath::pulling;
}
constexpr bool needs_geometry_shader(LinePath path) noexcept {
    return path == LinePath::geometry || path == LinePath::all_edges || path == LinePath::adjacency;
}

}  // namespace rimline
