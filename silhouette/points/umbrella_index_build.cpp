#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/gradual_resize.h"
#include "silhouette/hough/block_set.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/octree_order.h"
#include "silhouette/hough/v_sphere.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/umbrella_index.h"
#include "silhouette/points/umbrella_triangles.h"

namespace rimline {

namespace {

constexpr std::uint64_t k_max_triangles = std::uint64_t{1} << 30;

struct Box {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    // Halves first: the sum could overflow.
    glm::dvec3 center() const { return 0.5 * low + 0.5 * high; }
};

template <typename Positions>
Box box_of(const Positions& positions) {
    if (positions.empty()) return {};
    Box box{glm::dvec3(positions[0]), glm::dvec3(positions[0])};
    for (const auto& p : positions) {
        box.low = glm::min(box.low, glm::dvec3(p));
        box.high = glm::max(box.high, glm::dvec3(p));
    }
    return box;
}

// The spokes and triangles of the patch of a point.
struct PatchDescription {
    struct Triangle {
        std::uint32_t from, to;  // Numbers of spokes.
    };
    std::vector<PointId> targets;  // By spoke.
    std::vector<Triangle> triangles;

    void describe(const PointSurface& surface, PointId point) {
        targets.clear();
        triangles.clear();
        const auto spoke_to = [&](PointId q) {
            const auto found = std::ranges::find(targets, q);
            const auto spoke = static_cast<std::uint32_t>(found - targets.begin());
            if (found == targets.end()) targets.push_back(q);
            return spoke;
        };
        for_each_triangle(surface, point, [&](PointId from, PointId to, UmbrellaId) {
            const std::uint32_t first = spoke_to(from);
            triangles.push_back({first, spoke_to(to)});
        });
    }
};

}  // namespace

// Fills an empty index.
class UmbrellaIndexBuilder {
public:
    UmbrellaIndexBuilder(UmbrellaIndex& index, const PointSurface& surface, const LongCall& call)
        : index_(index), surface_(surface), call_(call) {}

    void build() {
        call_.checkpoint(0.0);
        std::vector<std::uint32_t> points;
        for (std::uint32_t p = 0; p < surface_.size(); ++p)
            if (surface_.umbrellas_of(PointId{p}).size() > 0) points.push_back(p);
        choose_units(points);
        place_origin(points);
        put_in_order(points);
        count_parts(points);
        fill_patches();
        add_specials();
        call_.checkpoint(1.0);
    }

private:
    glm::vec3 at(PointId point) const {
        return index_.to_index(surface_.positions()[index(point)]);
    }

    // By the points that have umbrellas: a stray one far away would cost the others their precision.
    void choose_units(std::span<const std::uint32_t> points) {
        std::vector<glm::dvec3> positions;
        positions.reserve(points.size());
        for (const std::uint32_t p : points) positions.push_back(surface_.positions()[p]);
        const Box box = positions.empty() ? box_of(surface_.positions()) : box_of(positions);
        index_.center_ = box.center();
        const glm::dvec3 half = 0.5 * box.high - 0.5 * box.low;
        const double size = std::max({half.x, half.y, half.z});
        int exponent = 0;
        std::frexp(size, &exponent);
        if (size > 0.0) index_.scale_ = std::ldexp(1.0, std::min(-exponent, 1000));
    }

    void place_origin(const std::vector<std::uint32_t>& points) {
        index_.positions_.reserve(points.size());
        for (const std::uint32_t p : points) index_.positions_.push_back(at(PointId{p}));
        index_.patch_center_ = box_of(index_.positions_).center();
        for (const glm::vec3& p : index_.positions_)
            index_.patch_radius_ =
                std::max(index_.patch_radius_, glm::distance(glm::dvec3(p), index_.patch_center_));
        // The corners of a triangle are such points. Beyond that, roundings of its plane.
        index_.max_distance_ = index_.patch_radius_ * (1.0 + 0x1p-20) + 0x1p-20;
    }

    // Calls visit(plane) for each triangle of the point.
    template <typename Visit>
    void for_each_plane(PointId point, Visit&& visit) const {
        const glm::vec3 center = at(point);
        for_each_triangle(surface_, point, [&](PointId from, PointId to, UmbrellaId) {
            visit(supporting_plane({center, at(from), at(to)}));
        });
    }

    static constexpr HoughPoint k_origin{glm::dvec3(0.0), 0.0, 0};
    HoughPoint hough_point_of(const Plane& plane) const {
        return plane.has_normal() ? hough_point(plane, index_.patch_center_) : k_origin;
    }

