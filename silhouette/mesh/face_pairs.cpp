#include "silhouette/mesh/face_pairs.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "silhouette/mesh/face_pair_kernels.h"
#include "silhouette/mesh/face_stars.h"

namespace rimline {

namespace {

using kernels::FaceBlock;

constexpr std::uint32_t k_pair_task_faces = 1u << 10;
constexpr std::size_t k_pair_tasks_a_checkpoint = 64;

float length_1(const glm::vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// One face of a block, for the test that few pairs need.
class BlockedFace {
public:
    BlockedFace(const FaceBlock& block, std::uint32_t lane) : block_(block), lane_(lane) {}

    // Whether no side of this face touches `other` outside of shared corners, certainly. Not where all are shared.
    bool passes_by(const BlockedFace& other) const {
        std::array<int, 3> sides;
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = other.has(block_.vertices[k][lane_]) ? k_shared : other.side_of(corner(k));
            if (sides[k] == k_unknown) return false;
        }
        if ((sides[0] & sides[1] & sides[2]) == k_shared) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (sides[k] + sides[next] != k_left + k_right) continue;
            const int turns = turn_of(k, next, other.corner(0), other.corner(1)) |
                              turn_of(k, next, other.corner(1), other.corner(2)) |
                              turn_of(k, next, other.corner(2), other.corner(0));
            if ((turns & (k_left | k_right)) != (k_left | k_right)) return false;
        }
        return true;
    }

private:
    // Sides are bits, so that several can be collected.
    static constexpr int k_left = 1, k_right = 2, k_unknown = 4, k_shared = 8;

    glm::vec3 corner(std::size_t k) const {
        return {block_.x[k][lane_], block_.y[k][lane_], block_.z[k][lane_]};
    }
    bool has(std::uint32_t vertex) const {
        const auto& v = block_.vertices;
        return vertex == v[0][lane_] || vertex == v[1][lane_] || vertex == v[2][lane_];
    }
    static int side(float height, float bound) {
        return height > bound ? k_left : (-height > bound ? k_right : k_unknown);
    }
    int side_of(const glm::vec3& p) const {
        const glm::vec3 q = p - corner(0);
        return side(block_.normal_x[lane_] * q.x + block_.normal_y[lane_] * q.y +
                        block_.normal_z[lane_] * q.z,
                    block_.bound[lane_] * length_1(q) + FaceBlock::k_least);
    }
    // On which side of the line a -> b the line through two corners passes.
    int turn_of(std::size_t from, std::size_t to, const glm::vec3& a, const glm::vec3& b) const {
        const glm::vec3 u = corner(to) - corner(from), v = a - corner(from), w = b - corner(from);
        return side(
            glm::dot(glm::cross(u, v), w),
            FaceBlock::k_error * length_1(u) * length_1(v) * length_1(w) + FaceBlock::k_least);
    }

    const FaceBlock& block_;
    std::uint32_t lane_;
};

// By place among the blocks of the tree.
class FaceBlocks {
public:
    FaceBlocks(const Mesh& mesh, const FaceTree& tree, const std::stop_token& stop) {
        const std::size_t count = (mesh.face_count() + FaceBlock::k_faces - 1) / FaceBlock::k_faces;
        blocks_ = std::make_unique_for_overwrite<FaceBlock[]>(std::max(count, std::size_t{1}));
        // A power of two that makes the mesh about as large as 1, so that no product leaves the range of floats. The
        // smallest meshes stay smaller.
        const float scale =
            mesh.radius() > 0.0
                ? static_cast<float>(std::exp2(std::min(-std::ilogb(mesh.radius()), 127)))
                : 1.0f;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& run) {
            LongCall{stop, {}}.checkpoint(0.0);
            for (std::size_t i = run.begin(); i < run.end(); ++i)
                fill(mesh, tree.order().subspan(i * FaceBlock::k_faces), scale, blocks_[i]);
        });
    }

    const FaceBlock& of(const FaceTree::Node& node) const { return blocks_[node.block()]; }

