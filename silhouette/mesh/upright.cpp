#include "silhouette/mesh/upright.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

namespace {

// What lies within this share of the diameter above the lowest point touches the ground.
constexpr double k_contact_share = 0.02;
constexpr double k_uneven_share = 0.05;
// A face lies on the ground if its normal is within 20 degrees of straight down.
constexpr double k_flat_cosine = 0.94;

double cross_of(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// Removes most points that are inside the hull: those inside the octagon of the extreme points of eight
// directions (Akl and Toussaint 1978).
void remove_inner(std::vector<glm::dvec2>& points) {
    if (points.size() < 64) return;
    std::array<glm::dvec2, 8> corners;
    corners.fill(points.front());
    std::array<double, 8> reaches;
    reaches.fill(std::numeric_limits<double>::lowest());
    for (const glm::dvec2& p : points) {
        const double sum = p.x + p.y, difference = p.y - p.x;
        const std::array<double, 8> along{p.x, sum, p.y, difference, -p.x, -sum, -p.y, -difference};
        for (std::size_t i = 0; i < 8; ++i)
            if (along[i] > reaches[i]) reaches[i] = along[i], corners[i] = p;
    }
    // Most inner points lie in the rectangle between four of the corners too, which is tested sooner.
    const double left = std::max(corners[3].x, corners[5].x),
                 right = std::min(corners[1].x, corners[7].x);
    const double low = std::max(corners[5].y, corners[7].y),
                 high = std::min(corners[1].y, corners[3].y);
    std::erase_if(points, [&](const glm::dvec2& p) {
        if (p.x > left && p.x < right && p.y > low && p.y < high) return true;
        for (std::size_t i = 0; i < 8; ++i)
            if (corners[i] != corners[(i + 1) % 8] &&
                cross_of(corners[i], corners[(i + 1) % 8], p) <= 0.0)
                return false;
        return true;
    });
}

// Counter-clockwise (Andrew's monotone chain). Reorders `points`, and removes some that are inside.
std::vector<glm::dvec2> hull_of(std::vector<glm::dvec2>& points) {
    remove_inner(points);
    const auto less = [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<glm::dvec2> hull;
    const auto extend = [&](auto begin, auto end) {
        const std::size_t first = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= first + 2 &&
                   cross_of(hull[hull.size() - 2], hull.back(), *p) <= 0.0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();
    };
    extend(points.begin(), points.end());
    extend(points.rbegin(), points.rend());
    return hull;
}

double area_of(const std::vector<glm::dvec2>& hull) {
    double twice = 0.0;
    for (std::size_t i = 2; i < hull.size(); ++i) twice += cross_of(hull[0], hull[i - 1], hull[i]);
    return 0.5 * twice;
}

// The distance of a point inside from the nearest side; negative outside.
double depth_in(const std::vector<glm::dvec2>& hull, const glm::dvec2& point) {
    if (hull.size() < 3) return -1.0;
    double depth = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2& a = hull[i];
        const glm::dvec2& b = hull[(i + 1) % hull.size()];
        depth = std::min(depth, cross_of(a, b, point) / glm::distance(a, b));
    }
    return depth;
}

// Sums are taken in so many parts, whose number does not depend on that of the threads.
constexpr std::size_t k_parts = 8;

// Calls visit(part, triangles) for each, on all threads.
template <typename Visit>
void for_each_part(const Mesh& mesh, Visit&& visit) {
    const std::size_t count = mesh.face_count();
    tbb::parallel_for(std::size_t{0}, k_parts, [&](std::size_t part) {
        const std::size_t first = count * part / k_parts, last = count * (part + 1) / k_parts;
        visit(part, mesh.triangles().subspan(first, last - first));
    });
}

// A pair that is right-handed with the axis.
glm::dvec2 across(int axis, const glm::dvec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

// Positions around the center, in radii.
struct UnitShape {
    std::vector<glm::dvec3> positions;
    glm::dvec3 low{0.0}, high{0.0};
    glm::dvec3 mass{0.0};  // The center of the surface.
};

UnitShape unit_shape_of(const Mesh& mesh) {
    UnitShape shape;
    shape.positions.reserve(mesh.vertex_count());
    for (const glm::vec3& position : mesh.positions())
        shape.positions.push_back((glm::dvec3(position) - mesh.center()) / mesh.radius());
    shape.low = shape.high = shape.positions.front();
    for (const glm::dvec3& p : shape.positions) {
        shape.low = glm::min(shape.low, p);
        shape.high = glm::max(shape.high, p);
    }
    struct Sum {
        glm::dvec3 moment{0.0};
        double area = 0.0;
    };
    std::array<Sum, k_parts> sums;
    for_each_part(mesh, [&](std::size_t part, std::span<const Triangle> triangles) {
        for (const Triangle& t : triangles) {
            const glm::dvec3& a = shape.positions[index(t[0])];
            const glm::dvec3& b = shape.positions[index(t[1])];
            const glm::dvec3& c = shape.positions[index(t[2])];
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            sums[part].moment += area * (a + b + c) / 3.0;
            sums[part].area += area;
        }
    });
    Sum all;
    for (const Sum& sum : sums) all.moment += sum.moment, all.area += sum.area;
    if (all.area > 0.0) shape.mass = all.moment / all.area;
    return shape;
}

// The hull of the footprint, by axis: that of both directions.
std::vector<glm::dvec2> footprint_of(const UnitShape& shape, int axis) {
    std::vector<glm::dvec2> points;
    points.reserve(shape.positions.size());
    for (const glm::dvec3& p : shape.positions) points.push_back(across(axis, p));
    return hull_of(points);
}

// But for what lies flat.
Standing standing_of(const UnitShape& shape, int axis, double sign, double footprint,
                     double contact_share) {
    const double ground = sign > 0.0 ? shape.low[axis] : -shape.high[axis];
    const double height = shape.high[axis] - shape.low[axis];
    const double limit = ground + 2.0 * contact_share;
    std::vector<glm::dvec2> touching;
    for (const glm::dvec3& p : shape.positions)
        if (sign * p[axis] <= limit) touching.push_back(across(axis, p));
    const std::vector<glm::dvec2> hull = hull_of(touching);
    Standing standing;
    standing.contact = area_of(hull) / footprint;
    const double mass_height = sign * shape.mass[axis] - ground;
    standing.mass_height = height > 0.0 ? mass_height / height : 0.0;
    standing.tip_rad =
        std::max(0.0, std::atan2(depth_in(hull, across(axis, shape.mass)), mass_height));
    return standing;
}

// The area of the faces that lie on the ground, by k_axis_directions.
std::array<double, 6> flat_areas(const Mesh& mesh, const UnitShape& shape) {
    std::array<double, 6> areas{};
    for (const Triangle& t : mesh.triangles()) {
        const glm::dvec3& a = shape.positions[index(t[0])];
        const glm::dvec3& b = shape.positions[index(t[1])];
        const glm::dvec3& c = shape.positions[index(t[2])];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        for (int axis = 0; axis < 3; ++axis) {
            // Whichever way the face is wound.
            if (!(std::abs(normal[axis]) > k_flat_cosine * length)) continue;
            const double area = 0.5 * std::abs(normal[axis]);
            const double reach = 2.0 * k_contact_share;
            if (std::max({a[axis], b[axis], c[axis]}) <= shape.low[axis] + reach)
                areas[std::size_t(2 * axis)] += area;
            if (std::min({a[axis], b[axis], c[axis]}) >= shape.high[axis] - reach)
                areas[std::size_t(2 * axis + 1)] += area;
        }
    }
    return areas;
}

// Area of the surface in a grid of cells, spread over the eight nearest cells.
class AreaGrid {
public:
    void add(const glm::dvec3& point, double area) {
        // Cells around the middle of the bounds, which is the origin, so that a mirror maps cells to cells.
        const glm::dvec3 place = (point / k_reach + 1.0) * (0.5 * k_cells) - 0.5;
        const glm::dvec3 base = glm::floor(place);
        const glm::dvec3 part = place - base;
        std::array<std::array<int, 2>, 3> cells;
        for (int i = 0; i < 3; ++i)
            for (int step = 0; step < 2; ++step)
                cells[i][step] = std::clamp(static_cast<int>(base[i]) + step, 0, k_cells - 1);
        const std::array x{area * (1.0 - part.x), area * part.x};
        for (int i = 0; i < 2; ++i) {
            const std::array y{x[i] * (1.0 - part.y), x[i] * part.y};
            for (int j = 0; j < 2; ++j) {
                const std::size_t row = place_of({cells[0][i], cells[1][j], 0});
                areas_[row + std::size_t(cells[2][0])] += y[j] * (1.0 - part.z);
                areas_[row + std::size_t(cells[2][1])] += y[j] * part.z;
            }
        }
    }
    void add(const AreaGrid& other) {
        for (std::size_t i = 0; i < areas_.size(); ++i) areas_[i] += other.areas_[i];
    }
    // The share of area that has its like in the mirror.
    double symmetry(int axis) const {
        double common = 0.0, total = 0.0;
        for (int x = 0; x < k_cells; ++x)
            for (int y = 0; y < k_cells; ++y)
                for (int z = 0; z < k_cells; ++z) {
                    std::array<int, 3> cell{x, y, z};
                    const double area = areas_[place_of(cell)];
                    cell[std::size_t(axis)] = k_cells - 1 - cell[std::size_t(axis)];
                    common += std::min(area, areas_[place_of(cell)]);
                    total += area;
                }
        return total > 0.0 ? common / total : 0.0;
    }

    static constexpr int k_cells = 24;
    static constexpr double k_reach = 1.05;  // In radii.

private:
    static std::size_t place_of(const std::array<int, 3>& cell) {
        return (std::size_t(cell[0]) * k_cells + std::size_t(cell[1])) * k_cells +
               std::size_t(cell[2]);
    }
    std::vector<double> areas_ = std::vector<double>(std::size_t(k_cells) * k_cells * k_cells);
};

// Adds a triangle as samples no farther apart than half a cell.
void add_triangle(AreaGrid& grid, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double k_spacing = AreaGrid::k_reach / AreaGrid::k_cells;
    const double side = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const int parts = std::clamp(static_cast<int>(std::ceil(side / k_spacing)), 1, 64);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a)) / (double(parts) * parts);
    const glm::dvec3 u = (b - a) / double(parts), v = (c - a) / double(parts);
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts - i; ++j) {
            const glm::dvec3 corner = a + double(i) * u + double(j) * v;
            grid.add(corner + (u + v) / 3.0, area);
            if (i + j < parts - 1) grid.add(corner + (u + v) * (2.0 / 3.0), area);
        }
}

