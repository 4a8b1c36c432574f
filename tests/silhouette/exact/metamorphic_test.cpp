// What must not change silhouettes: places, sizes and turns of mesh and point together, orders, splits of faces in
// their planes, and faces far away. Where a bit changes all the same, the point lies within rounding of the plane.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/rounds.h"
#include "tests/silhouette/exact/exact_edges.h"
#include "tests/silhouette/exact/hard_classes.h"
#include "tests/silhouette/hough/support/hostile_walk.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using namespace rimline::tests;

using Map = std::function<glm::dvec3(const glm::dvec3&)>;

// Another mesh with the same silhouettes.
struct Image {
    MeshSource source;
    std::vector<std::uint32_t>
        parents;  // Of each face, the face that it comes from; k_none of those added.
    Map places;   // Of vertices and viewpoints.
    Map directions;
    bool is_exact;  // No bit may change.
};
constexpr std::uint32_t k_none = 0xffffffffu;

// The image of a vector, where it is a float's.
std::optional<glm::vec3> mapped(const Map& map, const glm::vec3& p) {
    const glm::dvec3 q = map(glm::dvec3(p));
    const glm::vec3 rounded(q);
    for (int axis = 0; axis < 3; ++axis)
        if (double{rounded[axis]} != q[axis] || !(std::abs(q[axis]) <= k_max_coordinate))
            return std::nullopt;
    return rounded;
}

std::optional<HomogeneousPoint> mapped(const Image& image, const HomogeneousPoint& p) {
    const std::optional<glm::vec3> q =
        mapped(p.is_direction() ? image.directions : image.places, p.xyz());
    if (!q) return std::nullopt;
    const HomogeneousPoint result =
        p.is_direction() ? HomogeneousPoint::direction(*q) : HomogeneousPoint::viewpoint(*q);
    if (result.xyz() != *q) return std::nullopt;  // Too small.
    return result;
}

Image unchanged(const MeshSource& source) {
    Image image{source,
                {},
                [](const glm::dvec3& p) { return p; },
                [](const glm::dvec3& p) { return p; },
                true};
    for (std::uint32_t f = 0; f < source.triangles.size(); ++f) image.parents.push_back(f);
    return image;
}

std::optional<Image> moved(const MeshSource& source, const Map& places, const Map& directions,
                           bool is_exact) {
    Image image = unchanged(source);
    image.places = places;
    image.directions = directions;
    image.is_exact = is_exact;
    for (glm::vec3& p : image.source.positions) {
        const std::optional<glm::vec3> q = mapped(places, p);
        if (!q) return std::nullopt;
        p = *q;
    }
    return image;
}

double power_of_two_above(const MeshSource& source) {
    double greatest = 0x1p-100;
    for (const glm::vec3& p : source.positions)
        greatest = std::max(
            {greatest, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    return std::exp2(std::ceil(std::log2(greatest)));
}

Image in_another_order(const MeshSource& source, Random& random) {
    Image image = unchanged(source);
    random.shuffle(image.parents);
    std::vector<std::uint32_t> places(source.positions.size());
    for (std::uint32_t v = 0; v < places.size(); ++v) places[v] = v;
    random.shuffle(places);
    for (std::uint32_t v = 0; v < places.size(); ++v)
        image.source.positions[places[v]] = source.positions[v];
    for (std::size_t f = 0; f < image.parents.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c)
            image.source.triangles[f][c] = places[source.triangles[image.parents[f]][c]];
    return image;
}

Image from_other_corners(const MeshSource& source, Random& random) {
    Image image = unchanged(source);
    image.is_exact = false;
    for (auto& t : image.source.triangles)
        std::rotate(t.begin(), t.begin() + random.below(3), t.end());
    return image;
}

// Faces are split at a point of their inside, where it is a float's and no vertex is there: new edges are then of one
// face's pieces alone.
Image split(const MeshSource& source) {
    Image image = unchanged(source);
    image.is_exact = false;
    image.source.triangles.clear();
    image.parents.clear();
    std::set<Position> taken;
    for (const glm::vec3& p : source.positions) taken.insert(position(p));
    for (std::uint32_t f = 0; f < source.triangles.size(); ++f) {
        const auto [a, b, c] = source.triangles[f];
        const auto at = [&](std::uint32_t v) { return glm::dvec3(source.positions[v]); };
        const Map inside = [&](const glm::dvec3& p) {
            return p + 0.25 * (at(b) - p) + 0.25 * (at(c) - p);
        };
        const std::optional<glm::vec3> q = mapped(inside, source.positions[a]);
        const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            image.source.triangles.push_back({i, j, k});
            image.parents.push_back(f);
        };
        const FloatCorners corners = corners_of(source, f);
        const bool has_edges =
            corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
        if (!q || !has_edges || !taken.insert(position(*q)).second) {
            add(a, b, c);
            continue;
        }
        const auto middle = static_cast<std::uint32_t>(image.source.positions.size());
        image.source.positions.push_back(*q);
        add(a, b, middle);
        add(b, c, middle);
        add(c, a, middle);
    }
    return image;
}

Image beside_far_faces(const MeshSource& source, Random& random) {
    Image image = unchanged(source);
    const double far = std::min(0x1p20 * power_of_two_above(source), 0x1p59);
    for (int i = 0; i < 9; ++i) {
        image.source.triangles.push_back({});
        image.parents.push_back(k_none);
        for (std::uint32_t& v : image.source.triangles.back()) {
            v = static_cast<std::uint32_t>(image.source.positions.size());
            image.source.positions.emplace_back(far * (glm::dvec3(random.in_cube()) + 0.5));
        }
    }
    return image;
}

std::vector<std::pair<std::string, std::optional<Image>>> images_of(const MeshSource& source,
                                                                    Random& random) {
    const double size = power_of_two_above(source);
    const auto scaled = [&](double factor) {
        const Map scale = [factor](const glm::dvec3& p) { return factor * p; };
        return moved(source, scale, scale, true);
    };
    const auto shifted = [&](const glm::dvec3& way) {
        return moved(
            source, [way](const glm::dvec3& p) { return p + way; },
            [](const glm::dvec3& p) { return p; }, false);
    };
    const auto turned = [&](const Map& turn, bool is_exact) {
        return moved(source, turn, turn, is_exact);
    };
    return {{"shifted by its size", shifted({size, -2.0 * size, 4.0 * size})},
            {"shifted far", shifted({0.0, 1024.0 * size, -64.0 * size})},
            {"smaller", scaled(0x1p-7)},
            {"larger", scaled(0x1p5)},
            {"half a turn",
             turned([](const glm::dvec3& p) { return glm::dvec3(-p.x, p.y, -p.z); }, true)},
            {"a quarter of a turn",
             turned([](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); }, false)},
            {"a third of a turn",
             turned([](const glm::dvec3& p) { return glm::dvec3(p.z, p.x, p.y); }, false)},
            {"another order", in_another_order(source, random)},
            {"other first corners", from_other_corners(source, random)},
            {"split", split(source)},
            {"beside far faces", beside_far_faces(source, random)}};
}

