#include "silhouette/methods/edge_buffer.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace rimline {

[[gnu::always_inline]] inline std::uint32_t EdgeBuffer::BothFlags::run(const std::uint8_t* flags) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < k_sweep; ++i)
        bits |= flags[i] == (k_front | k_back) ? 1u << i : 0u;
    return bits;
}

EdgeBuffer::EdgeBuffer(const Mesh& mesh)
    : mesh_(&mesh),
      planes_((std::size_t{mesh.face_count()} + k_leaf_items - 1) / k_leaf_items),
      front_(best_version<FrontOfSixteen>()),
      both_flags_(best_version<BothFlags>()) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        planes_[f / k_leaf_items].set(f % k_leaf_items, mesh.plane(FaceId{f}));

    // The lists of all vertices, one after another. Each list is sorted by the other vertex.
    edges_.resize(mesh.edge_count());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) edges_[e] = EdgeId{e};
    const auto ends = [&mesh](EdgeId edge) {
        return std::minmax(
            {index(mesh.edge(edge).vertices[0]), index(mesh.edge(edge).vertices[1])});
    };
    std::sort(edges_.begin(), edges_.end(), [&](EdgeId a, EdgeId b) { return ends(a) < ends(b); });

    const std::uint32_t none = mesh.edge_count();
    flags_.resize((std::size_t{none} + 1 + k_sweep - 1) / k_sweep * k_sweep);
    std::vector<std::uint32_t> place_of(none);
    for (std::uint32_t place = 0; place < none; ++place) {
        place_of[index(edges_[place])] = place;
        if (mesh.edge_class(edges_[place]) != EdgeClass::inconsistent) continue;
        flags_[place] = k_inconsistent;
        inconsistent_.push_back(place);
    }
    places_.resize(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const EdgeId edge = mesh.edges_of(FaceId{f})[corner];
            places_[f][corner] = edge == k_no_edge ? none : place_of[index(edge)];
        }
    // The flags of this place belong to no edge.
    flags_[none] = k_inconsistent;
}

void EdgeBuffer::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                         TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    const std::uint32_t face_count = mesh_->face_count();
    for (std::uint32_t begin = 0; begin < face_count; begin += k_leaf_items) {
        const std::uint32_t bits = front_(planes_[begin / k_leaf_items], point);
        const std::uint32_t count = std::min(k_leaf_items, face_count - begin);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint8_t flag = (bits >> i & 1u) != 0 ? k_front : k_back;
            for (const std::uint32_t place : places_[begin + i]) flags_[place] |= flag;
        }
    }
    for (const std::uint32_t place : inconsistent_)
        if ((flags_[place] & (k_front | k_back)) != (k_front | k_back))
            edges.push_back(edges_[place]);
    for (std::uint32_t begin = 0; begin < flags_.size(); begin += k_sweep) {
        std::uint8_t* const flags = &flags_[begin];
        for (std::uint32_t on = both_flags_(flags); on != 0; on &= on - 1)
            edges.push_back(edges_[begin + static_cast<std::uint32_t>(std::countr_zero(on))]);
        for (std::uint32_t i = 0; i < k_sweep; ++i) flags[i] &= k_inconsistent;
    }
    counters.face_checks += face_count;
    counters.edge_checks += mesh_->edge_count();
}

}  // namespace rimline
