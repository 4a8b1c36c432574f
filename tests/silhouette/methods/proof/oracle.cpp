#include "tests/silhouette/methods/proof/oracle.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/brute_force.h"

namespace rimline::tests {

namespace {

// On x86-64 it has 64 bits: exact products, and sums with 2^-40 of the error of floats.
using Wide = long double;

bool is_exactly_front(const Plane& plane, const HomogeneousPoint& p) {
    const Wide x = Wide{plane.nx} * Wide{p.x};
    const Wide y = Wide{plane.ny} * Wide{p.y};
    const Wide z = Wide{plane.nz} * Wide{p.z};
    return x + y + z > Wide{p.w} * Wide{plane.d};
}

}  // namespace

Oracle::Oracle(const Mesh& mesh) : mesh_(&mesh), brute_force_(mesh), marks_(mesh.edge_count(), 0) {}

void Oracle::look_from(const HomogeneousPoint& point) {
    brute_force_.face_bits(point, words_);
    brute_force_.silhouette(words_, edges_);
    if (look_ < 4 || look_ % k_check_every == 0) check(point);
    ++look_;
    for (const EdgeId edge : edges_) marks_[index(edge)] = 2 * look_;
}

bool Oracle::agrees(std::span<const EdgeId> edges) {
    bool all_known = edges.size() == edges_.size();
    for (const EdgeId edge : edges) {
        if (index(edge) >= marks_.size() || marks_[index(edge)] != 2 * look_)
            all_known = false;
        else
            ++marks_[index(edge)];
    }
    for (const EdgeId edge : edges_) marks_[index(edge)] = 2 * look_;
    return all_known;
}

void Oracle::check(const HomogeneousPoint& point) {
    REQUIRE(words_ == brute_force_face_bits(*mesh_, point));
    REQUIRE(edges_ == brute_force_silhouette(*mesh_, point));
    ++checked_looks_;
    for (std::uint32_t f = 0; f < mesh_->face_count(); ++f)
        rounded_bits_ +=
            face_bit(words_, FaceId{f}) != is_exactly_front(mesh_->plane(FaceId{f}), point);
}

}  // namespace rimline::tests
