#include "silhouette/field/field_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "silhouette/field/field_kernels.cpp"
#include "silhouette/vector_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight lanes, for clusters. With shorter vectors, several vectors cover them.
using Floats = hn::CappedTag<float, k_cluster_fan>;
using Ints = hn::RebindToSigned<Floats>;
using Unsigneds = hn::RebindToUnsigned<Floats>;
using V = hn::Vec<Floats>;
// For planes. Sums have eight lanes all the same: so they are equal with eight lanes and with sixteen.
#if HWY_TARGET == HWY_AVX3
using Wides = hn::CappedTag<float, 2 * k_cluster_fan>;
#else
using Wides = Floats;
#endif
static_assert(k_leaf_planes % (2 * k_cluster_fan) == 0);

// Float sums that are flushed to a double at short intervals.
class Sum {
public:
    HWY_INLINE Sum() : part_(hn::Zero(Floats())) {}
    HWY_INLINE void add(V v) { part_ = hn::Add(part_, v); }
    HWY_INLINE void flush() {
        const Floats d;
        HWY_ALIGN float lanes[k_cluster_fan];
        hn::Store(part_, d, lanes);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) total_ += double{lanes[i]};
        part_ = hn::Zero(d);
    }
    HWY_INLINE double total() {
        flush();
        return total_;
    }

private:
    V part_;
    double total_ = 0.0;
};

// The cubic of the piece that contains a distance.
template <class D>
struct Cubic {
    hn::Vec<D> start, c0, c1, c2, c3;
};

// Finds pieces by testing all knots.
template <class D>
class PiecesByKnot {
public:
    explicit PiecesByKnot(const FunctionTable& table) : table_(table) {}
    HWY_INLINE Cubic<D> at(hn::Vec<D> s) const {
        const D d;
        Cubic<D> cubic{hn::Set(d, table_.start[0]), hn::Set(d, table_.c0[0]), hn::Zero(d),
                       hn::Zero(d), hn::Zero(d)};
        for (std::size_t k = 0; k < table_.knot_count; ++k) {
            const auto beyond = hn::Ge(s, hn::Set(d, table_.knot[k]));
            cubic.start = hn::IfThenElse(beyond, hn::Set(d, table_.start[k + 1]), cubic.start);
            cubic.c0 = hn::IfThenElse(beyond, hn::Set(d, table_.c0[k + 1]), cubic.c0);
            cubic.c1 = hn::IfThenElse(beyond, hn::Set(d, table_.c1[k + 1]), cubic.c1);
            cubic.c2 = hn::IfThenElse(beyond, hn::Set(d, table_.c2[k + 1]), cubic.c2);
            cubic.c3 = hn::IfThenElse(beyond, hn::Set(d, table_.c3[k + 1]), cubic.c3);
        }
        return cubic;
    }

private:
    const FunctionTable& table_;
};

bool fit_registers(const FunctionTable& table) {
    return hn::Lanes(Floats()) >= 8 && table.knot_count + 1 <= hn::Lanes(Floats());
}

// For few pieces: each coefficient fits into one register and is looked up by the piece's number.
template <class D>
class PiecesInRegisters {
public:
    HWY_INLINE explicit PiecesInRegisters(const FunctionTable& table)
        : start_(hn::LoadU(D(), table.start.data())),
          c0_(hn::LoadU(D(), table.c0.data())),
          c1_(hn::LoadU(D(), table.c1.data())),
          c2_(hn::LoadU(D(), table.c2.data())),
          c3_(hn::LoadU(D(), table.c3.data())),
          table_(table) {}
    HWY_INLINE Cubic<D> at(hn::Vec<D> s) const {
        const D d;
        const hn::RebindToSigned<D> di;
        auto number = hn::Zero(di);
        for (std::size_t k = 0; k < table_.knot_count; ++k)  // A mask's lanes are 0 or -1.
            number = hn::Sub(
                number, hn::BitCast(di, hn::VecFromMask(d, hn::Ge(s, hn::Set(d, table_.knot[k])))));
        const auto at = hn::IndicesFromVec(d, number);
        return {hn::TableLookupLanes(start_, at), hn::TableLookupLanes(c0_, at),
                hn::TableLookupLanes(c1_, at), hn::TableLookupLanes(c2_, at),
                hn::TableLookupLanes(c3_, at)};
    }

private:
    hn::Vec<D> start_, c0_, c1_, c2_, c3_;
    const FunctionTable& table_;
};

