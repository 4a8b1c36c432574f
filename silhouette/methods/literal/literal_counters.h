#pragma once

// The thesis's measures of work (3.5, 4.4.6), counted separately to reproduce its figures.
//
// A test of a box counts once, against one v-sphere (extraction) or against the active region between two
// v-spheres (updates).

#include <cstdint>

namespace rimline {

struct LiteralCounters {
    std::uint64_t obv_checks = 0;       ///< Octants; tested by the incremental update only.
    std::uint64_t pbv_checks = 0;       ///< Boxes of a node's own Hough points.
    std::uint64_t ebv_checks = 0;       ///< Boxes of those and their neighbors; extraction only.
    std::uint64_t face_checks = 0;      ///< Face bits evaluated from planes.
    std::uint64_t contained_faces = 0;  ///< Faces turned untested, in nodes inside the region.
    std::uint64_t edge_tests = 0;       ///< Edges tested for being on the silhouette.
    std::uint64_t nodes_enqueued = 0;   ///< By the breadth-first search.

    std::uint64_t box_checks() const noexcept { return obv_checks + pbv_checks + ebv_checks; }

    LiteralCounters& operator+=(const LiteralCounters& other) noexcept {
        obv_checks += other.obv_checks;
        pbv_checks += other.pbv_checks;
        ebv_checks += other.ebv_checks;
        face_checks += other.face_checks;
        contained_faces += other.contained_faces;
        edge_tests += other.edge_tests;
        nodes_enqueued += other.nodes_enqueued;
        return *this;
    }
};

}  // namespace rimline
