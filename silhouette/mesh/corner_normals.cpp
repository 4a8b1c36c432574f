#include "silhouette/mesh/corner_normals.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "silhouette/error.h"
#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/disjoint_sets.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_numbers_a_checkpoint = 1u << 18;

void throw_if_stopped(const std::stop_token& stop) { LongCall{stop, {}}.checkpoint(0.0); }

// In order, on this thread.
template <typename Visit>
void for_each_in_order(std::uint32_t count, const std::stop_token& stop, Visit&& visit) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % k_numbers_a_checkpoint == 0) throw_if_stopped(stop);
        visit(i);
    }
}

// Sets values[i] = value_of(i) on all threads. The values' memory is touched in parts, too.
template <typename Value, typename ValueOf>
void fill(std::vector<Value>& values, std::uint32_t count, const std::stop_token& stop,
          ValueOf&& value_of) {
    values.reserve(count);
    for (std::uint32_t first = 0; first < count;) {
        throw_if_stopped(stop);
        const std::uint32_t last = first + std::min(k_numbers_a_checkpoint, count - first);
        values.resize(last);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, last, 4096),
                          [&](const auto& run) {
                              for (std::uint32_t i = run.begin(); i < run.end(); ++i)
                                  values[i] = value_of(i);
                          });
        first = last;
    }
}

glm::vec3 normal_of(const Plane& plane) { return {plane.nx, plane.ny, plane.nz}; }

// One normal per face. A degenerate face takes the normal of the nearest face that has one, counted
// in edges, so the surface stays smooth across slivers. +y if there is none.
std::vector<glm::vec3> face_normals(const Mesh& mesh, const std::stop_token& stop) {
    std::vector<glm::vec3> normals;
    std::vector<FaceId> wave;  // Faces whose degenerate neighbors may lack a normal.
    fill(normals, mesh.face_count(), stop, [&](std::uint32_t f) {
        const Plane& plane = mesh.planes()[f];
        return plane.has_normal() ? normal_of(plane) : glm::vec3(0.0f, 1.0f, 0.0f);
    });
    if (mesh.degenerate_face_count() == 0) return normals;
    std::vector<bool> known(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) known[f] = mesh.planes()[f].has_normal();

    const auto for_each_neighbor = [&](std::uint32_t f, auto&& visit) {
        for (const EdgeId edge : mesh.edges_of(FaceId{f})) {
            if (edge == k_no_edge || mesh.edge_class(edge) != EdgeClass::regular) continue;
            const auto& faces = mesh.edge(edge).faces;
            visit(index(faces[0]) == f ? index(faces[1]) : index(faces[0]));
        }
    };
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (known[f]) continue;
        for_each_neighbor(f, [&](std::uint32_t neighbor) {
            if (mesh.planes()[neighbor].has_normal()) wave.push_back(FaceId{neighbor});
        });
    }
    for (std::size_t next = 0; next < wave.size(); ++next) {
        const std::uint32_t f = index(wave[next]);
        for_each_neighbor(f, [&](std::uint32_t neighbor) {
            if (known[neighbor]) return;
            known[neighbor] = true;
            normals[neighbor] = normals[f];
            wave.push_back(FaceId{neighbor});
        });
    }
    return normals;
}

// Whether the angle between two vectors is at most a limit in [0, pi], without an arc cosine.
class BendTest {
public:
    explicit BendTest(double angle_rad)
        : any_(angle_rad >= std::numbers::pi - k_slack),
          cos_(std::cos(angle_rad + k_slack)),
          sin_(std::sin(angle_rad + k_slack)) {}

    bool within(const glm::dvec3& a, const glm::dvec3& b) const {
        if (any_) return true;
        const double cos = glm::dot(a, b);
        const glm::dvec3 c = glm::cross(a, b);
        const double sin = std::sqrt(glm::dot(c, c));
        // The sine of (limit - bend). Both lie in [0, pi), so it has the sign of the difference.
        // The exception: opposite normals, with a bend of pi, may give 0.
        return sin_ * cos - cos_ * sin >= 0.0 && !(cos < 0.0 && sin == 0.0);
    }

private:
    // Normals are rounded to float, so coplanar faces may show a bend of up to 2^-22.
    static constexpr double k_slack = 0x1p-20;
    bool any_;
    double cos_, sin_;
};

// Of corners, numbered 3 * face + corner, the groups that share a normal.
class CornerGroups {
public:
    explicit CornerGroups(DisjointSets sets) : group_(sets.take_numbers()) {
        for (const std::uint32_t group : group_) count_ = std::max(count_, group + 1);
    }
    std::uint32_t group(std::uint32_t corner) const { return group_[corner]; }
    std::uint32_t count() const { return count_; }
    /// Makes each corner of the groups with a flag a group of its own.
    void split(const std::vector<bool>& flags) {
        std::vector<std::uint32_t> numbers(flags.size(), k_no_number);
        count_ = 0;
        for (std::uint32_t& group : group_) {
            if (!flags[group] && numbers[group] != k_no_number) {
                group = numbers[group];
                continue;
            }
            numbers[group] = count_;
            group = count_++;
        }
    }

private:
    static constexpr std::uint32_t k_no_number = 0xffffffffu;

    std::vector<std::uint32_t> group_;
    std::uint32_t count_ = 0;
};