template <class D>
HWY_INLINE hn::Vec<D> value_of(const Cubic<D>& f, hn::Vec<D> t) {
    return hn::MulAdd(hn::MulAdd(hn::MulAdd(f.c3, t, f.c2), t, f.c1), t, f.c0);
}

struct Point {
    hn::Vec<Wides> x, y, z;
    HWY_INLINE explicit Point(const glm::dvec3& p)
        : x(hn::Set(Wides(), static_cast<float>(p.x))),
          y(hn::Set(Wides(), static_cast<float>(p.y))),
          z(hn::Set(Wides(), static_cast<float>(p.z))) {}
};

// Adds the votes of planes [first, last), in whole vectors.
template <class Pieces>
HWY_INLINE void add_planes(const LeafPlanes& planes, const Pieces& pieces, const float* previous,
                           const Point& p, std::size_t first, std::size_t last, Sum& sum) {
    const Wides d;
    for (std::size_t i = first; i < last; i += hn::Lanes(d)) {
        const auto s = hn::MulAdd(
            hn::LoadU(d, &planes.nz[i]), p.z,
            hn::MulAdd(hn::LoadU(d, &planes.ny[i]), p.y,
                       hn::MulSub(hn::LoadU(d, &planes.nx[i]), p.x, hn::LoadU(d, &planes.d[i]))));
        const Cubic<Wides> f = pieces.at(s);
        auto vote = value_of(f, hn::Sub(s, f.start));
        if (previous != nullptr)
            vote = hn::Max(hn::Sub(vote, hn::LoadU(d, previous + i)), hn::Zero(d));
        const auto weighted = hn::Mul(vote, hn::LoadU(d, &planes.weight[i]));
#if HWY_TARGET == HWY_AVX3
        sum.add(hn::LowerHalf(Floats(), weighted));
        sum.add(hn::UpperHalf(Floats(), weighted));
#else
        sum.add(weighted);
#endif
    }
}

template <class Pieces>
double SumPlanesWith(const PlaneClusters& clusters, const FunctionTable& function,
                     const Discount* discount, const glm::dvec3& point) {
    const Point p(point);
    const Pieces pieces(function);
    const float* const previous = discount == nullptr ? nullptr : discount->previous.data();
    Sum sum;
    constexpr std::size_t k_run = 4 * k_leaf_planes;
    const std::size_t count = clusters.planes().d.size();
    for (std::size_t i = 0; i < count; i += k_run) {
        add_planes(clusters.planes(), pieces, previous, p, i, HWY_MIN(i + k_run, count), sum);
        sum.flush();
    }
    return sum.total();
}

double SumPlanes(const PlaneClusters& clusters, const FunctionTable& function,
                 const Discount* discount, const glm::dvec3& point) {
    return fit_registers(function)
               ? SumPlanesWith<PiecesInRegisters<Wides>>(clusters, function, discount, point)
               : SumPlanesWith<PiecesByKnot<Wides>>(clusters, function, discount, point);
}

// q = (p, -1), the products of its components, and bounds.
struct Query {
    explicit Query(const glm::dvec3& p) {
        const double q[4] = {p.x, p.y, p.z, -1.0};
        std::size_t pair = 0;
        std::size_t triple = 0;
        double square = 0.0;
        for (std::size_t a = 0; a < 4; ++a) {
            q1[a] = static_cast<float>(q[a]);
            magnitude[a] = HWY_MAX(q1[a], -q1[a]);
            square += q[a] * q[a];
            for (std::size_t b = a; b < 4; ++b) {
                q2[pair++] = static_cast<float>(q[a] * q[b]);
                for (std::size_t c = b; c < 4; ++c)
                    q3[triple++] = static_cast<float>(q[a] * q[b] * q[c]);
            }
        }
        norm_square = static_cast<float>(square);
        // Rounding error of a mean distance in float.
        margin = 0x1p-21f * (magnitude[0] + magnitude[1] + magnitude[2] + 1.0f);
    }
    float q1[4], magnitude[4], q2[10], q3[20];
    float norm_square, margin;
};

// The nodes of a large mesh do not fit into the inner caches.
constexpr std::uint32_t k_prefetch_ahead = 2;

template <class T>
HWY_INLINE void prefetch(const T* data) {
    for (std::size_t offset = 0; offset < sizeof(T); offset += 64)
        hwy::Prefetch(reinterpret_cast<const std::uint8_t*>(data) + offset);
}

// Sums of a node's clusters from a lane on, with upper bounds of their errors. Both are for a weight of 1.
// Made with all members: gcc compiles a constructor without arguments for another instruction set, and on AArch64
// refuses to.
struct Estimate {
    V value, error, max_vote, min_vote;
};

