#include "silhouette/points/thesis_umbrellas.h"

#include <algorithm>
#include <array>
#include <vector>

#include "silhouette/points/each_point.h"
#include "silhouette/points/point_fans.h"
#include "silhouette/points/thesis_consistency.h"
#include "silhouette/points/thesis_fan.h"
#include "silhouette/points/thesis_supplements.h"

namespace rimline {

namespace {

class Passes {
public:
    Passes(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
           const PointSurfaceOptions& options)
        : points_(points),
          neighbors_(neighbors),
          options_(options),
          k_(neighbors.nearest_count()),
          count_(static_cast<std::uint32_t>(points.size())),
          gabriel_(count_),
          fans_(count_),
          reasons_(count_, UndecidedReason::none) {}

    void first(const CallPart& part) {
        const double end_of_fans = part.begin + 0.9 * (part.end - part.begin);
        each({part.call, part.begin, end_of_fans}, [&](std::uint32_t i, Neighborhood& around) {
            if (!neighbors_.is_mutual(i)) {
                reasons_[i] = k_ == 0 ? UndecidedReason::alone : UndecidedReason::isolated;
                return;
            }
            gabriel_[i] = gabriel_triangle(around, k_, options_.omega);
            if (gabriel_[i].normal == glm::dvec3(0.0))
                reasons_[i] = UndecidedReason::collinear;
            else if (gabriel_[i].is_trusted)
                if (const auto fan = admitted_fan(around, (std::uint64_t{1} << k_) - 1,
                                                  gabriel_[i].normal, gabriel_[i].radius, options_))
                    fans_[i].set(*fan);
        });
        normals_.assign(count_, glm::dvec3(0.0));
        each({part.call, end_of_fans, part.end}, [&](std::uint32_t i, Neighborhood& around) {
            if (fans_[i].is_whole()) normals_[i] = around.normal(fans_[i].fans[0]);
        });
    }

    void second(const CallPart& part) {
        std::vector<PointFans> result = fans_;
        each(part, [&](std::uint32_t i, Neighborhood& around) {
            if (reasons_[i] != UndecidedReason::none || fans_[i].is_whole()) return;
            std::array<glm::dvec3, k_max_neighbors> normals;
            for (std::uint32_t place = 0; place < k_; ++place)
                normals[place] = normals_[around.number(place)];
            result[i] = supplemented(around, fans_[i], std::span(normals).first(k_),
                                     gabriel_[i].radius, options_);
        });
        fans_.swap(result);
    }

    void third(const CallPart& part) {
        std::vector<PointFans> result = fans_;
        each(part, [&](std::uint32_t i, Neighborhood& around) {
            if (reasons_[i] == UndecidedReason::none)
                if (const auto fans = made_consistent(around, fans_[i], claims_on(i, around)))
                    result[i] = *fans;
        });
        fans_.swap(result);
    }

    UmbrellaSet found() {
        UmbrellaSet found;
        found.fans.resize(count_);
        found.normals.assign(count_, glm::dvec3(0.0));
        found.scales.assign(count_, 0.0);
        found.labels.assign(count_, PointLabel::undecided);
        Neighborhood around;
        for (std::uint32_t i = 0; i < count_; ++i) {
            PointFans& fans = fans_[i];
            around.assign(points_, i, neighbors_.of(i));
            // An umbrella that folds onto itself has no normal.
            const auto end = std::remove_if(
                fans.fans.begin(), fans.fans.begin() + fans.count,
                [&](const Fan& fan) { return around.normal(fan) == glm::dvec3(0.0); });
            fans.count = static_cast<std::uint8_t>(end - fans.fans.begin());
            if (reasons_[i] == UndecidedReason::none && fans.count == 0)
                reasons_[i] = UndecidedReason::no_normal;
            if (reasons_[i] != UndecidedReason::none) continue;
            found.labels[i] = fans.is_whole()        ? PointLabel::interior
                              : open_ends(fans) == 0 ? PointLabel::feature
                                                     : PointLabel::border;
            found.fans[i] = fans.fans[0];
            found.normals[i] = around.normal(fans.fans[0]);
            found.scales[i] = around.scale(fans.fans[0]);
            for (std::size_t f = 1; f < fans.count; ++f) {
                turn_like(fans.fans[0], fans.fans[f]);
                found.supplements.push_back({i, fans.fans[f], around.normal(fans.fans[f])});
            }
        }
        found.reasons = std::move(reasons_);
        return found;
    }

private:
    template <typename Body>
    void each(const CallPart& part, Body&& body) {
        each_point(count_, part, [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            for (std::uint32_t i = first; i < last; ++i) {
                around.assign(points_, i, neighbors_.of(i));
                body(i, around);
            }
        });
    }
    NeighborClaims claims_on(std::uint32_t i, const Neighborhood& around) const {
        NeighborClaims claims;
        for (std::uint32_t place = 0; place < k_; ++place) {
            const std::uint32_t neighbor = around.number(place);
            const auto list = neighbors_.of(neighbor);
            const auto at = std::ranges::find(list, i);
            if (at != list.end())
                claims.add(place, fans_[neighbor], static_cast<std::size_t>(at - list.begin()));
        }
        return claims;
    }

    // Reverses the second fan where a gap of it begins where one of the first begins: both then have one
    // sense.
    static void turn_like(const Fan& first, Fan& second) {
        for (std::size_t j = 0; j < first.size; ++j)
            for (std::size_t n = 0; n < second.size; ++n)
                if (first.is_gap(j) && second.is_gap(n) && first.ring[j] == second.ring[n]) {
                    reverse(second);
                    return;
                }
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    const PointSurfaceOptions& options_;
    std::uint32_t k_, count_;
    std::vector<GabrielTriangle> gabriel_;
    std::vector<PointFans> fans_;
    std::vector<glm::dvec3> normals_;  // Of points with one whole umbrella after pass 1; else zero.
    std::vector<UndecidedReason> reasons_;
};

}  // namespace

UmbrellaSet find_thesis_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call) {
    Passes passes(points, neighbors, options);
    passes.first({call, 0.0, 0.4});
    passes.second({call, 0.4, 0.7});
    passes.third({call, 0.7, 1.0});
    return passes.found();
}

}  // namespace rimline
