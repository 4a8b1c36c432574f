#include "silhouette/methods/plane_space.h"

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline {

// The bound of hough_point.h: products of a float and a double, three sums.
OffsetPlane offset_plane(const Plane& plane, const glm::dvec3& origin) noexcept {
    const double d = plane.d;
    return {d - glm::dot(plane.normal(), origin),
            0x1p-50 * (std::abs(d) + std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z))};
}

PlaneSpace::PlaneSpace(const Mesh& mesh, const glm::dvec3& origin, const Place& place,
                       const std::array<double, 4>& weights)
    : mesh_(&mesh), origin_(origin), weights_(weights), followed_(mesh) {
    std::vector<PlacedPlane> placed(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.plane(FaceId{f}).has_normal()) placed[f] = place(mesh.plane(FaceId{f}));
    build_edges(placed);
    build_faces(placed);
}

PackedKey PlaneSpace::key_of(const PlaneBounds& bounds) const noexcept {
    PackedKey key;
    for (std::size_t k = 0; k < key.size(); ++k)
        key[k] = static_cast<float>(0.5 * (bounds.low[k] + bounds.high[k]) * weights_[k]);
    return key;
}

void PlaneSpace::build_edges(std::span<const PlacedPlane> placed) {
    std::vector<EdgeId> edges;
    std::vector<PlaneBounds> bounds;
    std::vector<PackedKey> keys;
    for (std::uint32_t e = 0; e < mesh_->edges_of_class(EdgeClass::regular).last; ++e) {
        const std::array<FaceId, 2>& faces = mesh_->edge(EdgeId{e}).faces;
        const PlacedPlane& a = placed[index(faces[0])];
        const PlacedPlane& b = placed[index(faces[1])];
        if (a.factor_sign == 0 || a.factor_sign != b.factor_sign) continue;
        edges.push_back(EdgeId{e});
        bounds.push_back(a.bounds);
        bounds.back().include(b.bounds);
        keys.push_back(key_of(bounds.back()));
    }
    const std::vector<std::uint32_t> order = packed_order(keys);
    std::vector<EdgeId> ordered_edges;
    std::vector<PlaneBounds> ordered_bounds;
    ordered_edges.reserve(order.size());
    ordered_bounds.reserve(order.size());
    for (const std::uint32_t i : order) {
        ordered_edges.push_back(edges[i]);
        ordered_bounds.push_back(bounds[i]);
    }
    edge_boxes_ = PlaneBoxes(origin_, ordered_bounds);
    edge_leaves_ = EdgeLeaves(*mesh_, ordered_edges);
}

void PlaneSpace::build_faces(std::span<const PlacedPlane> placed) {
    std::vector<FaceId> faces;
    std::vector<FaceId> unplaced;
    std::vector<PackedKey> keys;
    for (std::uint32_t f = 0; f < placed.size(); ++f) {
        if (placed[f].factor_sign != 0) {
            faces.push_back(FaceId{f});
            keys.push_back(key_of(placed[f].bounds));
        } else if (mesh_->plane(FaceId{f}).has_normal()) {
            unplaced.push_back(FaceId{f});
        }
    }
    std::vector<FaceId> ordered;
    std::vector<PlaneBounds> bounds;
    ordered.reserve(faces.size());
    bounds.reserve(faces.size());
    for (const std::uint32_t i : packed_order(keys)) {
        ordered.push_back(faces[i]);
        bounds.push_back(placed[index(faces[i])].bounds);
    }
    face_boxes_ = PlaneBoxes(origin_, bounds);

    const auto append = [this](std::span<const FaceId> run) {
        for (std::size_t begin = 0; begin < run.size(); begin += k_leaf_items) {
            FaceBlock& block = face_blocks_.emplace_back();
            block.count =
                static_cast<std::uint32_t>(std::min<std::size_t>(k_leaf_items, run.size() - begin));
            for (std::uint32_t i = 0; i < block.count; ++i) {
                block.faces[i] = run[begin + i];
                block.planes.set(i, mesh_->plane(run[begin + i]));
            }
        }
    };
    append(ordered);
    placed_blocks_ = face_blocks_.size();
    append(unplaced);
}

void PlaneSpace::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                         TraversalCounters& counters) const {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    const PointForm y = form_of(point, origin_);
    edge_boxes_.tree().walk(
        [&](const PackedTree::Siblings& siblings) {
            counters.box_checks += siblings.count;
            const CertainSides sides = edge_boxes_.sides(siblings.group, y);
            return siblings.lanes() & ~(sides.positive | sides.negative);
        },
        [&](std::uint32_t leaf) { edge_leaves_.test_leaf(leaf, point, edges, counters); });
    edge_leaves_.test_rest(point, edges, counters);
}

void PlaneSpace::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                        TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    if (!followed_.has_started()) {
        start_following(point, counters);
    } else if (point != followed_point_) {
        flipped_.clear();
        find_flips(followed_point_, point, counters);
        followed_.turn(flipped_, counters);
    }
    followed_point_ = point;
    edges.assign(followed_.edges().begin(), followed_.edges().end());
}

void PlaneSpace::start_following(const HomogeneousPoint& point, TraversalCounters& counters) {
    std::vector<std::uint32_t> words(face_word_count(mesh_->face_count()), 0);
    for (FaceBlock& block : face_blocks_) {
        block.bits = front_(block.planes, point);
        for (std::uint32_t bits = block.bits; bits != 0; bits &= bits - 1) {
            const std::uint32_t face =
                index(block.faces[static_cast<std::uint32_t>(std::countr_zero(bits))]);
            words[face / 32] |= 1u << (face % 32);
        }
        counters.face_checks += block.count;
    }
    followed_.start(words, counters);
}

void PlaneSpace::find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                            TraversalCounters& counters) {
    const PointForm old_y = form_of(from, origin_);
    const PointForm new_y = form_of(to, origin_);
    const auto test = [&](std::size_t block) {
        counters.face_checks += face_blocks_[block].count;
        flip(block, front_(face_blocks_[block].planes, to) ^ face_blocks_[block].bits);
    };
    face_boxes_.tree().walk(
        [&](const PackedTree::Siblings& siblings) {
            counters.box_checks += 2 * siblings.count;
            const CertainSides before = face_boxes_.sides(siblings.group, old_y);
            const CertainSides after = face_boxes_.sides(siblings.group, new_y);
            const std::uint32_t stayed =
                (before.positive & after.positive) | (before.negative & after.negative);
            const std::uint32_t turned = siblings.lanes() & ((before.positive & after.negative) |
                                                             (before.negative & after.positive));
            for (std::uint32_t lanes = turned; lanes != 0; lanes &= lanes - 1) {
                const PackedTree::Range range = face_boxes_.tree().items_of(
                    siblings.level,
                    siblings.first_node + static_cast<std::uint32_t>(std::countr_zero(lanes)));
                for (std::uint32_t i = range.begin; i < range.end; i += k_leaf_items)
                    flip(i / k_leaf_items, (1u << face_blocks_[i / k_leaf_items].count) - 1);
            }
            return siblings.lanes() & ~(stayed | turned);
        },
        test);
    for (std::size_t block = placed_blocks_; block < face_blocks_.size(); ++block) test(block);
}

void PlaneSpace::flip(std::size_t block, std::uint32_t lanes) {
    FaceBlock& b = face_blocks_[block];
    b.bits ^= lanes;
    for (; lanes != 0; lanes &= lanes - 1)
        flipped_.push_back(b.faces[static_cast<std::uint32_t>(std::countr_zero(lanes))]);
}

}  // namespace rimline