// What is measured of one mesh, in two steps: most meshes need the first only.
class UprightMeasure {
public:
    UprightMeasure(const Mesh& mesh, const std::stop_token& stop)
        : mesh_(mesh), shape_(unit_shape_of(mesh)), call_{stop, {}} {
        call_.checkpoint(0.0);
        evidence.extent = shape_.high - shape_.low;
        tbb::parallel_for(0, 3, [&](int axis) { add_axis(axis); });
    }

    // What but contacts and tips remains.
    void add_rest() {
        std::array<double, 6> flat{};
        tbb::parallel_invoke([&] { add_symmetry(); }, [&] { flat = flat_areas(mesh_, shape_); });
        for (std::size_t i = 0; i < 6; ++i)
            if (footprints_[i / 2] > 0.0) evidence.standing[i].flat = flat[i] / footprints_[i / 2];
    }

    UprightEvidence evidence;

private:
    void add_axis(int axis) {
        const double footprint = area_of(footprint_of(shape_, axis));
        call_.checkpoint(0.0);
        footprints_[std::size_t(axis)] = footprint;
        if (!(footprint > 0.0)) return;
        for (int down = 0; down < 2; ++down) {
            evidence.standing[std::size_t(2 * axis + down)] =
                standing_of(shape_, axis, down ? -1.0 : 1.0, footprint, k_contact_share);
            call_.checkpoint(0.0);
        }
        if (axis == 1)
            evidence.uneven_y = standing_of(shape_, axis, 1.0, footprint, k_uneven_share);
    }
    void add_symmetry() {
        std::array<AreaGrid, k_parts> grids;
        for_each_part(mesh_, [&](std::size_t part, std::span<const Triangle> triangles) {
            for (const Triangle& t : triangles)
                add_triangle(grids[part], shape_.positions[index(t[0])],
                             shape_.positions[index(t[1])], shape_.positions[index(t[2])]);
        });
        AreaGrid grid;
        for (const AreaGrid& some : grids) grid.add(some);
        for (int axis = 0; axis < 3; ++axis)
            evidence.symmetry[std::size_t(axis)] = grid.symmetry(axis);
    }

