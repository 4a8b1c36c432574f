#include "tests/silhouette/hough/support/generated_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tests {

namespace {

using Corners = std::array<std::uint32_t, 3>;

class Generator {
public:
    explicit Generator(std::uint32_t number) : random_(0x9e3779b97f4a7c15u * (number + 1)) {}

    std::uint32_t below(std::uint32_t count) { return between(0, count - 1); }
    std::uint32_t between(std::uint32_t low, std::uint32_t high) {
        return low + static_cast<std::uint32_t>(random_() % (std::uint64_t{high} - low + 1));
    }
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    glm::dvec3 in_cube() {
        const double x = uniform(-1.0, 1.0);
        const double y = uniform(-1.0, 1.0);
        const double z = uniform(-1.0, 1.0);
        return {x, y, z};
    }
    glm::dvec3 unit_vector() {
        for (;;) {
            const glm::dvec3 v = in_cube();
            const double square = glm::dot(v, v);
            if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
        }
    }
    // Small meshes are the rule, but some have trees of several levels.
    std::uint32_t face_count() { return below(8) == 0 ? between(600, 1500) : between(20, 300); }

    MeshSource soup() { return triangle_soup(face_count(), random_()); }

    MeshSource closed_shape() {
        const std::string_view shape = k_built_in_shapes[below(5)];
        return make_built_in_shape(shape, face_count());
    }

    // Every triangle by itself: three corners of its own from `corner`, which may look at the first two.
    template <typename Corner>
    MeshSource separate_triangles(std::uint32_t faces, Corner&& corner) {
        MeshSource mesh;
        for (std::uint32_t f = 0; f < faces; ++f) {
            for (int i = 0; i < 3; ++i) mesh.positions.emplace_back(corner());
            mesh.triangles.push_back(Corners{3 * f, 3 * f + 1, 3 * f + 2});
        }
        return mesh;
    }

    // Fans in a few planes that share a point or lie parallel: many faces a Hough point.
    MeshSource coplanar_fans() {
        MeshSource mesh;
        const bool parallel = below(2) == 0;
        glm::dvec3 normal = unit_vector();
        const std::uint32_t fans = between(1, 5);
        const std::uint32_t faces = face_count() / fans + 2;
        for (std::uint32_t k = 0; k < fans; ++k) {
            if (!parallel) normal = unit_vector();
            const glm::dvec3 u = glm::normalize(glm::cross(normal, unit_vector()));
            const glm::dvec3 v = glm::cross(normal, u);
            const glm::dvec3 hub = parallel ? uniform(-1.0, 1.0) * normal : glm::dvec3(0.25);
            MeshSource fan;
            fan.positions.emplace_back(hub);
            for (std::uint32_t i = 0; i < faces; ++i) {
                const double angle_rad = 6.283185307179586 * i / faces;
                fan.positions.emplace_back(hub + std::cos(angle_rad) * u + std::sin(angle_rad) * v);
                fan.triangles.push_back(Corners{0, i + 1, (i + 1) % faces + 1});
            }
            mesh = joined(std::move(mesh), fan);
        }
        return mesh;
    }

    // Triangles so thin that their normals are what rounding made of them.
    MeshSource slivers() {
        glm::dvec3 from(0.0), to(0.0);
        int next = 0;
        return separate_triangles(face_count(), [&] {
            switch (next++ % 3) {
                case 0: return from = in_cube();
                case 1: return to = in_cube();
                default:
                    return glm::mix(from, to, uniform(0.0, 1.0)) +
                           std::exp2(uniform(-26.0, -8.0)) * unit_vector();
            }
        });
    }

    MeshSource duplicates() {
        const MeshSource shape = closed_shape();
        MeshSource copy = shape;
        if (below(2) == 0)
            for (Corners& t : copy.triangles) std::swap(t[1], t[2]);
        return joined(shape, copy);
    }

    MeshSource few_faces() {
        return separate_triangles(between(1, 4), [&] { return in_cube(); });
    }

    // A cone of needles: normals turn all the way round in almost one plane.
    MeshSource needles() {
        MeshSource mesh;
        const std::uint32_t sides = face_count();
        const double radius = std::exp2(uniform(-24.0, -4.0));
        mesh.positions.emplace_back(0.0f, 1.0f, 0.0f);
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle_rad = 6.283185307179586 * i / sides;
            mesh.positions.emplace_back(radius * std::cos(angle_rad), -1.0,
                                        -radius * std::sin(angle_rad));
            mesh.triangles.push_back(Corners{0, i + 1, (i + 1) % sides + 1});
        }
        return mesh;
    }

