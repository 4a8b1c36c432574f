#include "silhouette/methods/windowed_brute_force.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/block_kernels.h"
#include "silhouette/hough/octree_order.h"
#include "silhouette/methods/window_kernels.h"

namespace rimline {

namespace {

std::uint32_t size32(std::size_t size) { return static_cast<std::uint32_t>(size); }

std::uint8_t byte_of(std::uint32_t place) {
    const std::uint32_t byte = place % k_window_faces / 8;
    return static_cast<std::uint8_t>(byte < 16 ? byte : 0x80 + byte - 16);
}
std::uint8_t bit_of(std::uint32_t place) { return static_cast<std::uint8_t>(1u << place % 8); }

}  // namespace

WindowedBruteForce::WindowedBruteForce(const Mesh& mesh) : mesh_(&mesh), scratch_(0) {
    place_faces();
    place_edges();
}

void WindowedBruteForce::place_faces() {
    const Mesh& mesh = *mesh_;
    std::vector<FaceId> faces, flat;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        (mesh.plane(FaceId{f}).has_normal() ? faces : flat).push_back(FaceId{f});
    std::vector<glm::dvec3> centroids(faces.size());
    blocks_.space.origin = mesh.center();
    double length = 0.0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (const VertexId v : mesh.triangles()[index(faces[i])])
            centroids[i] += glm::dvec3(mesh.positions()[index(v)]) / 3.0;
        // With a length of 1, the last component is the distance from the origin.
        length = std::max(length, std::abs(blocks_.space.vector_of(mesh.plane(faces[i]))[3]));
    }
    // A length may be too great without harm. If it were so small that squares underflow, it would be no bound.
    blocks_.space.length = std::max(length * (1.0 + 0x1p-20), 0x1p-400);

    places_.resize(mesh.face_count());
    order_.reserve(mesh.face_count());
    for (const std::uint32_t i : octree_order(centroids)) order_.push_back(faces[i]);
    order_.insert(order_.end(), flat.begin(), flat.end());
    for (std::uint32_t p = 0; p < order_.size(); ++p) places_[index(order_[p])] = p;

    blocks_.resize(faces.size(), {});
    std::vector<BlockBounds> bounds(blocks_.planes.size());
    for (std::size_t b = 0; b < blocks_.planes.size(); ++b) {
        std::array<PlaneVector, k_block_size> planes;
        std::size_t count = 0;
        for (std::size_t p = b * k_block_size; p < std::min((b + 1) * k_block_size, faces.size());
             ++p)
            planes[count++] = blocks_.space.vector_of(mesh.plane(order_[p]));
        bounds[b] = blocks_.set(b, std::span(planes).first(count));
    }
    blocks_.tree = BlockTree(bounds);
    scratch_ = BlockScratch(size32(blocks_.planes.size()));
    const std::size_t windows = (order_.size() + k_window_faces - 1) / k_window_faces;
    bits_.resize(windows * k_window_blocks);
    sides_.resize(windows);
}

void WindowedBruteForce::place_edges() {
    const Mesh& mesh = *mesh_;
    struct Placed {
        std::uint32_t a, b;  // Places, a < b.
        EdgeId edge;
        std::uint64_t windows() const {
            return std::uint64_t{a / k_window_faces} << 32 | b / k_window_faces;
        }
    };
    std::vector<Placed> placed(mesh.edges_of_class(EdgeClass::regular).last);
    for (std::uint32_t e = 0; e < placed.size(); ++e) {
        const auto [a, b] = mesh.edge(EdgeId{e}).faces;
        const std::uint32_t place_a = places_[index(a)], place_b = places_[index(b)];
        placed[e] = {std::min(place_a, place_b), std::max(place_a, place_b), EdgeId{e}};
    }
    std::ranges::sort(placed, [](const Placed& x, const Placed& y) {
        return x.windows() != y.windows() ? x.windows() < y.windows() : x.edge < y.edge;
    });
    for (std::size_t i = 0; i < placed.size();) {
        const std::uint64_t windows = placed[i].windows();
        WindowPair pair{placed[i].a / k_window_faces, placed[i].b / k_window_faces,
                        size32(edges_.groups.size()), 0};
        for (std::uint32_t lane = 0; i < placed.size() && placed[i].windows() == windows;
             ++i, ++lane) {
            if (lane % k_window_edges == 0) {
                edges_.groups.push_back({});
                edges_.ids.insert(edges_.ids.end(), k_window_edges, k_no_edge);
            }
            EdgeGroup& group = edges_.groups.back();
            group.byte_a[lane % k_window_edges] = byte_of(placed[i].a);
            group.bit_a[lane % k_window_edges] = bit_of(placed[i].a);
            group.byte_b[lane % k_window_edges] = byte_of(placed[i].b);
            group.bit_b[lane % k_window_edges] = bit_of(placed[i].b);
            edges_.ids[edges_.ids.size() - k_window_edges + lane % k_window_edges] = placed[i].edge;
        }
        pair.last = size32(edges_.groups.size());
        edges_.pairs.push_back(pair);
    }
    found_.resize(edges_.groups.size() + 1);
    silhouette_.resize(placed.size() + k_window_edges);
}

void WindowedBruteForce::look_from(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    const std::uint32_t found =
        kernels::front_bits(blocks_, blocks_.space.seen_from(point), bits_, scratch_);
    for (std::uint32_t j = 0; j < found; ++j) {
        const std::uint32_t block = scratch_.found_block[j];
        for (std::uint32_t doubts = scratch_.found_doubts[j]; doubts != 0; doubts &= doubts - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(doubts));
            const Plane& plane = mesh_->plane(order_[block * k_block_size + lane]);
            if (is_front(plane, point)) bits_[block] |= static_cast<std::uint16_t>(1u << lane);
        }
    }
}

bool WindowedBruteForce::is_front_at(FaceId face) const noexcept {
    const std::uint32_t place = places_[index(face)];
    return (bits_[place / k_block_size] >> place % k_block_size & 1u) != 0;
}

void WindowedBruteForce::silhouette(std::vector<EdgeId>& edges) {
    kernels::find_sides(bits_, sides_);
    EdgeId* const end =
        kernels::find_window_edges(edges_, bits_, sides_, found_, silhouette_.data());
    edges.assign(silhouette_.data(), end);
    // Inconsistent edges are on the silhouette where the bits are equal.
    const Mesh::EdgeRange inconsistent = mesh_->edges_of_class(EdgeClass::inconsistent);
    for (std::uint32_t e = inconsistent.first; e < inconsistent.last; ++e) {
        const auto [a, b] = mesh_->edge(EdgeId{e}).faces;
        if (is_front_at(a) == is_front_at(b)) edges.push_back(EdgeId{e});
    }
    const Mesh::EdgeRange nonmanifold = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e) {
        const std::span<const FaceId> faces = mesh_->faces_of(EdgeId{e});
        const bool first = is_front_at(faces[0]);
        if (std::ranges::any_of(faces, [&](FaceId face) { return is_front_at(face) != first; }))
            edges.push_back(EdgeId{e});
    }
}

}  // namespace rimline
