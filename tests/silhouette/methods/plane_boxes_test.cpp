#include "silhouette/methods/plane_boxes.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/methods/plane_space.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

PlaneBounds in_plane_space(const Plane& plane, const glm::dvec3& origin) {
    const auto [distance, error] = offset_plane(plane, origin);
    return {{plane.nx, plane.ny, plane.nz, distance - error},
            {plane.nx, plane.ny, plane.nz, distance + error}};
}

// Every face sixteen times, so that each has leaves of its own and only its own.
PlaneBoxes boxes_of_faces(const Mesh& mesh, const glm::dvec3& origin) {
    std::vector<PlaneBounds> items;
    for (const Plane& plane : mesh.planes())
        items.insert(items.end(), k_leaf_items, in_plane_space(plane, origin));
    return {origin, items};
}

struct Bits {
    std::uint64_t asked = 0;
    std::uint64_t certain = 0;
    std::uint64_t wrong = 0;
};

Bits predicted_bits(const Mesh& mesh, const glm::dvec3& origin, std::uint32_t points,
                    std::uint64_t seed) {
    const PlaneBoxes boxes = boxes_of_faces(mesh, origin);
    Bits bits;
    tests::ProbePoints probes(mesh, seed);
    for (std::uint32_t i = 0; i < points; ++i) {
        const HomogeneousPoint p = probes.next();
        const PointForm y = form_of(p, origin);
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const Plane& plane = mesh.plane(FaceId{f});
            if (!plane.has_normal()) continue;
            const CertainSides sides = boxes.sides(boxes.tree().group_of(0, f), y);
            const bool positive = (sides.positive >> f % k_fan_out & 1u) != 0;
            const bool negative = (sides.negative >> f % k_fan_out & 1u) != 0;
            ++bits.asked;
            bits.certain += positive || negative;
            bits.wrong += is_front(plane, p) ? negative : positive;
        }
    }
    return bits;
}

TEST_CASE("a face's bit is what its own box is certain of, from wherever it is seen") {
    const std::uint64_t seed = 71;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const double r = mesh.radius();
        for (const glm::dvec3& origin :
             {mesh.center(), glm::dvec3(0.0), mesh.center() + glm::dvec3(r / 3.0, -r, 100.0 * r)})
            CHECK(predicted_bits(mesh, origin, 100, seed).wrong == 0);
    }
}

TEST_CASE("a face's own box leaves few points in doubt") {
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const Bits bits = predicted_bits(mesh, mesh.center(), 300, 72);
    CHECK(bits.certain > bits.asked * 9 / 10);
}

TEST_CASE("a box of planes is certain only where all of its planes agree") {
    // Two planes x = 1 and x = 3, both facing along x: between them they disagree.
    const glm::dvec3 origin(0.0);
    const std::vector<PlaneBounds> items{in_plane_space({1.0f, 0.0f, 0.0f, 1.0f}, origin),
                                         in_plane_space({1.0f, 0.0f, 0.0f, 3.0f}, origin)};
    const PlaneBoxes boxes(origin, items);
    const auto sides_from = [&](float x) {
        return boxes.sides(0, form_of(HomogeneousPoint::viewpoint({x, 5.0f, -7.0f}), origin));
    };
    CHECK((sides_from(0.9f).negative & 1u) == 1u);
    CHECK((sides_from(3.1f).positive & 1u) == 1u);
    for (const float x : {1.1f, 2.0f, 2.9f}) {
        CHECK((sides_from(x).negative & 1u) == 0u);
        CHECK((sides_from(x).positive & 1u) == 0u);
    }
}

}  // namespace
}  // namespace rimline