    const Mesh& mesh_;
    UnitShape shape_;
    LongCall call_;
    std::array<double, 3> footprints_{};
};

bool has_extent(const Mesh& mesh) { return mesh.face_count() > 0 && mesh.radius() > 0.0; }

bool stands(const Standing& standing, double min_contact, double min_tip_deg) {
    return standing.contact >= min_contact && glm::degrees(standing.tip_rad) >= min_tip_deg;
}

constexpr std::size_t k_y = 2;  // In k_axis_directions.

// The direction that contacts and tips speak for: y where it does not stand clearly better along another.
std::size_t best_standing(const UprightEvidence& evidence) {
    const std::array<Standing, 6>& standing = evidence.standing;
    // It stands as it is.
    if (stands(standing[k_y], 0.05, 3.0) || stands(evidence.uneven_y, 0.15, 3.0)) return k_y;
    std::size_t best = k_y;
    for (std::size_t i = 0; i < standing.size(); ++i)
        if (stands(standing[i], 0.25, 4.0) && standing[i].contact > standing[best].contact)
            best = i;
    if (standing[best].contact < 4.0 * standing[k_y].contact) return k_y;
    for (std::size_t i = 0; i < standing.size(); ++i)
        if (i != best && stands(standing[i], 0.5 * standing[best].contact, 4.0)) return k_y;
    return best;
}

}  // namespace

