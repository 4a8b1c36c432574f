#include "silhouette/mesh/face_pair_kernels.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "silhouette/mesh/face_pair_kernels.cpp"
#include "silhouette/vector_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, FaceBlock::k_faces>;
using Numbers = hn::RebindToUnsigned<Floats>;
using Float = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;
using Axes = std::array<const FaceBlock::Corners<float>*, 3>;

// By axis.
struct Boxes {
    explicit Boxes(const FaceBlock& block) {
        const Floats d;
        const Axes axes{&block.x, &block.y, &block.z};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t v = 0; v < FaceBlock::k_faces; v += hn::Lanes(d)) {
                const auto& p = *axes[axis];
                const Float p0 = hn::Load(d, &p[0][v]), p1 = hn::Load(d, &p[1][v]),
                            p2 = hn::Load(d, &p[2][v]);
                hn::Store(hn::Min(hn::Min(p0, p1), p2), d, &low[axis][v]);
                hn::Store(hn::Max(hn::Max(p0, p1), p2), d, &high[axis][v]);
            }
    }
    // Of those from lane `v` on, those that meet the box.
    HWY_INLINE std::uint32_t meeting(std::size_t v, const std::array<float, 3>& box_low,
                                     const std::array<float, 3>& box_high) const {
        const Floats d;
        Mask meets = hn::Le(hn::Load(d, &low[0][v]), hn::Set(d, box_high[0]));
        meets = hn::And(meets, hn::Le(hn::Set(d, box_low[0]), hn::Load(d, &high[0][v])));
        for (std::size_t axis = 1; axis < 3; ++axis) {
            meets = hn::And(meets, hn::Le(hn::Load(d, &low[axis][v]), hn::Set(d, box_high[axis])));
            meets = hn::And(meets, hn::Le(hn::Set(d, box_low[axis]), hn::Load(d, &high[axis][v])));
        }
        return lanes_of(d, meets) << v;
    }
    alignas(64) FaceBlock::Corners<float> low, high;
};

// On which sides of planes points lie, collected: bits of lanes.
class Sides {
public:
    // `height` and `length` of a point over its plane, and of its difference from a corner; `is_shared` where the
    // point is a corner of that face.
    HWY_INLINE void add(Float height, Float length, Float bound, Mask is_shared) {
        const Floats d;
        const Float least = hn::Add(hn::Mul(bound, length), hn::Set(d, FaceBlock::k_least));
        const Mask is_left = hn::Gt(height, least), is_right = hn::Gt(hn::Neg(height), least);
        const std::uint32_t shared = lanes_of(d, is_shared), left = lanes_of(d, is_left),
                            right = lanes_of(d, is_right);
        left_ |= left & ~shared;
        right_ |= right & ~shared;
        unknown_ |= ~(left | right | shared);
    }
    // Those of which all points that are not shared lie on one side, certainly. Not those of which all are shared.
    HWY_INLINE std::uint32_t beside() const { return (left_ ^ right_) & ~unknown_; }

private:
    std::uint32_t left_ = 0, right_ = 0, unknown_ = 0;
};

HWY_INLINE Float sum_of_lengths(Float x, Float y, Float z) {
    return hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
}

