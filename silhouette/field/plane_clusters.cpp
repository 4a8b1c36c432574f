#include "silhouette/field/plane_clusters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "silhouette/error.h"

namespace rimline {

namespace {

using Vector4 = std::array<double, 4>;

// Weight of the spread of normals relative to the spread of distances, for points two to three radii
// away. Of 1, 1.5, 2 and 3, the values 1 to 1.5 visit the fewest clusters on igea.
constexpr double k_normal_scale = 1.5;
constexpr std::size_t k_grain = 512;

Vector4 coordinates(const UnitPlanes& planes, std::uint32_t i) {
    const glm::dvec3& n = planes.normal(i);
    return {n.x, n.y, n.z, planes.offset(i)};
}

// Moments of a set of planes about their mean.
class Moments {
public:
    Moments(const UnitPlanes& planes, std::span<const double> weights,
            std::span<const std::uint32_t> members) {
        for (const std::uint32_t i : members) weight_ += weights[i];
        // If all weights are 0, the moments use equal weights.
        const auto share = [&](std::uint32_t i) {
            return weight_ > 0.0 ? weights[i] / weight_ : 1.0 / static_cast<double>(members.size());
        };
        for (const std::uint32_t i : members)
            for (std::size_t a = 0; a < 4; ++a) mean_[a] += share(i) * coordinates(planes, i)[a];
        for (const std::uint32_t i : members) {
            const Vector4 x = deviation(planes, i);
            std::size_t pair = 0;
            std::size_t triple = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                extent_[a] = std::max(extent_[a], std::abs(x[a]));
                for (std::size_t b = a; b < 4; ++b) {
                    covariance_[pair++] += share(i) * x[a] * x[b];
                    for (std::size_t c = b; c < 4; ++c)
                        third_[triple++] += share(i) * x[a] * x[b] * x[c];
                }
            }
        }
        measure_kappa(planes, members);
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
    Vector4 deviation(const UnitPlanes& planes, std::uint32_t i) const {
        Vector4 x = coordinates(planes, i);
        for (std::size_t a = 0; a < 4; ++a) x[a] -= mean_[a];
        return x;
    }

    // The maximum of x'(C + εI)^-1 x, by Cholesky decomposition.
    void measure_kappa(const UnitPlanes& planes, std::span<const std::uint32_t> members) {
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
        for (const std::uint32_t i : members) {
            const Vector4 x = deviation(planes, i);
            Vector4 y;
            double square = 0.0;
            for (std::size_t a = 0; a < 4; ++a) {
                double sum = x[a];
                for (std::size_t k = 0; k < a; ++k) sum -= factor[a][k] * y[k];
                y[a] = sum / factor[a][a];
                square += y[a] * y[a];
            }
            kappa_square_ = std::max(kappa_square_, square);
        }
    }

    double weight_ = 0.0;
    Vector4 mean_{};
    Vector4 extent_{};
    std::array<double, 10> covariance_{};
    std::array<double, 20> third_{};
    double epsilon_ = 0.0;
    double kappa_square_ = 0.0;
};

}  // namespace

// Sorts the planes of a range of leaves in k-d order. Each split is between whole clusters.
void PlaneClusters::sort(const UnitPlanes& planes, std::size_t first_leaf, std::size_t last_leaf,
                         const LongCall& call) {
    call.checkpoint(0.0);
    const std::size_t leaves = last_leaf - first_leaf;
    if (leaves < 2) return;
    std::size_t unit = 1;
    while (unit * k_cluster_fan < leaves) unit *= k_cluster_fan;
    const std::size_t units = (leaves + unit - 1) / unit;
    const std::size_t cut_leaf = first_leaf + unit * std::max<std::size_t>(units / 2, 1);
    const auto at = [&](std::size_t leaf) {
        return order_.begin() +
               static_cast<std::ptrdiff_t>(std::min(leaf * k_leaf_planes, order_.size()));
    };
    const auto begin = at(first_leaf), cut = at(cut_leaf), end = at(last_leaf);

    Vector4 low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (auto it = begin; it != end; ++it) {
        const Vector4 x = coordinates(planes, *it);
        for (std::size_t a = 0; a < 4; ++a) {
            low[a] = std::min(low[a], x[a]);
            high[a] = std::max(high[a], x[a]);
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
    const auto key = [&](std::uint32_t i) {
        return axis == 3 ? planes.offset(i) : planes.normal(i)[static_cast<int>(axis)];
    };
    std::nth_element(begin, cut, end, [&](std::uint32_t i, std::uint32_t j) {
        const double a = key(i), b = key(j);
        return a < b || (a == b && i < j);
    });
    tbb::parallel_invoke([&] { sort(planes, first_leaf, cut_leaf, call); },
                         [&] { sort(planes, cut_leaf, last_leaf, call); });
}

PlaneClusters::PlaneClusters(const UnitPlanes& planes, std::span<const double> weights,
                             const std::stop_token& stop)
    : order_(planes.size()) {
    RIMLINE_CHECK(weights.size() == planes.size());
    if (planes.size() == 0) return;
    std::iota(order_.begin(), order_.end(), 0u);
    const std::size_t leaves = (planes.size() + k_leaf_planes - 1) / k_leaf_planes;
    const LongCall call{stop, {}};
    sort(planes, 0, leaves, call);

    for (auto* values : {&planes_.nx, &planes_.ny, &planes_.nz, &planes_.d, &planes_.weight})
        values->resize(leaves * k_leaf_planes);
    for (std::size_t i = 0; i < leaves * k_leaf_planes; ++i) {
        const std::uint32_t plane = order_[std::min(i, order_.size() - 1)];
        const glm::dvec3& n = planes.normal(plane);
        planes_.nx[i] = static_cast<float>(n.x);
        planes_.ny[i] = static_cast<float>(n.y);
        planes_.nz[i] = static_cast<float>(n.z);
        planes_.d[i] = static_cast<float>(planes.offset(plane));
        planes_.weight[i] = i < order_.size() ? static_cast<float>(weights[plane]) : 0.0f;
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
                    const std::size_t end = std::min(begin + span, order_.size());
                    Moments(planes, weights, std::span(order_).subspan(begin, end - begin))
                        .store(nodes[c / k_cluster_fan], c % k_cluster_fan);
                }
            });
        levels_.push_back(std::move(nodes));
        if (levels_.back().size() == 1) break;
        span *= k_cluster_fan;
    }
}

}  // namespace rimline