template <bool discounted, class Pieces>
HWY_INLINE Estimate estimate(const ClusterNode& node, std::size_t lane, const Query& q,
                             const FunctionTable& function, const Pieces& pieces) {
    const Floats d;
    const auto at = [&](const ClusterNode::Lanes& lanes)
                        HWY_ATTR { return hn::Load(d, &lanes[lane]); };
    V s = hn::Zero(d);
    V box = hn::Zero(d);
    for (std::size_t a = 0; a < 4; ++a) {
        s = hn::MulAdd(at(node.mean[a]), hn::Set(d, q.q1[a]), s);
        box = hn::MulAdd(at(node.extent[a]), hn::Set(d, q.magnitude[a]), box);
    }
    V variance = hn::Zero(d);
    for (std::size_t j = 0; j < 10; ++j)
        variance = hn::MulAdd(at(node.covariance[j]), hn::Set(d, q.q2[j]), variance);
    variance = hn::Max(variance, hn::Zero(d));
    const V slack = hn::Mul(at(node.epsilon), hn::Set(d, q.norm_square));
    const V ellipsoid = hn::Sqrt(hn::Mul(at(node.kappa_square), hn::Add(variance, slack)));
    const V radius =
        hn::MulAdd(hn::Min(box, ellipsoid), hn::Set(d, 1.0f + 0x1p-10f), hn::Set(d, q.margin));

    const Cubic<Floats> f = pieces.at(s);
    const V t = hn::Sub(s, f.start);
    const V at_mean = value_of(f, t);
    const V bend = hn::MulAdd(hn::Mul(hn::Set(d, 3.0f), f.c3), t, f.c2);
    V value = hn::MulAdd(bend, variance, at_mean);
    if (!hn::AllTrue(d, hn::Eq(f.c3, hn::Zero(d)))) {
        V third = hn::Zero(d);
#pragma GCC unroll 20
        for (std::size_t j = 0; j < 20; ++j)
            third = hn::MulAdd(at(node.third[j]), hn::Set(d, q.q3[j]), third);
        value = hn::MulAdd(f.c3, third, value);
    }

    V error = hn::Zero(d);
    for (std::size_t k = 0; k < function.knot_count; ++k) {
        const V beyond = hn::Max(hn::Sub(radius, hn::Abs(hn::Sub(s, hn::Set(d, function.knot[k])))),
                                 hn::Zero(d));
        error = hn::MulAdd(
            hn::Mul(beyond, beyond),
            hn::MulAdd(hn::Set(d, function.jump3[k]), beyond, hn::Set(d, function.jump2[k])),
            error);
    }
    // If a variance rounds to 0, a part of the slack replaces it.
    const V share =
        hn::Div(hn::MulAdd(slack, hn::Set(d, 0x1p-12f), variance), hn::Mul(radius, radius));
    error = hn::Mul(error, hn::Min(share, hn::Set(d, 1.0f)));

    if constexpr (discounted) {
        const V slope = hn::MulAdd(hn::Add(bend, f.c2), t, f.c1);  // 3 c3 t² + 2 c2 t + c1
        const V reach =
            hn::Mul(radius, hn::MulAdd(hn::Set(d, function.curvature), radius, hn::Abs(slope)));
        return {value, error, hn::Min(hn::Add(at_mean, reach), hn::Set(d, function.max_vote)),
                hn::Max(hn::Sub(at_mean, reach), hn::Set(d, function.min_vote))};
    } else {
        return {value, error, hn::Zero(d), hn::Zero(d)};
    }
}

// Clusters with inexact sums.
class Candidates {
public:
    HWY_INLINE explicit Candidates(FieldScratch& scratch) : scratch_(scratch) {}

    HWY_INLINE void add(hn::Mask<Floats> mask, std::uint32_t first, V value, V error, V weight) {
        const Floats d;
        const Unsigneds du;
        const std::uint32_t lanes = lanes_of(d, mask);
        const auto kept = squeezed_lanes(du, lanes);
        hn::StoreU(squeezed(d, value, kept), d, &scratch_.value[count_]);
        hn::StoreU(squeezed(d, error, kept), d, &scratch_.error[count_]);
        hn::StoreU(squeezed(d, weight, kept), d, &scratch_.weight[count_]);
        hn::StoreU(hn::Add(kept, hn::Set(du, first)), du, &scratch_.clusters[count_]);
        count_ += hwy::PopCount(std::uint64_t{lanes});
        weight_.add(hn::IfThenElseZero(mask, weight));
    }
    void flush() { weight_.flush(); }

