#include "silhouette/field/plane_clusters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

namespace {

using Vector4 = std::array<double, 4>;

// Weight of the spread of normals relative to the spread of distances, for points two to three radii
// away. Of 1, 1.5, 2 and 3, the values 1 to 1.5 visit the fewest clusters on igea.
constexpr double k_normal_scale = 1.5;
constexpr std::size_t k_grain = 512;

// A plane beside its number and weight, so that nothing is gathered while planes are sorted and summed.
struct Member {
    Vector4 x;  // Normal and distance.
    double weight;
    std::uint32_t plane;
};
using Members = std::span<const Member>;

// Moments of a set of planes about their mean.
class Moments {
public:
    explicit Moments(Members members) {
        for (const Member& member : members) weight_ += member.weight;
        // If all weights are 0, the moments use equal weights.
        const double equal = 1.0 / static_cast<double>(members.size());
        const auto share = [weight = weight_, equal](const Member& member) {
            return weight > 0.0 ? member.weight / weight : equal;
        };
        // Sums are local: members of this object might be what is read, for all that the compiler knows.
        Vector4 mean{};
        for (const Member& member : members) {
            const double part = share(member);
            for (std::size_t a = 0; a < 4; ++a) mean[a] += part * member.x[a];
        }
        mean_ = mean;
        Vector4 extent{};
        std::array<double, 10> covariance{};
        std::array<double, 20> third{};
        for (const Member& member : members) {
            const double part = share(member);
            const Vector4 x = deviation(member);
            std::size_t pair = 0;
            std::size_t triple = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                extent[a] = std::max(extent[a], std::abs(x[a]));
                for (std::size_t b = a; b < 4; ++b) {
                    covariance[pair++] += part * x[a] * x[b];
                    for (std::size_t c = b; c < 4; ++c)
                        third[triple++] += part * x[a] * x[b] * x[c];
                }
            }
        }
        extent_ = extent;
        covariance_ = covariance;
        third_ = third;
        measure_kappa(members);
    }

    void store(ClusterNode& node, std::size_t lane) const {
        const auto to_float = [](double value) { return static_cast<float>(value); };
        node.weight[lane] = to_float(weight_);
        std::size_t pair = 0;
        std::size_t triple = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            node.mean[a][lane] = to_float(mean_[a]);
            node.extent[a][lane] = to_float(extent_[a] * (1.0 + 0x1p-20));
            for (std::size_t b = a; b < 4; ++b) {
                node.covariance[pair][lane] = to_float(covariance_[pair] * (a == b ? 1.0 : 2.0));
                ++pair;
                for (std::size_t c = b; c < 4; ++c) {
                    const double times = a == b && b == c ? 1.0 : (a == b || b == c ? 3.0 : 6.0);
                    node.third[triple][lane] = to_float(third_[triple] * times);
                    ++triple;
                }
            }
        }
        node.kappa_square[lane] = to_float(kappa_square_ * (1.0 + 0x1p-10));
        node.epsilon[lane] = to_float(epsilon_);
    }

private:
    Vector4 deviation(const Member& member) const {
        Vector4 x = member.x;
        for (std::size_t a = 0; a < 4; ++a) x[a] -= mean_[a];
        return x;
    }

    // The maximum of x'(C + εI)^-1 x, by Cholesky decomposition.
    void measure_kappa(Members members) {
        epsilon_ =
            0.02 * (covariance_[0] + covariance_[4] + covariance_[7] + covariance_[9]) + 1e-20;
        double factor[4][4] = {};
        std::size_t pair = 0;
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a; b < 4; ++b)
                factor[b][a] = covariance_[pair++] + (a == b ? epsilon_ : 0.0);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = factor[i][j];
                for (std::size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
                factor[i][j] = i == j ? std::sqrt(sum) : sum / factor[j][j];
            }
        double most = 0.0;
        for (const Member& member : members) {
            const Vector4 x = deviation(member);
            Vector4 y;
            double square = 0.0;
            for (std::size_t a = 0; a < 4; ++a) {
                double sum = x[a];
                for (std::size_t k = 0; k < a; ++k) sum -= factor[a][k] * y[k];
                y[a] = sum / factor[a][a];
                square += y[a] * y[a];
            }
            most = std::max(most, square);
        }
        kappa_square_ = most;
    }

    double weight_ = 0.0;
    Vector4 mean_{};
    Vector4 extent_{};
    std::array<double, 10> covariance_{};
    std::array<double, 20> third_{};
    double epsilon_ = 0.0;
    double kappa_square_ = 0.0;
};

