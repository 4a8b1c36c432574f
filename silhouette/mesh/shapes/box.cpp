#include <algorithm>
#include <cmath>

#include "silhouette/mesh/shapes/shape_makers.h"

namespace rimline {

namespace {

// The surface points of an (n + 1)^3 lattice, numbered by layers in k: full squares at k = 0 and k
// = n, rings of 4n points between them.
class SurfaceLattice {
public:
    explicit SurfaceLattice(std::uint32_t n) : n_(n) {}

    std::uint32_t vertex(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        const std::uint32_t square = (n_ + 1) * (n_ + 1);
        const std::uint32_t in_square = j * (n_ + 1) + i;
        if (k == 0) return in_square;
        const std::uint32_t layer = square + (k - 1) * 4 * n_;
        return layer + (k == n_ ? in_square : in_ring(i, j));
    }
    glm::vec3 position(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return {coordinate(i), coordinate(j), coordinate(k)};
    }

private:
    // Counter-clockwise from (0, 0).
    std::uint32_t in_ring(std::uint32_t i, std::uint32_t j) const {
        if (j == 0 && i < n_) return i;
        if (i == n_ && j < n_) return n_ + j;
        if (j == n_ && i > 0) return 2 * n_ + (n_ - i);
        return 3 * n_ + (n_ - j);
    }
    float coordinate(std::uint32_t i) const { return static_cast<float>((2.0 * i - n_) / n_); }
    std::uint32_t n_;
};

}  // namespace

MeshSource make_box(std::uint32_t faces) {
    const auto n = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(faces / 12.0))));
    const SurfaceLattice lattice(n);
    MeshSource box;
    box.positions.resize(6 * std::size_t{n} * n + 2);
    box.triangles.reserve(12 * std::size_t{n} * n);
    // Six sides, with k fixed at 0 or n. (i, j, k) is a cyclic permutation of (x, y, z), so i x j
    // points along +k.
    for (std::uint32_t axis = 0; axis < 3; ++axis)
        for (const std::uint32_t k : {0u, n}) {
            const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
                const std::uint32_t at[3] = {axis == 2   ? i
                                             : axis == 1 ? j
                                                         : k,
                                             axis == 0   ? i
                                             : axis == 2 ? j
                                                         : k,
                                             axis == 1   ? i
                                             : axis == 0 ? j
                                                         : k};
                const std::uint32_t v = lattice.vertex(at[0], at[1], at[2]);
                box.positions[v] = lattice.position(at[0], at[1], at[2]);
                return v;
            };
            for (std::uint32_t j = 0; j < n; ++j)
                for (std::uint32_t i = 0; i < n; ++i) {
                    const std::uint32_t a = vertex(i, j);
                    const std::uint32_t b = k == n ? vertex(i + 1, j) : vertex(i, j + 1);
                    const std::uint32_t c = vertex(i + 1, j + 1);
                    const std::uint32_t d = k == n ? vertex(i, j + 1) : vertex(i + 1, j);
                    box.triangles.push_back({a, b, c});
                    box.triangles.push_back({a, c, d});
                }
        }
    return box;
}

}  // namespace rimline