    // In octree order of the centers of the patches' boxes. Wide boxes are in classes of their own.
    void put_in_order(std::vector<std::uint32_t>& points) const {
        const auto count = static_cast<std::uint32_t>(points.size());
        std::vector<glm::dvec3> centers(count);
        std::vector<double> squares(count);
        each_point(count, {call_, 0.0, 0.4}, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t i = first; i < last; ++i) {
                HoughBox box;
                for_each_plane(PointId{points[i]},
                               [&](const Plane& plane) { box.include(hough_point_of(plane)); });
                if (box.is_empty()) box.include(k_origin);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double low = box.low[axis];
                    const double high = box.high[axis];
                    const double size = high - low;
                    centers[i][static_cast<glm::length_t>(axis)] = 0.5 * (low + high);
                    squares[i] += size * size;
                }
            }
        });
        const std::vector<std::uint8_t> classes = length_classes(squares);
        squares = {};
        std::vector<std::uint32_t> order = octree_order(centers, classes, call_.stop);
        for (std::uint32_t& place : order) place = points[place];
        points = std::move(order);
        call_.checkpoint(0.5);
    }

    void count_parts(const std::vector<std::uint32_t>& points) {
        index_.patch_of_.assign(surface_.size(), UmbrellaIndex::k_none);
        index_.patches_.resize(points.size() + 1);
        each_point(size(), {call_, 0.5, 0.6}, [&](std::uint32_t first, std::uint32_t last) {
            PatchDescription patch;
            for (std::uint32_t i = first; i < last; ++i) {
                patch.describe(surface_, PointId{points[i]});
                index_.patch_of_[points[i]] = i;
                index_.positions_[i] = at(PointId{points[i]});
                index_.patches_[i] = {PointId{points[i]},
                                      static_cast<std::uint32_t>(patch.targets.size()),
                                      static_cast<std::uint32_t>(patch.triangles.size())};
            }
        });
        std::uint64_t spokes = 0;
        std::uint64_t planes = 0;
        for (UmbrellaIndex::Patch& patch : index_.patches_) {
            if (planes > k_max_triangles)
                throw Error(ErrorCode::too_large, "more than 2^30 triangles in umbrellas");
            const std::uint32_t own_spokes = patch.first_spoke;
            const std::uint32_t own_planes = patch.first_plane;
            patch.first_spoke = static_cast<std::uint32_t>(spokes);
            patch.first_plane = static_cast<std::uint32_t>(planes);
            spokes += own_spokes;
            planes += own_planes;
        }
        index_.shapes_.assign(points.size(), UmbrellaIndex::Shape::plain);
        resize_gradually(index_.targets_, spokes, call_.stop);
        resize_gradually(index_.sides_, spokes, call_.stop);
        // Zeroing them would touch their pages on one thread.
        index_.planes_ = std::make_unique_for_overwrite<float[]>(4 * planes);
    }

    void fill_patches() {
        const std::uint32_t blocks = index_.block_count();
        std::vector<BlockBounds> bounds(blocks);
        each_point(blocks, {call_, 0.6, 0.95}, [&](std::uint32_t first, std::uint32_t last) {
            PatchDescription patch;
            for (std::uint32_t block = first; block < last; ++block) {
                const auto [begin, end] = index_.patches_of(block);
                for (std::uint32_t i = begin; i < end; ++i) {
                    patch.describe(surface_, index_.point_of(i));
                    fill_spokes(i, patch);
                }
                bounds[block] = fill_planes(block);
            }
        });
        for (std::uint32_t block = 0; block < blocks; ++block) {
            const auto [begin, end] = index_.patches_of(block);
            index_.max_planes_ = std::max(
                index_.max_planes_, index_.planes_of(end - 1).last - index_.planes_of(begin).first);
        }
        index_.tree_ = std::make_unique<const BlockTree>(bounds);
    }

    // Returns the box of the planes of a block. A triangle without a plane has the same bit from everywhere; it
    // includes a plane of zeros, so that the box never decides.
    BlockBounds fill_planes(std::uint32_t block) {
        const auto [begin, end] = index_.patches_of(block);
        const std::uint32_t first = index_.planes_of(begin).first;
        const std::uint32_t count = index_.planes_of(end - 1).last - first;
        float* out = index_.planes_.get() + std::size_t{4} * first;
        const BlockSpace space{index_.patch_center_, index_.max_distance_};
        BlockBounds bounds;
        for (std::uint32_t i = begin; i < end; ++i) {
            BlockBounds of_patch;
            for_each_plane(index_.point_of(i), [&](const Plane& plane) {
                of_patch.include(space.vector_of(plane));
                out[0] = plane.nx;
                out[count] = plane.ny;
                out[std::size_t{2} * count] = plane.nz;
                out[std::size_t{3} * count] = plane.d;
                ++out;
            });
            // Turned around where most of it is on the negative side of the origin: what a patch has for its
            // outside does not matter, and patches are near to each other whose Hough points are.
            bounds.include(of_patch.low[3] + of_patch.high[3] < 0.0 ? of_patch.turned() : of_patch);
        }
        if (bounds.is_empty()) bounds.include(PlaneVector{});
        return bounds;
    }

    void fill_spokes(std::uint32_t number, const PatchDescription& patch) {
        const std::uint32_t first = index_.spokes_of(number).first;
        if (is_fan(patch)) index_.shapes_[number] = UmbrellaIndex::Shape::fan;
        for (std::uint32_t s = 0; s < patch.targets.size(); ++s) {
            index_.targets_[first + s] = index_.patch_of(patch.targets[s]);
            const SpokeSides sides = sides_of(s, patch);
            UmbrellaIndex::Sides& packed = index_.sides_[first + s];
            packed = {0, 0};
            if (sides.count < 2) continue;  // The bit of one plane never differs from itself.
            if (sides.count > 2 || patch.triangles.size() > UmbrellaIndex::k_max_planes_of_sides)
                packed.first = UmbrellaIndex::k_special;
            else
                packed = {static_cast<std::uint8_t>(
                              sides.triangles[0] |
                              (sides.turn_the_same ? UmbrellaIndex::k_turn_the_same : 0u)),
                          static_cast<std::uint8_t>(sides.triangles[1])};
            if (sides.count > 2 || sides.turn_the_same || packed.first == UmbrellaIndex::k_special)
                index_.shapes_[number] = UmbrellaIndex::Shape::odd;
        }
    }

    static bool is_fan(const PatchDescription& patch) {
        const auto size = static_cast<std::uint32_t>(patch.targets.size());
        if (patch.triangles.size() != size || size > UmbrellaIndex::k_max_of_fan || size < 3)
            return false;
        for (std::uint32_t t = 0; t < size; ++t)
            if (patch.triangles[t].from != t || patch.triangles[t].to != (t + 1) % size)
                return false;
        return true;
    }

    struct SpokeSides {
        std::uint32_t count = 0;
        std::array<std::uint32_t, 2> triangles{};  // The first two of them.
        bool turn_the_same = false;                // Of these two.
    };
    static SpokeSides sides_of(std::uint32_t spoke, const PatchDescription& patch) {
        SpokeSides sides;
        bool turns_in = false;
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
            const PatchDescription::Triangle& triangle = patch.triangles[t];
            if (triangle.from != spoke && triangle.to != spoke) continue;
            const bool comes_in = triangle.to == spoke;
            if (sides.count < 2) sides.triangles[sides.count] = t;
            if (sides.count == 1) sides.turn_the_same = comes_in == turns_in;
            turns_in = comes_in;
            ++sides.count;
        }
        return sides;
    }

    // Describes again the rare spokes for which Sides is not enough.
    void add_specials() {
        PatchDescription patch;
        const auto end_list = [&](std::uint32_t spoke, bool turn_the_same) {
            index_.specials_.push_back(
                {spoke, static_cast<std::uint32_t>(index_.special_planes_.size()), turn_the_same});
        };
        for (std::uint32_t i = 0; i < size(); ++i) {
            if (index_.shape(i) != UmbrellaIndex::Shape::odd) continue;
            patch.describe(surface_, index_.point_of(i));
            const std::uint32_t first = index_.spokes_of(i).first;
            for (std::uint32_t s = 0; s < patch.targets.size(); ++s) {
                if (index_.sides_[first + s].first != UmbrellaIndex::k_special) continue;
                end_list(first + s, sides_of(s, patch).turn_the_same);
                for (std::uint32_t t = 0; t < patch.triangles.size(); ++t)
                    if (patch.triangles[t].from == s || patch.triangles[t].to == s)
                        index_.special_planes_.push_back(t);
            }
        }
        end_list(UmbrellaIndex::k_none, false);
    }

    std::uint32_t size() const { return index_.patch_count(); }

    UmbrellaIndex& index_;
    const PointSurface& surface_;
    const LongCall& call_;
};

UmbrellaIndex::UmbrellaIndex(const PointSurface& surface, const LongCall& call)
    : tree_(std::make_unique<const BlockTree>()) {
    UmbrellaIndexBuilder(*this, surface, call).build();
}

UmbrellaIndex::~UmbrellaIndex() = default;

}  // namespace rimline
