#pragma once

// A mesh prepared for line drawings: what all cameras share.
//
// It holds the stars of vertices, a tree over faces, the places where faces pass through each other, and the
// angles of edges: about 150 bytes a face.

#include <cstdint>
#include <memory>

#include "silhouette/error.h"

namespace rimline {

class LineGeometry;
class Mesh;

/// Immutable: any number of drawers may share one, across threads.
class LineSurface {
public:
    enum class Contacts : std::uint8_t {
        found,  ///< Where faces pass through each other is searched for.
        none,   ///< They do not: is_solid(mesh) (silhouette/mesh/solid.h).
    };
    /// `mesh` must outlive it, and be welded (Mesh::is_welded()): faces that meet at a place must share its vertex.
    /// O(n log n + pairs of faces whose boxes meet) on all threads of oneTBB, 0.2 microseconds a face on two. The pairs
    /// are few where faces are about as long as wide. At a vertex all boxes of its faces meet: a fan of n faces has
    /// n^2 / 2 pairs, and sheets in one plane have as many. With Contacts::none pairs are not searched. The result does
    /// not depend on the number of threads. Throws Error{cancelled}, also among the pairs.
    explicit LineSurface(const Mesh& mesh, Contacts contacts = Contacts::found,
                         const LongCall& call = {});
    LineSurface(Mesh&&, Contacts = Contacts::found, const LongCall& = {}) = delete;
    ~LineSurface();
    LineSurface(LineSurface&&) noexcept;
    LineSurface& operator=(LineSurface&&) noexcept;

    const Mesh& mesh() const noexcept;
    /// For LineDrawer.
    const LineGeometry& geometry() const noexcept { return *geometry_; }

private:
    std::unique_ptr<const LineGeometry> geometry_;
};

}  // namespace rimline