    // Adds the values of sufficiently exact clusters to `sum` and subtracts their errors from `budget`.
    // Writes the other clusters to `expanded` and returns their number.
    std::uint32_t settle(double& budget, Sum& sum, std::uint32_t* expanded) {
        const Floats d;
        const Unsigneds du;
        const double all = weight_.total();
        if (count_ == 0) return 0;
        const V rate = hn::Set(d, static_cast<float>(budget / all * (1.0 - 0x1p-20)));
        Sum spent;
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < count_; i += hn::Lanes(d)) {
            const auto in_use = hn::FirstN(d, count_ - i);
            const V error = hn::LoadU(d, &scratch_.error[i]);
            const auto good =
                hn::And(in_use, hn::Le(error, hn::Mul(rate, hn::LoadU(d, &scratch_.weight[i]))));
            sum.add(hn::IfThenElseZero(good, hn::LoadU(d, &scratch_.value[i])));
            spent.add(hn::IfThenElseZero(good, error));
            const std::uint32_t lanes = lanes_of(d, hn::AndNot(good, in_use));
            hn::StoreU(
                squeezed(du, hn::LoadU(du, &scratch_.clusters[i]), squeezed_lanes(du, lanes)), du,
                expanded + count);
            count += static_cast<std::uint32_t>(hwy::PopCount(std::uint64_t{lanes}));
            if (i % 256 == 0) {
                sum.flush();
                spent.flush();
            }
        }
        budget = HWY_MAX(budget - spent.total() * (1.0 + 0x1p-20), 0.0);
        return count;
    }

private:
    FieldScratch& scratch_;
    std::size_t count_ = 0;
    Sum weight_;
};

template <bool discounted, template <class> class Pieces>
double SumClustersWith(const PlaneClusters& clusters, const FunctionTable& function,
                       const Discount* discount, const glm::dvec3& point, double budget,
                       FieldScratch& scratch, FieldWork& work) {
    const Floats d;
    const Pieces<Floats> pieces(function);
    const Query q(point);
    const V zero = hn::Zero(d);
    Sum sum;
    scratch.nodes[0] = 0;
    std::uint32_t count = clusters.levels().empty() ? 0 : 1;
    for (std::size_t level = clusters.levels().size(); level-- > 0 && count > 0;) {
        const std::vector<ClusterNode>& nodes = clusters.levels()[level];
        Candidates candidates(scratch);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + k_prefetch_ahead < count) prefetch(&nodes[scratch.nodes[i + k_prefetch_ahead]]);
            const std::uint32_t n = scratch.nodes[i];
            for (std::size_t lane = 0; lane < k_cluster_fan; lane += hn::Lanes(d)) {
                const V weight = hn::Load(d, &nodes[n].weight[lane]);
                const Estimate e = estimate<discounted>(nodes[n], lane, q, function, pieces);
                const auto some = hn::Gt(weight, zero);
                V value = hn::Mul(e.value, weight);
                V error = hn::Mul(e.error, weight);
                if constexpr (discounted) {
                    const DiscountNode& previous = discount->levels[level][n];
                    const V max_gain = hn::Sub(e.max_vote, hn::Load(d, &previous.min_vote[lane]));
                    const auto all_above =
                        hn::Ge(e.min_vote, hn::Load(d, &previous.max_vote[lane]));
                    const V half =
                        hn::Mul(hn::Set(d, 0.5f), hn::Mul(hn::Max(max_gain, zero), weight));
                    value = hn::IfThenElse(all_above,
                                           hn::Sub(value, hn::Load(d, &previous.sum[lane])), half);
                    error = hn::IfThenElse(all_above, error, half);
                }
                const auto inexact = hn::And(hn::Gt(error, zero), some);
                sum.add(hn::IfThenElseZero(hn::AndNot(inexact, some), value));
                if (!hn::AllFalse(d, inexact))
                    candidates.add(inexact, static_cast<std::uint32_t>(n * k_cluster_fan + lane),
                                   value, error, weight);
            }
            if (i % 16 == 15) {
                sum.flush();
                candidates.flush();
            }
        }
        work.clusters += std::uint64_t{count} * k_cluster_fan;
        sum.flush();
        count = candidates.settle(budget, sum, scratch.next.get());
        scratch.nodes.swap(scratch.next);
    }

    const Point p(point);
    const Pieces<Wides> wide_pieces(function);
    const float* const previous = discounted ? discount->previous.data() : nullptr;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t first = scratch.nodes[i] * k_leaf_planes;
        add_planes(clusters.planes(), wide_pieces, previous, p, first, first + k_leaf_planes, sum);
        if (i % 4 == 3) sum.flush();
    }
    work.planes += std::uint64_t{count} * k_leaf_planes;
    return sum.total();
}