UprightEvidence measure_upright(const Mesh& mesh) {
    if (!has_extent(mesh)) return {};
    UprightMeasure measure(mesh, {});
    measure.add_rest();
    return measure.evidence;
}

bool is_symmetric_across_alone(const UprightEvidence& evidence, std::size_t axis) {
    constexpr double k_symmetric = 0.7;  // Nefertiti has 0.93, igea 0.76, rocker arm 0.75.
    constexpr double k_clearly = 0.15;
    const auto& s = evidence.symmetry;
    return s[axis] >= k_symmetric &&
           s[axis] >= std::max(s[(axis + 1) % 3], s[(axis + 2) % 3]) + k_clearly;
}

glm::dvec3 choose_upright(const UprightEvidence& evidence) {
    const std::size_t best = best_standing(evidence), axis = best / 2;
    const glm::dvec3& e = evidence.extent;
    const bool is_lowest = e[int(axis)] <= std::min({e.x, e.y, e.z});
    if (is_symmetric_across_alone(evidence, axis) ||
        (is_lowest && evidence.standing[best].flat < 0.5))
        return k_axis_directions[k_y];
    return k_axis_directions[best];
}

glm::dvec3 choose_upright(const Mesh& mesh, const std::stop_token& stop) {
    if (!has_extent(mesh)) return k_axis_directions[k_y];
    UprightMeasure measure(mesh, stop);
    if (best_standing(measure.evidence) != k_y) measure.add_rest();
    return choose_upright(measure.evidence);
}

}  // namespace rimline
