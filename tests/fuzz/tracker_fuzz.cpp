// Any mesh with any coordinates, seen from any points: the octree and the tracker against brute force.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/mesh.h"
#include "tests/fuzz/fuzz_input.h"

using namespace rimline;

namespace {

std::vector<EdgeId> sorted(std::span<const EdgeId> edges) {
    std::vector<EdgeId> result(edges.begin(), edges.end());
    std::ranges::sort(result);
    return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const Welding welding = input.byte() % 4 == 0 ? Welding::none : Welding::equal_positions;
    const Mesh mesh(input.mesh(64), welding);
    HoughOctreeOptions options;
    const std::uint32_t origins = input.below(3);
    for (std::uint32_t i = 0; i < origins; ++i) options.origins.emplace_back(input.point());
    const HoughOctree octree(mesh, options);
    SilhouetteTracker tracker(octree, input.viewpoint_or_direction());
    std::vector<EdgeId> before = sorted(tracker.silhouette());
    for (int move = 0; move < 64 && !input.is_empty(); ++move) {
        const HomogeneousPoint point = input.viewpoint_or_direction();
        const std::vector<EdgeId> expected = brute_force_silhouette(mesh, point);
        std::vector<EdgeId> edges;
        TraversalCounters counters;
        octree.extract(point, edges, counters);
        fuzz::require(sorted(edges) == expected, "the octree's silhouette");
        const ChangeSet& changes = tracker.move_to(point);
        fuzz::require(sorted(tracker.silhouette()) == expected, "the tracker's silhouette");
        fuzz::require(std::ranges::equal(tracker.face_words(), brute_force_face_bits(mesh, point)),
                      "the tracker's face bits");
        std::vector<EdgeId> after;
        std::ranges::set_difference(before, sorted(changes.removed), std::back_inserter(after));
        after.insert(after.end(), changes.added.begin(), changes.added.end());
        fuzz::require(sorted(after) == expected, "the change set");
        before = expected;
    }
    return 0;
}
