#include "tools/bench/fresh_tracker.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/options/track_path.h"

namespace rimline::tools {
namespace {

TEST_CASE("a fresh tracker finds what brute force finds on a random path") {
    const Mesh mesh(make_built_in_shape("spring", 3000));
    const HoughOctree octree(mesh);
    const std::vector<HomogeneousPoint> path = random_path(mesh, 5, 200);
    FreshTracker fresh(octree, path.front());
    for (const HomogeneousPoint& point : path) {
        const ChangeSet& change = fresh.move_to(point);
        std::vector<EdgeId> edges(fresh.silhouette().begin(), fresh.silhouette().end());
        std::sort(edges.begin(), edges.end());
        REQUIRE(edges == brute_force_silhouette(mesh, point));
        REQUIRE(std::ranges::equal(fresh.face_words(), brute_force_face_bits(mesh, point)));
        REQUIRE(change.counters.face_checks >= mesh.face_count());
    }
}

}  // namespace
}  // namespace rimline::tools