double SumClusters(const PlaneClusters& clusters, const FunctionTable& function,
                   const Discount* discount, const glm::dvec3& point, double budget,
                   FieldScratch& scratch, FieldWork& work) {
    const bool fits = fit_registers(function);
    if (discount == nullptr)
        return fits ? SumClustersWith<false, PiecesInRegisters>(clusters, function, discount, point,
                                                                budget, scratch, work)
                    : SumClustersWith<false, PiecesByKnot>(clusters, function, discount, point,
                                                           budget, scratch, work);
    return fits ? SumClustersWith<true, PiecesInRegisters>(clusters, function, discount, point,
                                                           budget, scratch, work)
                : SumClustersWith<true, PiecesByKnot>(clusters, function, discount, point, budget,
                                                      scratch, work);
}

const char* FieldTargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>

#include "silhouette/error.h"

namespace rimline::kernels {

HWY_EXPORT(SumPlanes);
HWY_EXPORT(SumClusters);
HWY_EXPORT(FieldTargetName);

FunctionTable::FunctionTable(const TangentialFunction& function)
    : knot_count(static_cast<std::uint32_t>(function.knots().size())) {
    RIMLINE_CHECK(knot_count <= k_max_knots);
    const auto to_float = [](double value) { return static_cast<float>(value); };
    const auto pieces = function.pieces();
    double bend = 0.0;
    double terms = function.max_magnitude();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const TangentialFunction::Piece& piece = pieces[i];
        start[i] = to_float(piece.start);
        c0[i] = to_float(piece.c0);
        c1[i] = to_float(piece.c1);
        c2[i] = to_float(piece.c2);
        c3[i] = to_float(piece.c3);
        if (!std::isfinite(piece.from) || !std::isfinite(piece.to)) continue;
        const double h = piece.to - piece.from;
        bend = std::max(
            {bend, std::abs(piece.curvature(piece.from)), std::abs(piece.curvature(piece.to))});
        terms = std::max(terms, std::abs(piece.c0) + std::abs(piece.c1) * h +
                                    std::abs(piece.c2) * h * h + std::abs(piece.c3) * h * h * h);
    }
    for (std::size_t k = 0; k < knot_count; ++k) {
        const double at = function.knots()[k].distance;
        knot[k] = to_float(at);
        jump2[k] = to_float(0.5 * std::abs(pieces[k + 1].curvature(at) - pieces[k].curvature(at)) *
                            (1 + 0x1p-20));
        jump3[k] = to_float(std::abs(pieces[k + 1].c3 - pieces[k].c3) * (1 + 0x1p-20));
    }
    min_vote = to_float(function.min_value());
    max_vote = to_float(function.max_value());
    curvature = to_float(0.5 * bend);
    // Rounding errors of distances come from normals, points and products, the offset, and three sums.
    // Those of votes and sums come from their terms.
    const double distances = 3.0 * k_near_radius + 1.0 + 3.0 * (k_near_radius + 1.0);
    rounding_share = 0x1p-24 * (distances * function.max_slope() + 8.0 * terms +
                                32.0 * function.max_magnitude());
}

void FieldScratch::reserve(const PlaneClusters& planes) {
    // Stores always write whole vectors, so the last one needs additional memory.
    const std::size_t capacity =
        (planes.leaf_count() + k_cluster_fan) / k_cluster_fan * k_cluster_fan + k_cluster_fan;
    for (auto* numbers : {&nodes, &next, &clusters})
        *numbers = std::make_unique_for_overwrite<std::uint32_t[]>(capacity);
    for (auto* numbers : {&value, &error, &weight})
        *numbers = std::make_unique_for_overwrite<float[]>(capacity);
}

double sum_planes(const PlaneClusters& planes, const FunctionTable& function,
                  const Discount* discount, const glm::dvec3& point) {
    return HWY_DYNAMIC_DISPATCH(SumPlanes)(planes, function, discount, point);
}

double sum_clusters(const PlaneClusters& planes, const FunctionTable& function,
                    const Discount* discount, const glm::dvec3& point, double budget,
                    FieldScratch& scratch, FieldWork& work) {
    return HWY_DYNAMIC_DISPATCH(SumClusters)(planes, function, discount, point, budget, scratch,
                                             work);
}

std::string_view field_instruction_set() { return HWY_DYNAMIC_DISPATCH(FieldTargetName)(); }

}  // namespace rimline::kernels
#endif  // HWY_ONCE