// Sorts the planes of a range of leaves in k-d order. Each split is between whole clusters.
void sort_leaves(std::span<Member> members, std::size_t first_leaf, std::size_t last_leaf,
                 const LongCall& call) {
    call.checkpoint(0.0);
    const std::size_t leaves = last_leaf - first_leaf;
    if (leaves < 2) return;
    std::size_t unit = 1;
    while (unit * k_cluster_fan < leaves) unit *= k_cluster_fan;
    const std::size_t units = (leaves + unit - 1) / unit;
    const std::size_t cut_leaf = first_leaf + unit * std::max<std::size_t>(units / 2, 1);
    const auto at = [&](std::size_t leaf) {
        return members.begin() +
               static_cast<std::ptrdiff_t>(std::min(leaf * k_leaf_planes, members.size()));
    };
    const auto begin = at(first_leaf), cut = at(cut_leaf), end = at(last_leaf);

    Vector4 low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (auto it = begin; it != end; ++it) {
        for (std::size_t a = 0; a < 4; ++a) {
            low[a] = std::min(low[a], it->x[a]);
            high[a] = std::max(high[a], it->x[a]);
        }
    }
    std::size_t axis = 0;
    double widest = -1.0;
    for (std::size_t a = 0; a < 4; ++a) {
        const double width = (high[a] - low[a]) * (a < 3 ? k_normal_scale : 1.0);
        if (width > widest) {
            widest = width;
            axis = a;
        }
    }
    std::nth_element(begin, cut, end, [axis](const Member& i, const Member& j) {
        return i.x[axis] < j.x[axis] || (i.x[axis] == j.x[axis] && i.plane < j.plane);
    });
    tbb::parallel_invoke([&] { sort_leaves(members, first_leaf, cut_leaf, call); },
                         [&] { sort_leaves(members, cut_leaf, last_leaf, call); });
}

}  // namespace

PlaneClusters::PlaneClusters(const UnitPlanes& planes, std::span<const double> weights,
                             const std::stop_token& stop)
    : order_(planes.size()) {
    RIMLINE_CHECK(weights.size() == planes.size());
    if (planes.size() == 0) return;
    const LongCall call{stop, {}};
    std::vector<Member> members;
    members.reserve(planes.size());
    for (std::uint32_t i = 0; i < planes.size(); ++i) {
        if (i % k_planes_a_checkpoint == 0) call.checkpoint(0.0);
        const glm::dvec3& n = planes.normal(i);
        members.push_back({{n.x, n.y, n.z, planes.offset(i)}, weights[i], i});
    }
    const std::size_t leaves = (planes.size() + k_leaf_planes - 1) / k_leaf_planes;
    sort_leaves(members, 0, leaves, call);
    for (std::size_t i = 0; i < members.size(); ++i) order_[i] = members[i].plane;

    for (auto* values : {&planes_.nx, &planes_.ny, &planes_.nz, &planes_.d, &planes_.weight})
        values->resize(leaves * k_leaf_planes);
    for (std::size_t i = 0; i < leaves * k_leaf_planes; ++i) {
        const Member& member = members[std::min(i, members.size() - 1)];
        planes_.nx[i] = static_cast<float>(member.x[0]);
        planes_.ny[i] = static_cast<float>(member.x[1]);
        planes_.nz[i] = static_cast<float>(member.x[2]);
        planes_.d[i] = static_cast<float>(member.x[3]);
        planes_.weight[i] = i < members.size() ? static_cast<float>(member.weight) : 0.0f;
    }

    std::size_t span = k_leaf_planes;  // Planes per cluster.
    for (std::size_t clusters = leaves;; clusters = levels_.back().size()) {
        std::vector<ClusterNode> nodes((clusters + k_cluster_fan - 1) / k_cluster_fan);
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, clusters, std::max<std::size_t>(k_grain / span, 1)),
            [&](const tbb::blocked_range<std::size_t>& part) {
                call.checkpoint(0.0);
                for (std::size_t c = part.begin(); c < part.end(); ++c) {
                    const std::size_t begin = c * span;
                    const std::size_t end = std::min(begin + span, members.size());
                    Moments(Members(members).subspan(begin, end - begin))
                        .store(nodes[c / k_cluster_fan], c % k_cluster_fan);
                }
            });
        levels_.push_back(std::move(nodes));
        if (levels_.back().size() == 1) break;
        span *= k_cluster_fan;
    }
}

}  // namespace rimline
