// Face bits, silhouettes and change sets against exact arithmetic.

#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/exact/exact_edges.h"
#include "tests/silhouette/exact/exact_numbers.h"
#include "tests/silhouette/exact/hard_classes.h"
#include "tests/silhouette/hough/support/hostile_walk.h"

namespace rimline {
namespace {

using namespace rimline::tests;

struct BitTotals {
    std::uint64_t bits = 0, within_rounding = 0, rounded_away = 0, silhouette_edges = 0;
};

void check_bits(const NamedSource& named, std::uint64_t seed, BitTotals& totals) {
    CAPTURE(named.name);
    CAPTURE(seed);
    const MeshSource& source = named.source;
    const Mesh mesh(source);
    std::vector<RoundedPlane> planes;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        CAPTURE(f);
        planes.push_back(rounded_plane(corners_of(source, f)));
        const Plane& plane = mesh.plane(FaceId{f});
        REQUIRE(planes.back().normal ==
                std::array{mpq_class(plane.nx), mpq_class(plane.ny), mpq_class(plane.nz)});
        REQUIRE(planes.back().distance == mpq_class(plane.d));
    }
    const ExactEdges exact_edges(source);
    const HoughOctree octree(mesh);
    HostilePoints points(mesh, seed);
    SilhouetteTracker tracker(octree, points.next());
    for (int i = 0; i < 6; ++i) {
        const HomogeneousPoint point = points.next();
        tracker.move_to(point);
        std::vector<bool> bits;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            CAPTURE(f);
            bits.push_back(rounded_bit(planes[f], point));
            REQUIRE(is_front(mesh.plane(FaceId{f}), point) == bits.back());
            REQUIRE(face_bit(tracker.face_words(), FaceId{f}) == bits.back());
            const FloatCorners corners = corners_of(source, f);
            const bool is_near = is_within_rounding(corners, point);
            const bool is_exact = (exact_side(corners, point) > 0) == bits.back();
            REQUIRE((is_exact || is_near));
            ++totals.bits;
            totals.within_rounding += is_near ? 1 : 0;
            totals.rounded_away += is_exact ? 0 : 1;
        }
        const std::set<EdgePositions> expected = exact_edges.silhouette(bits);
        totals.silhouette_edges += expected.size();
        const std::vector<EdgeId> by_definition = brute_force_silhouette(mesh, point);
        REQUIRE(by_definition.size() == expected.size());
        REQUIRE(positions_of(mesh, by_definition) == expected);
        REQUIRE(positions_of(mesh, tracker.silhouette()) == expected);
        std::vector<EdgeId> extracted;
        TraversalCounters counters;
        octree.extract(point, extracted, counters);
        REQUIRE(positions_of(mesh, extracted) == expected);
    }
}

void check_round(std::uint32_t round) {
    const std::vector<NamedSource> classes = hard_classes(round);
    REQUIRE(classes.size() > 100);
    BitTotals totals;
    for (std::size_t i = 0; i < classes.size(); ++i)
        check_bits(classes[i], 1000 * round + i, totals);
    MESSAGE(classes.size(), " classes, ", totals.bits, " bits, of which ", totals.within_rounding,
            " lie within rounding and ", totals.rounded_away, " differ from the exact side; ",
            totals.silhouette_edges, " edges of silhouettes");
    CHECK(totals.silhouette_edges > 10'000);
    // Hostile points: both kinds must come up.
    CHECK(totals.within_rounding > totals.bits / 100);
    CHECK(totals.within_rounding < totals.bits / 2);
    CHECK(totals.rounded_away > 0);
}

TEST_CASE("numbers are rounded as floats and doubles are") {
    CHECK(rounded_to_float(mpq_class(1, 3)) == mpq_class(1.0f / 3.0f));
    CHECK(rounded_to_double(mpq_class(-2, 3)) == mpq_class(-2.0 / 3.0));
    CHECK(rounded_to_float(mpq_class(16777217)) == 16777216);
    CHECK(rounded_to_float(mpq_class(16777219)) == 16777220);
    CHECK(rounded_to_float(mpq_class(0x1p-149f) / 2) == 0);
    CHECK(rounded_to_float(mpq_class(0x1p-149f) * 3 / 4) == mpq_class(0x1p-149f));
    CHECK(rounded_root(mpq_class(2)) == mpq_class(1.4142135623730951));
    CHECK(rounded_root(mpq_class(9, 4)) == mpq_class(3, 2));
    CHECK(rounded_root(mpq_class(0x1p-300)) == mpq_class(0x1p-150));
}

TEST_CASE("bits and silhouettes of hard meshes are those of exact arithmetic" *
          doctest::test_suite("plain")) {
    check_round(0);
}

TEST_SUITE("long") {
    TEST_CASE("bits and silhouettes of many hard meshes are those of exact arithmetic") {
        for (std::uint32_t round = 1; round < 20; ++round) check_round(round);
    }
}

}  // namespace
}  // namespace rimline
