#pragma once

// Compares extractions of LiteralOctree and LiteralForest with brute force.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline::tests {

/// Extracts from `points` probe points. `extractor` has the extract() of LiteralOctree.
template <typename Extractor>
void check_literal_extraction(const Mesh& mesh, const Extractor& extractor, std::uint32_t points,
                              std::uint64_t seed) {
    CAPTURE(seed);
    ProbePoints probes(mesh, seed);
    std::vector<EdgeId> edges{k_no_edge};  // extract() must replace it.
    for (std::uint32_t i = 0; i < rounds(points); ++i) {
        const HomogeneousPoint p = probes.next();
        CAPTURE(i);
        CAPTURE(p.x);
        CAPTURE(p.y);
        CAPTURE(p.z);
        CAPTURE(p.w);
        LiteralCounters counters;
        extractor.extract(p, edges, counters);
        std::sort(edges.begin(), edges.end());
        REQUIRE(edges == brute_force_silhouette(mesh, p));
    }
}

}  // namespace rimline::tests