private:
    // From the first of `faces`.
    static void fill(const Mesh& mesh, std::span<const std::uint32_t> faces, float scale,
                     FaceBlock& block) {
        for (std::uint32_t lane = 0; lane < FaceBlock::k_faces; ++lane) {
            std::array<glm::vec3, 3> p{};
            glm::vec3 normal(0.0f);
            float bound = 0.0f;
            std::array<std::uint32_t, 3> vertices{};
            if (lane < faces.size()) {
                const Triangle& corners = mesh.triangles()[faces[lane]];
                for (std::size_t k = 0; k < 3; ++k) {
                    p[k] = mesh.positions()[index(corners[k])] * scale;
                    vertices[k] = index(corners[k]);
                }
                const glm::vec3 u = p[1] - p[0], v = p[2] - p[0];
                normal = glm::cross(u, v);
                bound = FaceBlock::k_error * length_1(u) * length_1(v);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                block.x[k][lane] = p[k].x, block.y[k][lane] = p[k].y, block.z[k][lane] = p[k].z;
                block.vertices[k][lane] = vertices[k];
            }
            block.normal_x[lane] = normal.x, block.normal_y[lane] = normal.y;
            block.normal_z[lane] = normal.z;
            block.bound[lane] = bound;
        }
    }

    std::unique_ptr<FaceBlock[]> blocks_;
};

// What one thread finds.
struct Search {
    // Adds the pairs of faces of two nodes that may meet to `found`. Returns how many have boxes that meet.
    std::uint64_t add(const Mesh& mesh, const FaceTree& tree, const FaceBlocks& blocks,
                      const FaceTree::Node& a, const FaceTree::Node& b) {
        const FaceBlock &faces_a = blocks.of(a), &faces_b = blocks.of(b);
        kernels::NearFaces near;
        const std::uint32_t pairs = kernels::find_near_faces(faces_a, a.size(), faces_b, b.size(),
                                                             a.number == b.number, near);
        for (std::uint32_t i = 0; i < a.size(); ++i)
            for (std::uint32_t rest = near[i]; rest != 0; rest &= rest - 1) {
                const auto j = static_cast<std::uint32_t>(std::countr_zero(rest));
                const BlockedFace one(faces_a, i), other(faces_b, j);
                if (one.passes_by(other) && other.passes_by(one)) continue;
                const FacePair pair{tree.order()[a.first + i], tree.order()[b.first + j]};
                if (!meet_in_corner_only(mesh, pair.a, pair.b)) found.push_back(pair);
            }
        return pairs;
    }
    std::vector<FacePair> found;
};

}  // namespace

bool each_near_face_pair(const Mesh& mesh, const FaceTree& tree, const TakeFacePairs& take,
                         const LongCall& call, std::uint64_t max_pairs) {
    const FaceBlocks blocks(mesh, tree, call.stop);
    const FaceStars stars(mesh, tree, call.stop);
    const auto are_apart = [&](const FaceTree::Node& a, const FaceTree::Node& b) {
        return stars.are_apart(a, b);
    };
    FaceTree::NodePairs walk(tree, k_pair_task_faces);
    tbb::enumerable_thread_specific<Search> searches;
    std::atomic<std::uint64_t> all_pairs = 0;
    std::atomic<bool> goes_on = true;
    std::vector<FaceTree::NodePair> tasks;
    do {
        call.checkpoint(walk.done());
        walk.next(k_pair_tasks_a_checkpoint, tasks);
        tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t task) {
            Search& search = searches.local();
            std::uint64_t pairs = 0;
            tree.each_block_pair(tasks[task], are_apart,
                                 [&](const FaceTree::Node& a, const FaceTree::Node& b) {
                                     if (goes_on) pairs += search.add(mesh, tree, blocks, a, b);
                                 });
            all_pairs += pairs;
            if (all_pairs > max_pairs || (!search.found.empty() && !take(search.found)))
                goes_on = false;
            search.found.clear();
        });
    } while (goes_on && !tasks.empty());
    return goes_on;
}

}  // namespace rimline
