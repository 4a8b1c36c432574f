// The sides of shadow volumes follow from silhouettes. In exact arithmetic: between any two points, the faces and sides
// that the way from one to the other crosses say how many shadows more one is in than the other.

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/exact/exact_numbers.h"
#include "tests/silhouette/exact/hard_classes.h"
#include "tests/silhouette/hough/support/hostile_walk.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using namespace rimline::tests;

// The volume behind the faces that are front from a light.
class ExactVolume {
public:
    ExactVolume(const Mesh& mesh, const HomogeneousPoint& light) : light_(space_point(light)) {
        std::vector<WholeSpacePoint> vertices;
        for (const glm::vec3& p : mesh.positions()) vertices.push_back({whole(p), false});
        const auto vertex = [&](VertexId v) { return vertices[index(v)]; };
        const std::vector<std::uint32_t> words = brute_force_face_bits(mesh, light);
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            if (face_bit(words, FaceId{f})) {
                const Triangle& t = mesh.triangles()[f];
                faces_.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
            }
        const auto add_side = [&](const Edge& edge, FaceId front) {
            const Triangle& t = mesh.triangles()[index(front)];
            for (std::size_t c = 0; c < 3; ++c) {
                const VertexId from = t[c], to = t[(c + 1) % 3];
                if ((from == edge.vertices[0] && to == edge.vertices[1]) ||
                    (from == edge.vertices[1] && to == edge.vertices[0]))
                    add_quad(vertex(to), vertex(from));
            }
        };
        // Between a front and a back; elsewhere than at regular edges, along every front.
        std::vector<EdgeId> silhouette;
        TraversalCounters counters;
        HoughOctree(mesh).extract(light, silhouette, counters);
        for (const EdgeId e : silhouette)
            if (mesh.edge_class(e) == EdgeClass::regular) {
                const auto& [f0, f1] = mesh.edge(e).faces;
                add_side(mesh.edge(e), face_bit(words, f0) ? f0 : f1);
            }
        for (std::uint32_t e = mesh.edges_of_class(EdgeClass::regular).last; e < mesh.edge_count();
             ++e)
            for (const FaceId face : mesh.faces_of(EdgeId{e}))
                if (face_bit(words, face)) add_side(mesh.edge(EdgeId{e}), face);
    }

    // How many shadows `x` is in. Faces whose bits are rounded to the other side cast negative ones.
    std::optional<int> shadows(const WholeSpacePoint& x) const {
        int count = 0;
        for (const SpaceTriangle& face : faces_) {
            const std::optional<int> crossed = crossing(x, light_, face);
            if (!crossed) return std::nullopt;
            count -= *crossed;
        }
        return count;
    }

    // How many shadows more y is in than x, by what the way between them crosses.
    std::optional<int> difference(const WholeSpacePoint& x, const WholeSpacePoint& y) const {
        int count = 0;
        for (const std::vector<SpaceTriangle>* part : {&faces_, &sides_})
            for (const SpaceTriangle& triangle : *part) {
                const std::optional<int> crossed = crossing(x, y, triangle);
                if (!crossed) return std::nullopt;
                count += *crossed;
            }
        return count;
    }

    std::size_t side_count() const { return sides_.size(); }

private:
    WholeSpacePoint at_infinity(const WholeSpacePoint& p) const {
        const WholePoint none{0, 0, 0};
        return {light_.is_direction ? none - light_.place : p.place - light_.place, true};
    }
    void add_quad(const WholeSpacePoint& a, const WholeSpacePoint& b) {
        const WholeSpacePoint a_far = at_infinity(a), b_far = at_infinity(b);
        sides_.push_back({a, b, b_far});
        if (!light_.is_direction) sides_.push_back({a, b_far, a_far});
    }

    WholeSpacePoint light_;
    std::vector<SpaceTriangle> faces_, sides_;
};

struct ShadowTotals {
    std::uint64_t ways = 0, touching = 0, in_shadow = 0, sides = 0;
};

void check_shadows(const NamedSource& named, std::uint64_t seed, ShadowTotals& totals) {
    CAPTURE(named.name);
    CAPTURE(seed);
    const Mesh mesh(named.source);
    HostilePoints lights(mesh, seed);
    Random random(seed);
    const auto place = [&] {
        return WholeSpacePoint{
            whole(glm::vec3(mesh.center() + 1.5 * mesh.radius() * glm::dvec3(random.in_cube()))),
            false};
    };
    for (int i = 0; i < 2; ++i) {
        const ExactVolume volume(mesh, lights.next());
        totals.sides += volume.side_count();
        for (int k = 0; k < 4; ++k) {
            const WholeSpacePoint x = place(), y = place();
            const std::optional<int> at_x = volume.shadows(x), at_y = volume.shadows(y),
                                     difference = volume.difference(x, y);
            ++totals.ways;
            if (!at_x || !at_y || !difference) {
                ++totals.touching;
                continue;
            }
            totals.in_shadow += *at_x > 0 ? 1 : 0;
            CHECK(*difference == *at_y - *at_x);
        }
    }
}

TEST_CASE(
    "shadow volumes by silhouettes have the points in them that faces shade in exact arithmetic" *
    doctest::test_suite("plain")) {
    const std::vector<NamedSource> classes = hard_classes();
    REQUIRE(classes.size() > 100);
    ShadowTotals totals;
    for (std::size_t i = 0; i < classes.size(); ++i) check_shadows(classes[i], i, totals);
    MESSAGE(totals.ways, " ways, of which ", totals.in_shadow, " begin in shadow and ",
            totals.touching, " touch an edge; ", totals.sides, " sides");
    CHECK(totals.in_shadow > totals.ways / 20);
    CHECK(totals.touching < totals.ways / 5);
}

}  // namespace
}  // namespace rimline