std::uint32_t corner_at(const Mesh& mesh, FaceId face, VertexId vertex) {
    const Triangle& t = mesh.triangles()[index(face)];
    return 3 * index(face) + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
}

// The groups, and the sum of the weighted normals of each.
struct Shading {
    CornerGroups groups;
    std::vector<glm::dvec3> sums;
};

// Below this length the normals of a group cancel, and only rounding errors remain.
constexpr double k_min_sum = 1e-6;

CornerGroups join_corners(const Mesh& mesh, std::span<const glm::vec3> normals,
                          const BendTest& bend, const std::stop_token& stop) {
    DisjointSets corners(std::size_t{3} * mesh.face_count());
    const Mesh::EdgeRange regular = mesh.edges_of_class(EdgeClass::regular);
    std::vector<std::uint8_t> is_smooth;
    fill(is_smooth, regular.size(), stop, [&](std::uint32_t i) -> std::uint8_t {
        const auto& faces = mesh.edges()[regular.first + i].faces;
        return bend.within(normals[index(faces[0])], normals[index(faces[1])]) ? 1 : 0;
    });
    for_each_in_order(regular.size(), stop, [&](std::uint32_t i) {
        if (is_smooth[i] == 0) return;
        const auto& [vertices, faces] = mesh.edges()[regular.first + i];
        for (const VertexId vertex : vertices)
            corners.join(corner_at(mesh, faces[0], vertex), corner_at(mesh, faces[1], vertex));
    });
    return CornerGroups(std::move(corners));
}

Shading group_corners(const Mesh& mesh, std::span<const glm::vec3> own, double crease,
                      const std::stop_token& stop) {
    const std::uint32_t face_count = mesh.face_count();
    const BendTest bend(crease);
    Shading shading{join_corners(mesh, own, bend, stop), {}};
    auto& [groups, sums] = shading;
    // The angles on all threads, the sums in one order.
    std::vector<std::array<double, 3>> angles;
    fill(angles, face_count, stop, [&](std::uint32_t f) {
        std::array<glm::dvec3, 3> p;
        for (std::uint32_t c = 0; c < 3; ++c)
            p[c] = mesh.positions()[index(mesh.triangles()[f][c])];
        std::array<double, 3> own_angles;
        for (std::uint32_t c = 0; c < 3; ++c)
            own_angles[c] = angle_between(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
        return own_angles;
    });
    const auto add_up = [&] {
        sums.assign(groups.count(), glm::dvec3(0.0));
        for_each_in_order(face_count, stop, [&](std::uint32_t f) {
            if (!mesh.planes()[f].has_normal()) return;
            for (std::uint32_t c = 0; c < 3; ++c)
                sums[groups.group(3 * f + c)] += angles[f][c] * glm::dvec3(own[f]);
        });
    };
    add_up();
    // By face, whether it is turned from the mean of its corner's group.
    std::vector<std::array<bool, 3>> is_turned;
    fill(is_turned, face_count, stop, [&](std::uint32_t f) {
        std::array<bool, 3> corners{};
        for (std::uint32_t c = 0; mesh.planes()[f].has_normal() && c < 3; ++c) {
            const glm::dvec3& sum = sums[groups.group(3 * f + c)];
            corners[c] = glm::dot(sum, sum) > k_min_sum * k_min_sum && !bend.within(own[f], sum);
        }
        return corners;
    });
    std::vector<bool> is_tip(sums.size());
    bool has_tips = false;
    for_each_in_order(3 * face_count, stop, [&](std::uint32_t corner) {
        if (!is_turned[corner / 3][corner % 3]) return;
        is_tip[groups.group(corner)] = has_tips = true;
    });
    if (has_tips) {
        groups.split(is_tip);
        add_up();
    }
    return shading;
}

}  // namespace

std::vector<glm::vec3> corner_normals(const Mesh& mesh, float crease_angle_rad,
                                      const std::stop_token& stop) {
    RIMLINE_CHECK(crease_angle_rad >= 0.0f);
    const std::vector<glm::vec3> own = face_normals(mesh, stop);
    const Shading shading = group_corners(mesh, own, crease_angle_rad, stop);
    std::vector<glm::vec3> normals;
    fill(normals, 3 * mesh.face_count(), stop, [&](std::uint32_t corner) {
        const glm::dvec3& sum = shading.sums[shading.groups.group(corner)];
        const double length = std::sqrt(glm::dot(sum, sum));
        return length > k_min_sum ? glm::vec3(sum / length) : own[corner / 3];
    });
    return normals;
}

CornerGroupList corner_groups(const Mesh& mesh, float crease_angle_rad) {
    RIMLINE_CHECK(crease_angle_rad >= 0.0f);
    const auto [groups, sums] = group_corners(mesh, face_normals(mesh, {}), crease_angle_rad, {});
    const std::uint32_t corner_count = 3 * mesh.face_count();
    CornerGroupList list{.begin = std::vector<std::uint32_t>(sums.size() + 1),
                         .corners = std::vector<std::uint32_t>(corner_count)};
    for (std::uint32_t c = 0; c < corner_count; ++c) ++list.begin[groups.group(c) + 1];
    std::partial_sum(list.begin.begin(), list.begin.end(), list.begin.begin());
    std::vector<std::uint32_t> next(list.begin.begin(), list.begin.end() - 1);
    for (std::uint32_t c = 0; c < corner_count; ++c) list.corners[next[groups.group(c)]++] = c;
    return list;
}

}  // namespace rimline
