#include "silhouette/lines/intersection_curves.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/lines/contact_places.h"
#include "silhouette/lines/exact_signs.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_segments_a_checkpoint = 1u << 14;
// A segment that passes so near to a side of a face, as a share of the face's height over it, may meet the face
// or not. So near to the plane of a face, in radii, it may lie in it.
constexpr double k_side_slack = 1e-9, k_plane_slack = 0x1p-40;
// A segment lies on a face of its plane over at least this share of its length, or only ends at it.
constexpr double k_min_touch = 1e-6;

}  // namespace

class IntersectionCurves::Builder {
public:
    Builder(const Mesh& mesh, const VertexStars& stars, const FaceTree& tree,
            const FaceContacts& contacts, std::span<const std::uint8_t> is_flat,
            IntersectionCurves& curves)
        : mesh_(mesh),
          stars_(stars),
          tree_(tree),
          contacts_(contacts),
          is_flat_(is_flat),
          curves_(curves) {}

    void find_segments() {
        add_pair_nodes();
        std::ranges::sort(pair_nodes_);
        pair_nodes_.erase(std::ranges::unique(pair_nodes_).begin(), pair_nodes_.end());
        for (std::size_t i = 0; i < pair_nodes_.size();) {
            std::size_t j = i + 1;
            while (j < pair_nodes_.size() && pair_nodes_[j].faces == pair_nodes_[i].faces) ++j;
            add_segment(std::span(pair_nodes_).subspan(i, j - i));
            i = j;
        }
        number_nodes();
    }

    void find_passages(const LongCall& call) {
        const auto count = static_cast<std::uint32_t>(curves_.segments_.size());
        std::vector<std::vector<Passage>> of_segment(count);
        for (std::uint32_t first = 0; first < count; first += k_segments_a_checkpoint) {
            call.checkpoint(double(first) / count);
            const std::uint32_t last = std::min(count, first + k_segments_a_checkpoint);
            tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, last, 64),
                              [&](const auto& run) {
                                  for (std::uint32_t s = run.begin(); s < run.end(); ++s)
                                      of_segment[s] = passages_of(curves_.segments_[s]);
                              });
        }
        curves_.passage_begin_.assign(1, 0);
        for (const std::vector<Passage>& passages : of_segment) {
            curves_.passages_.insert(curves_.passages_.end(), passages.begin(), passages.end());
            curves_.passage_begin_.push_back(static_cast<std::uint32_t>(curves_.passages_.size()));
        }
    }