    // A grid that is flat but for a few units in the last place, or for less than a normal shows.
    MeshSource almost_flat() {
        MeshSource mesh;
        const std::uint32_t side = between(3, 16);
        const double level = uniform(-2.0, 2.0);
        const double bumps = std::exp2(uniform(-45.0, -18.0));
        const std::uint32_t up = below(3);
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                glm::dvec3 p(x, y, level * (below(2) == 0 ? 0.0 : 1.0));
                p.z = level + bumps * uniform(-1.0, 1.0);
                if (level < 0.0) p.z = bumps * uniform(-1.0, 1.0);
                mesh.positions.emplace_back(p[static_cast<int>(up)],
                                            p[static_cast<int>((up + 1) % 3)],
                                            p[static_cast<int>((up + 2) % 3)]);
            }
        for (std::uint32_t y = 0; y + 1 < side; ++y)
            for (std::uint32_t x = 0; x + 1 < side; ++x) {
                const std::uint32_t a = y * side + x;
                mesh.triangles.push_back(Corners{a, a + 1, a + side});
                mesh.triangles.push_back(Corners{a + side, a + 1, a + side + 1});
            }
        return mesh;
    }

    // All planes pass through one far point: seen from there they are as good as nothing wide, against
    // coordinates that are large.
    MeshSource pencil_of_planes() {
        const glm::dvec3 hub = std::exp2(uniform(-2.0, 22.0)) * unit_vector();
        int next = 0;
        return separate_triangles(face_count(), [&] {
            return next++ % 3 == 0 ? hub : hub + std::exp2(uniform(-4.0, 2.0)) * unit_vector();
        });
    }

    // Whole coordinates: points lie exactly on planes, and many planes are the same.
    MeshSource lattice() {
        MeshSource mesh;
        const std::uint32_t size = between(2, 5);
        const std::uint32_t faces = face_count();
        for (std::uint32_t i = 0; i < size * size * size; ++i)
            mesh.positions.emplace_back(i % size, i / size % size, i / size / size);
        for (std::uint32_t i = 0; i < faces; ++i) {
            const std::uint32_t a = below(size * size * size);
            const std::uint32_t b = below(size * size * size);
            const std::uint32_t c = below(size * size * size);
            mesh.triangles.push_back(Corners{a, b, c});
        }
        return mesh;
    }

    MeshSource speck_and_giant() {
        const double ratio = std::exp2(uniform(8.0, 40.0));
        return joined(placed(closed_shape(), 1.0 / ratio, in_cube()), closed_shape());
    }

    // A closed shape with some faces turned over and some gone.
    MeshSource damaged() {
        MeshSource mesh = closed_shape();
        std::vector<Corners> kept;
        for (Corners t : mesh.triangles) {
            const std::uint32_t fate = below(10);
            if (fate == 0) continue;
            if (fate == 1) std::swap(t[1], t[2]);
            kept.push_back(t);
        }
        mesh.triangles = std::move(kept);
        return mesh;
    }

    // Boxes whose walls lean by about as little as a normal's components may be.
    MeshSource leaning_boxes() {
        MeshSource mesh;
        const std::uint32_t boxes = between(1, 30);
        for (std::uint32_t k = 0; k < boxes; ++k) {
            const glm::vec3 low(in_cube());
            MeshSource leaning = box(low, low + glm::vec3(glm::abs(in_cube()) + 0.1));
            const glm::dvec3 lean = std::exp2(uniform(-44.0, -20.0)) * unit_vector();
            for (glm::vec3& p : leaning.positions)
                p = glm::vec3(glm::dvec3(p) + double{p.y} * lean);
            mesh = joined(std::move(mesh), leaning);
        }
        return mesh;
    }

private:
    std::mt19937_64 random_;
};

MeshSource clamped(MeshSource mesh) {
    constexpr glm::vec3 k_most(k_max_coordinate);
    for (glm::vec3& p : mesh.positions) p = glm::clamp(p, -k_most, k_most);
    return mesh;
}

}  // namespace

NamedSource generated_mesh(std::uint32_t number) {
    Generator g(number);
    const auto far_place = [&] { return std::exp2(g.uniform(0.0, 22.0)) * g.unit_vector(); };
    const auto made = [&]() -> NamedSource {
        switch (number % k_generated_kinds) {
            case 0: return {"soup", g.soup()};
            case 1: return {"soup far away", placed(g.soup(), 1.0, far_place())};
            case 2: return {"coplanar fans", g.coplanar_fans()};
            case 3: return {"slivers", g.slivers()};
            case 4: return {"duplicates", g.duplicates()};
            case 5: return {"few faces", g.few_faces()};
            case 6: return {"closed, moved", placed(g.closed_shape(), 1.0, {1e6, -1e6, 1e6})};
            case 7:
                return {"closed, scaled",
                        placed(g.closed_shape(), g.below(2) == 0 ? 0x1p40 : 0x1p-40, {})};
            case 8: return {"needles", placed(g.needles(), 1.0, g.in_cube())};
            case 9: return {"almost flat", g.almost_flat()};
            case 10: return {"planes through one point", g.pencil_of_planes()};
            case 11:
                return {"huge", placed(g.closed_shape(), std::exp2(g.uniform(50.0, 58.0)), {})};
            case 12: return {"lattice", g.lattice()};
            case 13: return {"speck and giant", g.speck_and_giant()};
            case 14: return {"damaged", g.damaged()};
            default: return {"leaning boxes", g.leaning_boxes()};
        }
    };
    NamedSource mesh = made();
    // The kinds with a place or a scale of their own keep it.
    if (number % k_generated_kinds < 6 || number % k_generated_kinds > 11) {
        if (g.below(4) == 0) mesh.source = placed(std::move(mesh.source), 1.0, far_place());
        if (g.below(4) == 0)
            mesh.source =
                placed(std::move(mesh.source), std::exp2(std::floor(g.uniform(-90.0, 37.0))), {});
    }
    mesh.source = clamped(std::move(mesh.source));
    mesh.name.append(" ").append(std::to_string(number));
    return mesh;
}

}  // namespace rimline::tests
