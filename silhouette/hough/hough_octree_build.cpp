#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "silhouette/gradual_resize.h"
#include "silhouette/hough/block_set.h"
#include "silhouette/hough/face_links.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/octree_order.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_no_position = 0xffffffffu;
constexpr std::uint32_t k_grain = 1024;

std::uint32_t size32(std::size_t size) { return static_cast<std::uint32_t>(size); }

}  // namespace

// Fills an octree that has its mesh and its origins.
class HoughOctreeBuilder {
public:
    HoughOctreeBuilder(HoughOctree& octree, const LongCall& call)
        : octree_(octree), mesh_(*octree.mesh_), call_(call) {}

    void build() {
        call_.checkpoint(0.0);
        group_faces();
        call_.checkpoint(0.1);
        tbb::parallel_invoke([this] { place_faces(); }, [this] { place_edges(); });
        call_.checkpoint(0.9);
        link_neighbors();
        measure();
        call_.checkpoint(1.0);
    }

private:
    // On all threads. A cancelled call ends each thread within k_grain visits.
    template <typename Visit>
    void for_each_index(std::size_t count, Visit&& visit) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, k_grain),
                          [&](const tbb::blocked_range<std::size_t>& part) {
                              LongCall{call_.stop, {}}.checkpoint(0.0);
                              for (std::size_t i = part.begin(); i < part.end(); ++i) visit(i);
                          });
        // An exception in the other of place_faces() and place_edges() ends this loop early without an error
        // here. The arrays are incomplete then, so this must not continue. The other exception is the one
        // reported.
        if (tbb::is_current_task_group_canceling()) throw Error(ErrorCode::cancelled, "cancelled");
    }

    // On this thread.
    template <typename Visit>
    void for_each_in_order(std::uint32_t count, Visit&& visit) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i % (1u << 16) == 0) LongCall{call_.stop, {}}.checkpoint(0.0);
            visit(i);
        }
    }

    HoughPoint hough_point_of(FaceId face, std::size_t group) const {
        return hough_point(mesh_.plane(face), octree_.origins_[group]);
    }

    // The number of a face's interior edges that are SFO from the origin although the normals of their faces
    // differ by less than a right angle. (The thesis says "dihedral angle less than π/2". That would be the
    // sharp edges, and contradicts its own 4.4.2.)
    std::uint32_t sfo_count(FaceId face, std::size_t group) const {
        const Plane& plane = mesh_.plane(face);
        const int side = hough_point_of(face, group).side;
        std::uint32_t count = 0;
        for (const EdgeId edge : mesh_.edges_of(face)) {
            if (index(edge) >= mesh_.edges_of_class(EdgeClass::regular).last) continue;
            const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
            const FaceId other = faces[0] == face ? faces[1] : faces[0];
            const Plane& neighbor = mesh_.plane(other);
            const double cosine = double{plane.nx} * double{neighbor.nx} +
                                  double{plane.ny} * double{neighbor.ny} +
                                  double{plane.nz} * double{neighbor.nz};
            if (cosine > 0.0) count += hough_point_of(other, group).side != side;
        }
        return count;
    }

    void group_faces() {
        resize_gradually(group_, mesh_.face_count(), call_.stop);
        if (octree_.origins_.size() == 1) return;
        for_each_index(mesh_.face_count(), [&](std::size_t f) {
            const FaceId face{size32(f)};
            if (!mesh_.plane(face).has_normal()) return;
            std::uint32_t min_count = std::numeric_limits<std::uint32_t>::max();
            double farthest = -1.0;
            for (std::uint32_t g = 0; g < octree_.origins_.size(); ++g) {
                const std::uint32_t count = sfo_count(face, g);
                const double distance = glm::length(hough_point_of(face, g).position);
                if (count > min_count || (count == min_count && distance <= farthest)) continue;
                min_count = count;
                farthest = distance;
                group_[f] = g;
            }
        });
    }

    void place_faces() {
        resize_gradually(position_, mesh_.face_count(), call_.stop, k_no_position);
        std::vector<std::vector<FaceId>> members(octree_.origins_.size());
        for_each_in_order(mesh_.face_count(), [&](std::uint32_t f) {
            if (mesh_.plane(FaceId{f}).has_normal()) members[group_[f]].push_back(FaceId{f});
        });
        for (std::size_t g = 0; g < members.size(); ++g) {
            octree_.statistics_.group_faces.push_back(size32(members[g].size()));
            octree_.face_blocks_.push_back(make_face_blocks(g, members[g]));
        }
    }

    // A length may be too great without harm. If it were so small that squares underflow, it would be no
    // bound.
    BlockSpace space_of(std::size_t group, double length) const {
        return {octree_.origins_[group], std::max(length * (1.0 + 0x1p-20), 0x1p-400)};
    }

    FaceBlocks make_face_blocks(std::size_t group, std::span<const FaceId> members) {
        std::vector<glm::dvec3> positions;
        resize_gradually(positions, members.size(), call_.stop);
        // The Hough point of a plane is that of the plane turned around. A box would hold both: apart.
        std::vector<std::uint8_t> sides(members.size());
        for_each_index(members.size(), [&](std::size_t i) {
            const HoughPoint point = hough_point_of(members[i], group);
            positions[i] = point.position;
            sides[i] = point.side < 0;
        });
        const std::vector<std::uint32_t> order = octree_order(positions, sides, call_.stop);
        double length = 0.0;
        for (const FaceId face : members) {
            const HoughPoint point = hough_point_of(face, group);
            length = std::max(length, glm::length(point.position) + point.error);
        }

        FaceBlocks blocks;
        blocks.space = space_of(group, length);
        blocks.first_block = octree_.block_count();
        blocks.resize(members.size(), call_.stop);
        const std::uint32_t block_count = block_count_of(members.size());
        const std::size_t first_position = octree_.faces_.size();
        resize_gradually(octree_.faces_, first_position + std::size_t{block_count} * k_block_size,
                         call_.stop, k_no_face);
        std::vector<BlockBounds> bounds(block_count);
        for_each_index(block_count, [&](std::size_t b) {
            const std::size_t begin = b * k_block_size;
            const std::size_t end = std::min(begin + k_block_size, members.size());
            std::array<PlaneVector, k_block_size> planes;
            for (std::size_t i = begin; i < end; ++i) {
                const FaceId face = members[order[i]];
                octree_.faces_[first_position + i] = face;
                position_[index(face)] = size32(first_position + i);
                planes[i - begin] = blocks.space.vector_of(mesh_.plane(face));
            }
            bounds[b] = blocks.set(b, std::span(planes).first(end - begin));
        });
        blocks.tree = BlockTree(bounds);
        return blocks;
    }

    // Whether an edge is SFO from the origin; none where its planes do not decide.
    std::optional<bool> is_sfo(EdgeId edge, std::size_t group) const {
        const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
        const int a = hough_point_of(faces[0], group).side;
        const int b = hough_point_of(faces[1], group).side;
        if (a == 0 || b == 0) return std::nullopt;
        return (a != b) != is_inconsistent(edge);
    }
    bool is_inconsistent(EdgeId edge) const {
        return index(edge) >= mesh_.edges_of_class(EdgeClass::inconsistent).first;
    }

    enum NoOwner : std::uint32_t { k_sfo = 0xfffffffeu, k_undecided = 0xffffffffu };

    // The group that tests an edge: the first from which it is not SFO, of the groups of its faces, then of
    // all.
    std::uint32_t owner_of(EdgeId edge) const {
        const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
        for (const FaceId face : faces)
            if (!mesh_.plane(face).has_normal()) return k_undecided;
        std::uint32_t owner = k_sfo;
        const auto try_group = [&](std::uint32_t group) {
            const std::optional<bool> sfo = is_sfo(edge, group);
            if (sfo == false) owner = group;
            if (!sfo && owner == k_sfo) owner = k_undecided;
            return sfo == false;
        };
        for (const FaceId face : faces)
            if (try_group(group_[index(face)])) return owner;
        for (std::uint32_t g = 0; g < octree_.origins_.size(); ++g)
            if (try_group(g)) return owner;
        return owner;
    }

    void place_edges() {
        const std::uint32_t two_faced = mesh_.edges_of_class(EdgeClass::inconsistent).last;
        std::vector<std::uint32_t> owner;
        resize_gradually(owner, two_faced, call_.stop);
        for_each_index(two_faced, [&](std::size_t e) { owner[e] = owner_of(EdgeId{size32(e)}); });
        const std::size_t groups = octree_.origins_.size();
        owned_.resize(groups);
        HoughOctreeStatistics& statistics = octree_.statistics_;
        for_each_in_order(two_faced, [&](std::uint32_t e) {
            const std::array<FaceId, 2>& faces = mesh_.edge(EdgeId{e}).faces;
            statistics.sfo_edges += owner[e] == k_sfo;
            statistics.undecided_edges += owner[e] == k_undecided;
            const bool is_owned = owner[e] < groups;
            owned_[is_owned ? owner[e] : group_[index(faces[0])]].push_back(EdgeId{e});
            statistics.owned_edges += is_owned;
            statistics.ghost_edges += is_owned && (group_[index(faces[0])] != owner[e] ||
                                                   group_[index(faces[1])] != owner[e]);
        });
        octree_.edge_blocks_.resize(groups);
        tbb::parallel_for(std::size_t{0}, groups,
                          [&](std::size_t g) { octree_.edge_blocks_[g] = make_edge_blocks(g); });
    }

    // The planes of both faces, the second turned around where both traverse the edge in the same direction.
    // Both are turned around where that brings them to the positive side of the origin: there edges are near to
    // each other whose Hough points are.
    std::array<PlaneVector, 2> planes_of(EdgeId edge, const BlockSpace& space) const {
        const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
        std::array<PlaneVector, 2> planes{space.vector_of(mesh_.plane(faces[0])),
                                          space.vector_of(mesh_.plane(faces[1]))};
        const auto turn = [](PlaneVector& plane) {
            for (double& component : plane) component = -component;
        };
        if (is_inconsistent(edge)) turn(planes[1]);
        if (planes[0][3] + planes[1][3] < 0.0) std::ranges::for_each(planes, turn);
        return planes;
    }

    EdgeBlocks make_edge_blocks(std::size_t group) const {
        const std::vector<EdgeId>& edges = owned_[group];
        const auto point_of = [&](EdgeId edge, std::size_t side) {
            const FaceId face = mesh_.edge(edge).faces[side];
            return mesh_.plane(face).has_normal() ? hough_point_of(face, group)
                                                  : HoughPoint{{}, 0.0, 0};
        };
        std::vector<glm::dvec3> centers;
        std::vector<double> lengths;
        resize_gradually(centers, edges.size(), call_.stop);
        resize_gradually(lengths, edges.size(), call_.stop);
        for_each_index(edges.size(), [&](std::size_t i) {
            const std::array<HoughPoint, 2> points{point_of(edges[i], 0), point_of(edges[i], 1)};
            for (const HoughPoint& point : points)
                lengths[i] = std::max(lengths[i], glm::length(point.position) + point.error);
            centers[i] = 0.5 * (points[0].position + points[1].position);
        });
        EdgeBlocks blocks;
        const auto farthest = std::max_element(lengths.begin(), lengths.end());
        blocks.space = space_of(group, farthest == lengths.end() ? 0.0 : *farthest);
        // Planes of an edge that are far apart make wide boxes, though their Hough points may be near each other: of
        // planes that face each other.
        std::vector<double>& squares = lengths;
        for_each_index(edges.size(), [&](std::size_t i) {
            const std::array<PlaneVector, 2> pair = planes_of(edges[i], blocks.space);
            squares[i] = 0.0;
            for (std::size_t axis = 0; axis < pair[0].size(); ++axis) {
                const double difference = pair[1][axis] - pair[0][axis];
                squares[i] += difference * difference;
            }
        });
        const std::vector<std::uint32_t> order =
            octree_order(centers, length_classes(squares), call_.stop);

        blocks.resize(edges.size(), call_.stop);
        const std::uint32_t block_count = block_count_of(edges.size());
        std::vector<BlockBounds> bounds(block_count);
        for_each_index(block_count, [&](std::size_t b) {
            const std::size_t begin = b * k_block_size;
            const std::size_t end = std::min(begin + k_block_size, edges.size());
            std::array<PlaneVector, 2 * k_block_size> planes;
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const EdgeId edge = edges[order[i]];
                blocks.edges[i] = edge;
                const std::array<PlaneVector, 2> pair = planes_of(edge, blocks.space);
                for (const PlaneVector& plane : pair) planes[count++] = plane;
            }
            bounds[b] = blocks.set(b, std::span(planes).first(count));
        });
        blocks.tree = BlockTree(bounds);
        return blocks;
    }

    void link_neighbors() {
        const std::uint32_t position_count = size32(octree_.faces_.size());
        // A face without a plane: where the states of trackers are zero.
        std::ranges::replace(position_, k_no_position, position_count);
        resize_gradually(octree_.links_, position_count, call_.stop);
        for_each_index(position_count, [&](std::size_t i) {
            if (octree_.faces_[i] != k_no_face)
                octree_.links_[i] = FaceLinks(mesh_, octree_.faces_[i], position_);
        });
    }

    void measure() {
        HoughOctreeStatistics& statistics = octree_.statistics_;
        const auto bytes = [](const auto& items) { return items.size() * sizeof(items.front()); };
        const auto add_tree = [&](const BlockTree& tree) {
            statistics.nodes += tree.node_count();
            statistics.depth = std::max(statistics.depth, tree.level_count());
            statistics.size_bytes += tree.size_bytes();
        };
        for (const std::uint32_t faces : statistics.group_faces) statistics.faces += faces;
        for (const FaceBlocks& blocks : octree_.face_blocks_) {
            add_tree(blocks.tree);
            statistics.size_bytes += bytes(blocks.planes);
            octree_.max_blocks_ = std::max(octree_.max_blocks_, size32(blocks.planes.size()));
        }
        for (const EdgeBlocks& blocks : octree_.edge_blocks_) {
            add_tree(blocks.tree);
            statistics.size_bytes += bytes(blocks.planes) + bytes(blocks.edges);
            octree_.max_blocks_ = std::max(octree_.max_blocks_, size32(blocks.planes.size()));
        }
        statistics.size_bytes += bytes(octree_.faces_) + bytes(octree_.links_);
        statistics.nonmanifold_edges = mesh_.edges_of_class(EdgeClass::nonmanifold).size();
    }

    HoughOctree& octree_;
    const Mesh& mesh_;
    const LongCall& call_;
    std::vector<std::uint32_t> group_;        // By face.
    std::vector<std::uint32_t> position_;     // By face; k_no_position without a plane.
    std::vector<std::vector<EdgeId>> owned_;  // By group.
};

HoughOctree::HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options, const LongCall& call)
    : mesh_(&mesh), origins_(options.origins) {
    if (origins_.empty()) origins_.push_back(mesh.center());
    for (const glm::dvec3& origin : origins_)
        for (int i = 0; i < 3; ++i) RIMLINE_CHECK(std::abs(origin[i]) <= double{k_max_coordinate});
    HoughOctreeBuilder(*this, call).build();
}

HoughOctree::~HoughOctree() = default;
HoughOctree::HoughOctree(HoughOctree&&) noexcept = default;
HoughOctree& HoughOctree::operator=(HoughOctree&&) noexcept = default;

}  // namespace rimline