HWY_INLINE Float dot(Float ax, Float ay, Float az, Float bx, Float by, Float bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

// Of the faces of `b` from lane `v` on, those beside the plane of face `i` of `a`.
HWY_INLINE std::uint32_t beside_plane(const FaceBlock& a, std::size_t i, const FaceBlock& b,
                                      std::size_t v) {
    const Floats d;
    const Numbers du;
    const Float x0 = hn::Set(d, a.x[0][i]), y0 = hn::Set(d, a.y[0][i]), z0 = hn::Set(d, a.z[0][i]);
    Sides sides;
    for (std::size_t k = 0; k < 3; ++k) {
        const Float x = hn::Sub(hn::Load(d, &b.x[k][v]), x0),
                    y = hn::Sub(hn::Load(d, &b.y[k][v]), y0),
                    z = hn::Sub(hn::Load(d, &b.z[k][v]), z0);
        const auto vertex = hn::Load(du, &b.vertices[k][v]);
        const auto shared = hn::Or(hn::Or(hn::Eq(vertex, hn::Set(du, a.vertices[0][i])),
                                          hn::Eq(vertex, hn::Set(du, a.vertices[1][i]))),
                                   hn::Eq(vertex, hn::Set(du, a.vertices[2][i])));
        sides.add(dot(hn::Set(d, a.normal_x[i]), hn::Set(d, a.normal_y[i]),
                      hn::Set(d, a.normal_z[i]), x, y, z),
                  sum_of_lengths(x, y, z), hn::Set(d, a.bound[i]), hn::RebindMask(d, shared));
    }
    return sides.beside();
}

// Of the faces of `b` from lane `v` on, those whose plane face `i` of `a` is beside.
HWY_INLINE std::uint32_t planes_beside(const FaceBlock& a, std::size_t i, const FaceBlock& b,
                                       std::size_t v) {
    const Floats d;
    const Numbers du;
    const Float x0 = hn::Load(d, &b.x[0][v]), y0 = hn::Load(d, &b.y[0][v]),
                z0 = hn::Load(d, &b.z[0][v]);
    const Float nx = hn::Load(d, &b.normal_x[v]), ny = hn::Load(d, &b.normal_y[v]),
                nz = hn::Load(d, &b.normal_z[v]), bound = hn::Load(d, &b.bound[v]);
    const auto v0 = hn::Load(du, &b.vertices[0][v]), v1 = hn::Load(du, &b.vertices[1][v]),
               v2 = hn::Load(du, &b.vertices[2][v]);
    Sides sides;
    for (std::size_t k = 0; k < 3; ++k) {
        const Float x = hn::Sub(hn::Set(d, a.x[k][i]), x0), y = hn::Sub(hn::Set(d, a.y[k][i]), y0),
                    z = hn::Sub(hn::Set(d, a.z[k][i]), z0);
        const auto vertex = hn::Set(du, a.vertices[k][i]);
        const auto shared =
            hn::Or(hn::Or(hn::Eq(vertex, v0), hn::Eq(vertex, v1)), hn::Eq(vertex, v2));
        sides.add(dot(nx, ny, nz, x, y, z), sum_of_lengths(x, y, z), bound,
                  hn::RebindMask(d, shared));
    }
    return sides.beside();
}

std::uint32_t FindNearFaces(const FaceBlock& a, std::uint32_t count_a, const FaceBlock& b,
                            std::uint32_t count_b, bool is_same, NearFaces& near) {
    const Floats d;
    const std::uint32_t step_lanes = (1u << hn::Lanes(d)) - 1;
    const Boxes boxes_a(a), boxes_b(b);
    std::uint32_t pairs = 0;
    for (std::size_t i = 0; i < count_a; ++i) {
        const std::array<float, 3> low{boxes_a.low[0][i], boxes_a.low[1][i], boxes_a.low[2][i]};
        const std::array<float, 3> high{boxes_a.high[0][i], boxes_a.high[1][i], boxes_a.high[2][i]};
        std::uint32_t lanes = 0;
        for (std::size_t v = 0; v < FaceBlock::k_faces; v += hn::Lanes(d))
            lanes |= boxes_b.meeting(v, low, high);
        lanes &= (1u << count_b) - 1u;
        if (is_same) lanes &= ~((2u << i) - 1u);
        pairs += static_cast<std::uint32_t>(std::popcount(lanes));
        for (std::size_t v = 0; v < FaceBlock::k_faces; v += hn::Lanes(d))
            if ((lanes >> v & step_lanes) != 0) lanes &= ~(beside_plane(a, i, b, v) << v);
        for (std::size_t v = 0; v < FaceBlock::k_faces; v += hn::Lanes(d))
            if ((lanes >> v & step_lanes) != 0) lanes &= ~(planes_beside(a, i, b, v) << v);
        near[i] = static_cast<std::uint16_t>(lanes);
    }
    return pairs;
}

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rimline::kernels {

HWY_EXPORT(FindNearFaces);

std::uint32_t find_near_faces(const FaceBlock& a, std::uint32_t count_a, const FaceBlock& b,
                              std::uint32_t count_b, bool is_same, NearFaces& near) {
    return HWY_DYNAMIC_DISPATCH(FindNearFaces)(a, count_a, b, count_b, is_same, near);
}

}  // namespace rimline::kernels
#endif  // HWY_ONCE