private:
    const Triangle& corners(std::uint32_t face) const { return mesh_.triangles()[face]; }
    const glm::vec3& at(VertexId v) const { return mesh_.positions()[index(v)]; }
    int side_of(std::uint32_t face, VertexId v) const {
        const Triangle& t = corners(face);
        return plane_side(at(t[0]), at(t[1]), at(t[2]), at(v));
    }

    void add_pair(std::uint32_t f, std::uint32_t g, const Key& key) {
        if (f != g && is_flat_[f] == 0 && is_flat_[g] == 0)
            pair_nodes_.push_back({{std::min(f, g), std::max(f, g)}, key});
    }
    void add_pair_nodes() {
        for (const auto& [edge, face] : contacts_.piercings)
            for (const FaceId f : mesh_.faces_of(EdgeId{edge}))
                add_pair(index(f), face, {Key::Kind::piercing, edge, face});
        for (const auto& [edge, other] : contacts_.crossings) {
            if (edge > other) continue;  // Both edges have it.
            for (const FaceId f : mesh_.faces_of(EdgeId{edge}))
                for (const FaceId g : mesh_.faces_of(EdgeId{other}))
                    add_pair(index(f), index(g), {Key::Kind::crossing, edge, other});
        }
        for (const auto& [vertex, face, side] : contacts_.touches)
            for (const std::uint32_t f : stars_.faces(vertex))
                add_pair(f, face, {Key::Kind::vertex, vertex, 0});
    }

    // The nodes of one pair of faces.
    void add_segment(std::span<const PairNode> nodes) {
        const auto [f, g] = nodes.front().faces;
        Key first = nodes.front().key, second = nodes.back().key;
        if (nodes.size() == 1) {
            // It may lead from a corner that the faces share.
            std::size_t shared = 0;
            for (const VertexId v : corners(f))
                if (has_corner(corners(g), v)) second = {Key::Kind::vertex, index(v), 0}, ++shared;
            if (shared != 1) return;
        } else if (nodes.size() != 2) {
            return;  // Coplanar faces.
        }
        const bool is_coplanar = std::ranges::all_of(
            corners(g), [&, face = f](VertexId v) { return side_of(face, v) == 0; });
        if (is_coplanar) return;
        if (second < first) std::swap(first, second);
        if (lies_along_edge(f, g, first, second) || lies_along_edge(g, f, first, second)) return;
        found_.push_back({first, second, {f, g}});
    }

    static bool lies_on(const Key& key, const Edge& edge, std::uint32_t number) {
        switch (key.kind) {
            case Key::Kind::piercing: return key.a == number;
            case Key::Kind::crossing: return key.a == number || key.b == number;
            case Key::Kind::vertex:
                return index(edge.vertices[0]) == key.a || index(edge.vertices[1]) == key.a;
        }
        return false;
    }
    // Whether the segment is a part of a side of face f that only touches face g: the side is a line of its own
    // if it is one at all. Where the faces at the side lie on different sides of g, they pass through it.
    bool lies_along_edge(std::uint32_t f, std::uint32_t g, const Key& first,
                         const Key& second) const {
        for (const EdgeId side : mesh_.edges_of(FaceId{f})) {
            const Edge& edge = mesh_.edge(side);
            if (!lies_on(first, edge, index(side)) || !lies_on(second, edge, index(side))) continue;
            int before = 0;
            bool passes_through = false;
            for (const FaceId face : mesh_.faces_of(side))
                for (const VertexId v : corners(index(face))) {
                    if (v == edge.vertices[0] || v == edge.vertices[1]) continue;
                    const int s = side_of(g, v);
                    passes_through = passes_through || s * before < 0;
                    if (s != 0) before = s;
                }
            return !passes_through;
        }
        return false;
    }

    void number_nodes() {
        std::ranges::sort(found_);
        // Faces at both sides of an edge give the same segment.
        const auto same = [](const Found& a, const Found& b) {
            return a.first == b.first && a.second == b.second;
        };
        found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
        std::vector<Key> keys;
        for (const Found& segment : found_) {
            keys.push_back(segment.first);
            keys.push_back(segment.second);
        }
        std::ranges::sort(keys);
        keys.erase(std::ranges::unique(keys).begin(), keys.end());
        const auto number_of = [&](const Key& key) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(keys, key) - keys.begin());
        };
        for (const Found& segment : found_)
            curves_.segments_.push_back(
                {{number_of(segment.first), number_of(segment.second)}, segment.faces});
        curves_.node_face_begin_.assign(1, 0);
        for (const Key& key : keys) add_node(key);
    }

    void add_faces_of_edge(std::uint32_t edge) {
        for (const FaceId face : mesh_.faces_of(EdgeId{edge})) {
            const auto& sides = mesh_.edges_of(face);
            const std::uint32_t side = sides[0] == EdgeId{edge}   ? 0
                                       : sides[1] == EdgeId{edge} ? 1
                                                                  : 2;
            curves_.node_faces_.push_back({index(face), side});
        }
    }

    void add_node(const Key& key) {
        const auto end_of = [&](std::uint32_t edge, std::size_t k) -> const glm::vec3& {
            return at(mesh_.edge(EdgeId{edge}).vertices[k]);
        };
        const auto on_edge = [&](double share) {
            const glm::dvec3 from(end_of(key.a, 0));
            return from + share * (glm::dvec3(end_of(key.a, 1)) - from);
        };
        glm::dvec3 position(0.0);
        switch (key.kind) {
            case Key::Kind::piercing: {
                const Triangle& t = corners(key.b);
                position = on_edge(share_to_plane(end_of(key.a, 0), end_of(key.a, 1), at(t[0]),
                                                  at(t[1]), at(t[2])));
                curves_.node_faces_.push_back({key.b, FaceContacts::Touch::k_inside});
                add_faces_of_edge(key.a);
                break;
            }
            case Key::Kind::crossing: {
                position = on_edge(share_to_crossing(end_of(key.a, 0), end_of(key.a, 1),
                                                     end_of(key.b, 0), end_of(key.b, 1)));
                add_faces_of_edge(key.a);
                add_faces_of_edge(key.b);
                break;
            }
            case Key::Kind::vertex:
                position = glm::dvec3(mesh_.positions()[key.a]);
                for (const std::uint32_t face : stars_.faces(key.a))
                    curves_.node_faces_.push_back({face, NodeFace::k_corner});
                for (const FaceContacts::Touch& touch : contacts_.touches_of(key.a))
                    curves_.node_faces_.push_back({touch.face, touch.side});
                break;
        }
        std::ranges::sort(curves_.node_faces_.begin() + curves_.node_face_begin_.back(),
                          curves_.node_faces_.end());
        curves_.positions_.push_back(position);
        curves_.vertices_.push_back(key.kind == Key::Kind::vertex ? key.a : k_no_contact_vertex);
        curves_.node_face_begin_.push_back(static_cast<std::uint32_t>(curves_.node_faces_.size()));
    }

    std::vector<Passage> passages_of(const Segment& segment) const {
        std::vector<Passage> passages;
        const glm::dvec3 from = curves_.positions_[segment.nodes[0]];
        const glm::dvec3 to = curves_.positions_[segment.nodes[1]];
        const double plane_slack = k_plane_slack * mesh_.radius();
        tree_.each_along(from, to, [&](std::uint32_t face) {
            if (curves_.is_own(segment, face) || is_flat_[face] != 0) return;
            const bool contains_end = curves_.contains(segment.nodes[0], face) ||
                                      curves_.contains(segment.nodes[1], face);
            const FacePlane plane(*this, face);
            const double before = plane.height_of(from), after = plane.height_of(to);
            const bool is_on = std::abs(before) <= plane_slack,
                       stays_on = std::abs(after) <= plane_slack;
            if (is_on && stays_on) {
                add_touch(face, plane.clip(from, to), passages);
            } else if (contains_end) {
                return;
            } else if (is_on || stays_on) {
                const double share = is_on ? 0.0 : 1.0;
                if (plane.clip(from, to).contains(share))
                    passages.push_back({Passage::Kind::touch, face, share});
            } else if (before * after < 0.0) {
                const double share = before / (before - after);
                const double inside = plane.depth_inside(glm::mix(from, to, share));
                if (inside < -k_side_slack) return;
                passages.push_back(
                    {inside > k_side_slack ? Passage::Kind::through : Passage::Kind::doubtful, face,
                     share});
            }
        });
        std::ranges::sort(passages, {}, &Passage::share);
        return passages;
    }

    struct Interval {
        double begin, end;
        bool contains(double share) const { return begin <= share && share <= end; }
    };
    // A face for tests of points near it.
    class FacePlane {
    public:
        FacePlane(const Builder& builder, std::uint32_t face) {
            for (std::size_t k = 0; k < 3; ++k)
                corners_[k] = glm::dvec3(builder.at(builder.corners(face)[k]));
            normal_ = glm::cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
            area_ = glm::length(normal_);
        }
        double height_of(const glm::dvec3& p) const {
            return glm::dot(normal_, p - corners_[0]) / area_;
        }
        // By how much of the face's height over a side a point lies inside of that side.
        double inside_of(std::size_t side, const glm::dvec3& p) const {
            const glm::dvec3& a = corners_[side];
            return glm::dot(glm::cross(corners_[(side + 1) % 3] - a, p - a), normal_) /
                   (area_ * area_);
        }
        double depth_inside(const glm::dvec3& p) const {
            return std::min({inside_of(0, p), inside_of(1, p), inside_of(2, p)});
        }
        // The part of a segment, as shares, that lies over the face or not far beside it.
        Interval clip(const glm::dvec3& from, const glm::dvec3& to) const {
            Interval part{0.0, 1.0};
            for (std::size_t side = 0; side < 3; ++side) {
                const double a = inside_of(side, from) + k_side_slack,
                             b = inside_of(side, to) + k_side_slack;
                if (a < 0.0 && b < 0.0) return {1.0, 0.0};
                if (a < 0.0) part.begin = std::max(part.begin, a / (a - b));
                if (b < 0.0) part.end = std::min(part.end, a / (a - b));
            }
            return part;
        }

    private:
        std::array<glm::dvec3, 3> corners_;
        glm::dvec3 normal_;
        double area_;
    };

    static void add_touch(std::uint32_t face, const Interval& part,
                          std::vector<Passage>& passages) {
        if (!(part.end > part.begin + k_min_touch)) return;
        passages.push_back({Passage::Kind::touch, face, part.begin});
        passages.push_back({Passage::Kind::touch, face, part.end});
    }

    struct Found {
        Key first, second;
        std::array<std::uint32_t, 2> faces;
        auto operator<=>(const Found&) const = default;
    };
    const Mesh& mesh_;
    const VertexStars& stars_;
    const FaceTree& tree_;
    const FaceContacts& contacts_;
    std::span<const std::uint8_t> is_flat_;
    IntersectionCurves& curves_;
    std::vector<PairNode> pair_nodes_;
    std::vector<Found> found_;
};

IntersectionCurves::IntersectionCurves(const Mesh& mesh, const VertexStars& stars,
                                       const FaceTree& tree, const FaceContacts& contacts,
                                       std::span<const std::uint8_t> is_flat,
                                       const LongCall& call) {
    Builder builder(mesh, stars, tree, contacts, is_flat, *this);
    builder.find_segments();
    builder.find_passages(call);
}

bool IntersectionCurves::contains(std::uint32_t node, std::uint32_t face) const noexcept {
    return std::ranges::binary_search(faces_at(node), face, {}, &NodeFace::face);
}

}  // namespace rimline