struct ImageTotals {
    std::uint64_t views = 0, bits = 0, changed_bits = 0, equal_silhouettes = 0;
};

void check_image(const MeshSource& source, const Image& image, const HomogeneousPoint& point,
                 const HomogeneousPoint& image_point, ImageTotals& totals) {
    const Mesh mesh(source), image_mesh(image.source);
    const std::vector<std::uint32_t> words = brute_force_face_bits(mesh, point),
                                     image_words = brute_force_face_bits(image_mesh, image_point);
    ++totals.views;
    std::vector<bool> is_changed(image.parents.size(), false);
    bool any_changed = false;
    for (std::uint32_t f = 0; f < image.parents.size(); ++f) {
        const std::uint32_t parent = image.parents[f];
        if (parent == k_none) continue;
        ++totals.bits;
        is_changed[f] = face_bit(words, FaceId{parent}) != face_bit(image_words, FaceId{f});
        if (!is_changed[f]) continue;
        CAPTURE(f);
        ++totals.changed_bits;
        any_changed = true;
        REQUIRE(!image.is_exact);
        REQUIRE((is_within_rounding(corners_of(source, parent), point) ||
                 is_within_rounding(corners_of(image.source, f), image_point)));
    }
    // The silhouette of the index. Edges differ only at faces whose bits do.
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    HoughOctree(image_mesh).extract(image_point, edges, counters);
    const std::set<EdgePositions> found = positions_of(image_mesh, edges);
    std::set<EdgePositions> expected;
    for (const EdgeId edge : brute_force_silhouette(mesh, point)) {
        const auto& [v, w] = mesh.edge(edge).vertices;
        const std::optional<glm::vec3> a = mapped(image.places, mesh.positions()[index(v)]),
                                       b = mapped(image.places, mesh.positions()[index(w)]);
        REQUIRE((a && b));
        expected.insert(std::minmax(position(*a), position(*b)));
    }
    if (!any_changed) ++totals.equal_silhouettes;
    const ExactEdges image_edges(image.source);
    std::vector<EdgePositions> differences;
    std::ranges::set_symmetric_difference(expected, found, std::back_inserter(differences));
    for (const EdgePositions& edge : differences) {
        const auto uses = image_edges.uses().find(edge);
        REQUIRE(uses != image_edges.uses().end());
        const bool is_added = std::ranges::all_of(uses->second, [&](const ExactEdges::Use& use) {
            return image.parents[use.face] == k_none;
        });
        if (is_added) continue;
        REQUIRE(std::ranges::any_of(
            uses->second, [&](const ExactEdges::Use& use) { return is_changed[use.face]; }));
    }
}

TEST_CASE(
    "silhouettes stay when mesh and point are moved, scaled, turned, split and put in another "
    "order") {
    constexpr std::uint64_t k_seed = 5;
    Random random(k_seed);
    std::map<std::string, ImageTotals> totals;
    for (const NamedSource& named : hard_classes()) {
        CAPTURE(named.name);
        const Mesh mesh(named.source);
        for (auto& [name, image] : images_of(named.source, random)) {
            if (!image) continue;
            CAPTURE(name);
            HostilePoints points(mesh, random.bits());
            for (int i = 0; i < tests::rounds(4); ++i) {
                const HomogeneousPoint point = points.next();
                // Of a shift, only points of few digits have an image.
                const double grid = power_of_two_above(named.source) / 64.0;
                const HomogeneousPoint coarse = HomogeneousPoint::viewpoint(
                    glm::clamp(glm::vec3(grid * glm::round(glm::dvec3(point.xyz()) / grid)),
                               -k_max_coordinate, k_max_coordinate));
                for (const HomogeneousPoint& p : {point, coarse})
                    if (const auto image_point = mapped(*image, p))
                        check_image(named.source, *image, p, *image_point, totals[name]);
            }
        }
    }
    REQUIRE(totals.size() == 11);
    for (const auto& [name, total] : totals) {
        CAPTURE(name);
        MESSAGE(name, ": ", total.views, " views, ", total.changed_bits, " of ", total.bits,
                " bits changed, ", total.equal_silhouettes, " silhouettes equal");
        CHECK(total.views > tests::rounds(100));
        CHECK(total.equal_silhouettes > total.views / 2);
    }
}

}  // namespace
}  // namespace rimline
