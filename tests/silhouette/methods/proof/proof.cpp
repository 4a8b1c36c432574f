#include "tests/silhouette/methods/proof/proof.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/methods/method_registry.h"
#include "tests/silhouette/hough/shadow_consumer.h"
#include "tests/silhouette/hough/support/hostile_walk.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/hough/support/origin_lists.h"

namespace rimline::tests {

namespace {

using Origins = std::vector<glm::dvec3>;

#define RIMLINE_CAPTURE_POINT(p) \
    CAPTURE((p).x);              \
    CAPTURE((p).y);              \
    CAPTURE((p).z);              \
    CAPTURE((p).w)

bool is_allowed(const Origins& origins) {
    return std::ranges::all_of(origins, [](const glm::dvec3& o) {
        constexpr double k_most = double{k_max_coordinate};
        return std::abs(o.x) <= k_most && std::abs(o.y) <= k_most && std::abs(o.z) <= k_most;
    });
}

std::vector<Origins> allowed_origin_lists(const Mesh& mesh, std::uint64_t seed) {
    std::vector<Origins> lists = origin_lists(mesh);
    lists.push_back({});
    lists.push_back({origin_in_two_planes(mesh, static_cast<std::uint32_t>(seed))});
    std::erase_if(lists, [](const Origins& origins) { return !is_allowed(origins); });
    return lists;
}

std::uint32_t instruction_set_count() {
    static const std::uint32_t count = [] {
        std::uint32_t sets = 0;
        for_each_instruction_set([&](const std::string&) { ++sets; });
        return sets;
    }();
    return count;
}

std::uint32_t share(std::uint32_t quota, std::size_t parts) {
    return static_cast<std::uint32_t>((quota + parts - 1) / parts);
}

void prove_extraction(const HoughOctree& octree, std::uint32_t points, std::uint64_t seed,
                      Oracle& oracle, Tally& tally) {
    HostilePoints source(octree.mesh(), seed);
    BlockScratch scratch = octree.make_scratch();
    std::vector<EdgeId> edges;
    for (std::uint32_t i = 0; i < points; ++i) {
        const HomogeneousPoint p = source.next();
        RIMLINE_CAPTURE_POINT(p);
        oracle.look_from(p);
        TraversalCounters counters;
        octree.extract(p, edges, counters, scratch);
        REQUIRE(oracle.agrees(edges));
        tally.edges += edges.size();
    }
    tally.extractions += points;
}

void prove_walk(const HoughOctree& octree, std::uint32_t moves, std::uint64_t seed, Tally& tally) {
    HostileWalk walk(octree.mesh(), seed);
    SilhouetteTracker tracker(octree, walk.point());
    ShadowConsumer consumer(tracker);
    for (std::uint32_t i = 0; i < moves; ++i) {
        const HomogeneousPoint from = tracker.point();
        const HomogeneousPoint p = walk.next();
        CAPTURE(i);
        RIMLINE_CAPTURE_POINT(from);
        RIMLINE_CAPTURE_POINT(p);
        const ChangeSet& changes = tracker.move_to(p);
        consumer.follow(tracker, changes);
        tally.flips += changes.flipped.size();
        tally.fresh_moves += tracker.was_extracted();
    }
    tally.moves += moves;
}

// For a method that takes directions only, the direction to where a viewpoint is.
HomogeneousPoint as_taken_by(const SilhouetteMethodInfo& info, const HomogeneousPoint& point) {
    return info.directions_only ? HomogeneousPoint::direction(point.xyz()) : point;
}

void prove_method(const SilhouetteMethodInfo& info, SilhouetteMethod& method, const Mesh& mesh,
                  const Quota& quota, std::uint64_t seed, Oracle& oracle, Tally& tally) {
    std::vector<EdgeId> edges;
    HostilePoints points(mesh, seed);
    for (std::uint32_t i = 0; i < quota.extractions; ++i) {
        const HomogeneousPoint p = as_taken_by(info, points.next());
        RIMLINE_CAPTURE_POINT(p);
        oracle.look_from(p);
        TraversalCounters counters;
        method.extract(p, edges, counters);
        REQUIRE(oracle.agrees(edges));
        tally.edges += edges.size();
    }
    tally.extractions += quota.extractions;
    if (!info.has_update) return;
    HostileWalk walk(mesh, seed);
    for (std::uint32_t i = 0; i < quota.moves; ++i) {
        const HomogeneousPoint p = as_taken_by(info, walk.next());
        CAPTURE(i);
        RIMLINE_CAPTURE_POINT(p);
        oracle.look_from(p);
        TraversalCounters counters;
        method.update(p, edges, counters);
        REQUIRE(oracle.agrees(edges));
    }
    tally.moves += quota.moves;
}

}  // namespace

std::string to_string(const Tally& t) {
    std::ostringstream text;
    text << t.meshes << " meshes, " << t.layouts << " layouts, " << t.extractions
         << " extractions of " << t.edges << " edges, " << t.moves << " moves";
    if (t.flips > 0)
        text << " with " << t.flips << " flips (" << t.fresh_moves << " of the moves found afresh)";
    text << "; " << t.checked_looks << " looks of the oracle checked, with " << t.rounded_bits
         << " bits that only rounding decides";
    if (!t.instruction_sets.empty()) text << "; on";
    for (const std::string& set : t.instruction_sets) text << ' ' << set;
    return text.str();
}

void prove_index(const Mesh& mesh, const Quota& quota, std::uint64_t seed, Tally& tally) {
    CAPTURE(seed);
    const std::vector<Origins> lists = allowed_origin_lists(mesh, seed);
    const std::size_t parts = lists.size() * instruction_set_count();
    Oracle oracle(mesh);
    std::uint64_t part_seed = 1000 * seed;
    for (const Origins& origins : lists) {
        CAPTURE(&origins - lists.data());
        const HoughOctree octree(mesh, {origins});
        ++tally.layouts;
        for_each_instruction_set([&](const std::string& set) {
            CAPTURE(set);
            tally.instruction_sets.insert(set);
            ++part_seed;
            CAPTURE(part_seed);
            prove_extraction(octree, share(quota.extractions, parts), part_seed, oracle, tally);
            prove_walk(octree, share(quota.moves, parts), part_seed, tally);
        });
    }
    ++tally.meshes;
    tally.add(oracle);
}

void prove_methods(const Mesh& mesh, const Quota& quota, std::uint64_t seed, Tally& tally) {
    CAPTURE(seed);
    const double r = mesh.radius();
    const Origins elsewhere{mesh.center() + glm::dvec3(r / 3.0, 3.0 * r, -r / 5.0)};
    Oracle oracle(mesh);
    for (const SilhouetteMethodInfo& info : silhouette_methods()) {
        if (!info.exact) continue;
        const std::string method_name(info.name);
        CAPTURE(method_name);
        std::vector<Origins> lists{{}};
        if (info.max_origins > 0 && is_allowed(elsewhere)) lists.push_back(elsewhere);
        const Quota part{share(quota.extractions, lists.size()), share(quota.moves, lists.size())};
        for (const Origins& origins : lists) {
            CAPTURE(origins.size());
            SilhouetteMethodOptions options;
            options.origins = origins;
            const std::unique_ptr<SilhouetteMethod> method =
                make_silhouette_method(info.name, mesh, options);
            REQUIRE(method != nullptr);
            ++tally.layouts;
            prove_method(info, *method, mesh, part, seed + origins.size(), oracle, tally);
        }
    }
    ++tally.meshes;
    tally.add(oracle);
}

#undef RIMLINE_CAPTURE_POINT

}  // namespace rimline::tests
