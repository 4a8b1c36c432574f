#pragma once

// Where the index's margins decide: points that rounding puts on either side of planes.
//
// ProbePoints' points lie on planes as well as one rounding allows. Here they are then moved by a few
// units in the last place, lie on three planes at once, far out in a plane, at the ends of the range of
// coordinates, and the walk crosses the same plane by the least step there is, again and again.

#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline::tests {

/// An endless random mixture of ProbePoints and harder ones. The same for the same seed.
class HostilePoints {
public:
    HostilePoints(const Mesh& mesh, std::uint64_t seed) : mesh_(&mesh), probes_(mesh, seed) {}

    HomogeneousPoint next();
    /// `point` with each coordinate moved by up to `most` floats.
    HomogeneousPoint nudged(const HomogeneousPoint& point, std::uint32_t most);
    /// The point of a random face's plane that is nearest to `point`, rounded; for a direction, the
    /// nearest one within the plane.
    HomogeneousPoint onto_plane(const HomogeneousPoint& point);

    ProbePoints& probes() { return probes_; }

private:
    const Plane& random_plane();
    HomogeneousPoint on_three_planes();

    const Mesh* mesh_;
    ProbePoints probes_;
};

/// Moves of every kind that RandomWalk makes, and the least there are: to and fro across a plane.
class HostileWalk {
public:
    HostileWalk(const Mesh& mesh, std::uint64_t seed)
        : points_(mesh, seed), point_(points_.next()), previous_(point_), home_(points_.next()) {}

    const HomogeneousPoint& point() const { return point_; }
    HomogeneousPoint next();

private:
    HomogeneousPoint moved();

    HostilePoints points_;
    HomogeneousPoint point_, previous_;
    HomogeneousPoint home_;  // Come back to over and over.
};

}  // namespace rimline::tests
