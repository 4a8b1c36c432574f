#include "silhouette/field/points_of_interest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/steady_point.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_max_rounds = 200;  // Rounds of a climb, 26 samples each. Usually 15.
constexpr std::size_t k_max_fine_climbs = 2;
// Where the lattice only says where climbs start, its sums may err by so many tolerances. At 2, four origins of nine
// models are those found at 1; at 4 they take 12% less time, and the fourth of fandisk has 3% fewer votes.
constexpr double k_lattice_tolerances = 2.0;
// What may be the steadiest peak has this share of the highest score, and is so far from a higher one.
constexpr double k_contending = 0.93;
constexpr double k_contenders_apart_rad = 0.4;
constexpr std::size_t k_max_contenders = 6;

double spacing_of(const SearchDomain& domain, std::uint32_t lattice) {
    return 2.0 * domain.outer_radius / (lattice - 1);
}

// The 26 points of a pattern around its center, moved into the domain.
std::array<glm::dvec3, 26> pattern(const SearchDomain& domain, const glm::dvec3& center,
                                   double width) {
    std::array<glm::dvec3, 26> points;
    std::size_t count = 0;
    for (int x = 1; x >= -1; --x)
        for (int y = 1; y >= -1; --y)
            for (int z = 1; z >= -1; --z)
                if (x != 0 || y != 0 || z != 0)
                    points[count++] = domain.nearest(center + width * glm::dvec3(x, y, z));
    return points;
}

// The six points of a pattern along the axes.
std::array<glm::dvec3, 6> axis_pattern(const SearchDomain& domain, const glm::dvec3& center,
                                       double width) {
    std::array<glm::dvec3, 6> points;
    for (int i = 0; i < 6; ++i) {
        glm::dvec3 step(0.0);
        step[i % 3] = i < 3 ? width : -width;
        points[static_cast<std::size_t>(i)] = domain.nearest(center + step);
    }
    return points;
}

struct Sample {
    glm::dvec3 point;
    double votes;
};

// Runs all climbs in parallel steps.
class Climbs {
public:
    Climbs(const SearchDomain& domain, double width, double tolerance)
        : domain_(domain), width_(width), tolerance_(tolerance) {}

    void start(const Sample& from) { climbs_.push_back({from, width_}); }
    /// Limits all climbs to this ball.
    void stay_within(const glm::dvec3& center, double radius) { ball_ = {center, radius}; }

    /// Continues only the best climbs after all patterns have become small.
    void prune_when_fine() { prunes_ = true; }

    template <typename Values>
    std::vector<Sample> to_peaks(Values&& values) {
        for (std::uint32_t round = 0; round < k_max_rounds; ++round) {
            std::vector<glm::dvec3> points;
            for (const Climb& climb : climbs_)
                if (climb.width >= tolerance_)
                    for (const glm::dvec3& p : pattern(domain_, climb.best.point, climb.width))
                        points.push_back(p);
            if (points.empty()) break;
            evaluate(points, values);
            std::size_t next = 0;
            for (Climb& climb : climbs_) {
                if (climb.width < tolerance_) continue;
                const double before = climb.best.votes;
                for (std::size_t i = 0; i < 26; ++i, ++next) {
                    const double votes = votes_.at(key_of(points[next]));
                    if (votes > climb.best.votes && is_allowed(points[next]))
                        climb.best = {points[next], votes};
                }
                if (climb.best.votes == before) climb.width *= 0.5;
            }
            if (prunes_) prune();
        }
        std::vector<Sample> peaks;
        for (const Climb& climb : climbs_) peaks.push_back(climb.best);
        return peaks;
    }

private:
    struct Climb {
        Sample best;
        double width;
    };
    using Key = std::array<double, 3>;
    static Key key_of(const glm::dvec3& point) { return {point.x, point.y, point.z}; }

    // Sets votes_ of the points. Patterns overlap where they move by less than their width, and climbs meet: a third of
    // all points are there already.
    template <typename Values>
    void evaluate(std::span<const glm::dvec3> points, Values&& values) {
        std::vector<glm::dvec3> unknown;
        for (const glm::dvec3& point : points)
            if (votes_.try_emplace(key_of(point), 0.0).second) unknown.push_back(point);
        std::vector<double> votes(unknown.size());
        values(unknown, votes);
        for (std::size_t i = 0; i < unknown.size(); ++i) votes_[key_of(unknown[i])] = votes[i];
    }
    // When all patterns are much smaller than at the start, the order of the climbs rarely changes.
    void prune() {
        if (climbs_.size() <= k_max_fine_climbs) return;
        for (const Climb& climb : climbs_)
            if (climb.width > 0.125 * width_) return;
        std::ranges::stable_sort(climbs_, std::greater(),
                                 [](const Climb& climb) { return climb.best.votes; });
        climbs_.erase(climbs_.begin() + k_max_fine_climbs, climbs_.end());
    }
    bool is_allowed(const glm::dvec3& point) const {
        return !ball_ || glm::distance(point, ball_->first) <= ball_->second;
    }

    SearchDomain domain_;
    double width_;
    double tolerance_;
    bool prunes_ = false;
    std::optional<std::pair<glm::dvec3, double>> ball_;
    std::vector<Climb> climbs_;
    std::map<Key, double> votes_;  // Of all points so far.
};

// The lattice's samples in the domain, in descending order of x, then y, then z. Also finds local maxima.
class Lattice {
public:
    Lattice(const SearchDomain& domain, std::uint32_t size)
        : size_(static_cast<int>(size)), number_(std::size_t{size} * size * size, -1) {
        const double spacing = spacing_of(domain, size);
        const double last = 0.5 * (size - 1);
        for (int x = size_ - 1; x >= 0; --x)
            for (int y = size_ - 1; y >= 0; --y)
                for (int z = size_ - 1; z >= 0; --z) {
                    const glm::dvec3 point = spacing * (glm::dvec3(x, y, z) - last);
                    if (!domain.contains(point)) continue;
                    number_[place(x, y, z)] = static_cast<int>(points_.size());
                    points_.push_back(point);
                    places_.push_back({x, y, z});
                }
        // A thin shell may contain no sample.
        if (points_.empty()) {
            for (const glm::dvec3& p : pattern(domain, glm::dvec3(0.0), domain.outer_radius))
                points_.push_back(p);
        }
    }

    std::span<const glm::dvec3> points() const { return points_; }

    /// Whether a sample is a multiple of `stride` from the center along each axis.
    bool is_at_stride(std::size_t sample, std::uint32_t stride) const {
        if (places_.empty()) return true;
        return std::ranges::all_of(places_[sample], [&](int place) {
            return (place - size_ / 2) % static_cast<int>(stride) == 0;
        });
    }

    /// The best local maxima, best first.
    std::vector<Sample> local_maxima(std::span<const double> votes, std::size_t max_count) const {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (is_local_maximum(i, votes)) order.push_back(i);
        std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return votes[i]; });
        std::vector<Sample> samples;
        for (std::size_t i = 0; i < std::min(max_count, order.size()); ++i)
            samples.push_back({points_[order[i]], votes[order[i]]});
        return samples;
    }

private:
    std::size_t place(int x, int y, int z) const {
        return (static_cast<std::size_t>(x) * size_ + y) * size_ + z;
    }
    bool is_local_maximum(std::size_t i, std::span<const double> votes) const {
        if (places_.empty()) return true;
        const auto [x, y, z] = places_[i];
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dz = -1; dz <= 1; ++dz) {
                    if (std::min({x + dx, y + dy, z + dz}) < 0 ||
                        std::max({x + dx, y + dy, z + dz}) >= size_)
                        continue;
                    const int other = number_[place(x + dx, y + dy, z + dz)];
                    if (other >= 0 && votes[static_cast<std::size_t>(other)] > votes[i])
                        return false;
                }
        return true;
    }

    int size_;
    std::vector<int> number_;  // By lattice position. -1 outside the domain.
    std::vector<glm::dvec3> points_;
    std::vector<std::array<int, 3>> places_;
};

class Search {
public:
    Search(const TangentialField& field, const SearchDomain& domain, const InterestOptions& options)
        : votes_(field),
          domain_(domain),
          options_(options),
          lattice_(domain, options.lattice),
          tie_(0x1p-20 * field.max_value()),
          min_(std::max(field.error_bound(), tie_)) {}

    PointsOfInterest run(const LongCall& call) {
        for (std::uint32_t k = 0; k < options_.count; ++k) {
            const double begin = static_cast<double>(k) / options_.count;
            const LongCall part{
                call.stop, [&](double done) { call.checkpoint(begin + done / options_.count); }};
            const std::optional<PointOfInterest> best = find_next(part);
            if (!best) break;
            result_.points.push_back(*best);
            if (k + 1 == options_.count) break;
            votes_.discount(best->point);
            if (options_.mirror_axis) votes_.discount(mirrored(best->point));
        }
        call.checkpoint(1.0);
        return std::move(result_);
    }

private:
    void evaluate(std::span<const glm::dvec3> points, std::span<double> out, const LongCall& call,
                  double tolerances = 1.0) {
        votes_.values(points, out, call, tolerances);
        result_.evaluations += points.size();
    }

    std::optional<PointOfInterest> find_next(const LongCall& call) {
        // The lattice takes about half of the time.
        std::vector<double> votes(lattice_.points().size());
        evaluate(lattice_.points(), votes,
                 {call.stop, [&](double done) { call.checkpoint(0.5 * done); }},
                 options_.weigh ? 1.0 : k_lattice_tolerances);
        const LongCall silent{call.stop, {}};
        Climbs climbs(domain_, 0.5 * spacing_of(domain_, options_.lattice), options_.tolerance);
        // With weights, any peak may win.
        if (!options_.weigh) climbs.prune_when_fine();
        for (const Sample& start : starts(votes, silent)) climbs.start(start);
        const std::vector<Sample> peaks =
            climbs.to_peaks([&](std::span<const glm::dvec3> points, std::span<double> out) {
                evaluate(points, out, silent);
            });
        std::vector<Sample> candidates;
        for (const Sample& peak : peaks) {
            const bool is_new = std::ranges::none_of(candidates, [&](const Sample& c) {
                return glm::distance(c.point, peak.point) <= 4.0 * options_.tolerance;
            });
            if (is_new) candidates.push_back(peak);
        }
        // Without weights, no sample has more votes than the best peak, up to the samples' error.
        if (options_.weigh)
            for (std::size_t i = 0; i < votes.size(); ++i)
                if (lattice_.is_at_stride(i, options_.weighed_stride))
                    candidates.push_back({lattice_.points()[i], votes[i]});
        call.checkpoint(0.7);
        std::erase_if(candidates, [&](const Sample& c) { return !is_allowed(c.point); });
        std::optional<PointOfInterest> best;
        if (options_.steady && result_.points.empty()) {
            best = steadiest_of(candidates, silent);
        } else {
            best = best_of(candidates, std::nullopt, silent);
            if (best && options_.weigh) best = refine(*best, silent);
        }
        call.checkpoint(1.0);
        return best;
    }

    // The same point without a mirror.
    glm::dvec3 mirrored(glm::dvec3 point) const {
        if (options_.mirror_axis) point[*options_.mirror_axis] *= -1.0;
        return point;
    }

    // No later point lies on the plateau of a steady one.
    bool is_allowed(const glm::dvec3& point) const {
        return !options_.steady || result_.points.empty() ||
               !is_on_plateau(point, result_.points.front().point);
    }

    // The middle of the plateau (steady_point.h) of that of the best candidates around which scores are highest.
    std::optional<PointOfInterest> steadiest_of(std::span<const Sample> candidates,
                                                const LongCall& call) {
        const ScorePoints score = [&](std::span<const glm::dvec3> points) {
            std::vector<double> scores;
            for (const PointOfInterest& point : scored(points, call))
                scores.push_back(point.score());
            return scores;
        };
        std::optional<PointOfInterest> best;
        double highest = 0.0;
        for (const PointOfInterest& contender : contenders_of(candidates, call)) {
            const PointOfInterest peak = refine(contender, call);
            const double mean = mean_score_near(peak.point, score);
            const bool ties = best && std::abs(mean - highest) <= tie_;
            if (ties ? comes_before(peak.point, best->point) : mean > highest) {
                best = peak;
                highest = mean;
            }
        }
        if (!best) return best;
        // Noise decides which of two halves has more: the sight of both is the same.
        const glm::dvec3 other_half = mirrored(best->point);
        if (options_.mirror_axis && comes_before(other_half, best->point)) {
            const PointOfInterest peak = refine(scored({&other_half, 1}, call).front(), call);
            if (mean_score_near(peak.point, score) >= k_contending * highest) best = peak;
        }
        const glm::dvec3 middle = middle_of_plateau(best->point, score);
        return scored({&middle, 1}, call).front();
    }

    // Candidates that are apart, best first.
    std::vector<PointOfInterest> contenders_of(std::span<const Sample> candidates,
                                               const LongCall& call) {
        std::vector<PointOfInterest> all = weighed_of(candidates, std::nullopt, k_contending, call);
        std::ranges::stable_sort(all, std::greater(), &PointOfInterest::score);
        std::vector<PointOfInterest> contenders;
        for (const PointOfInterest& point : all) {
            if (point.score() <= 0.0 || point.score() < k_contending * all.front().score()) break;
            const bool is_apart = std::ranges::none_of(contenders, [&](const PointOfInterest& c) {
                return glm::dot(glm::normalize(c.point), glm::normalize(point.point)) >
                       std::cos(k_contenders_apart_rad);
            });
            if (is_apart) contenders.push_back(point);
            if (contenders.size() == k_max_contenders) break;
        }
        return contenders;
    }

    std::vector<PointOfInterest> scored(std::span<const glm::dvec3> points, const LongCall& call) {
        std::vector<double> votes(points.size());
        evaluate(points, votes, call);
        const std::vector<double> weights = weights_of(points);
        result_.candidates += points.size();
        std::vector<PointOfInterest> scored;
        for (std::size_t i = 0; i < points.size(); ++i)
            scored.push_back({points[i], votes[i], weights[i]});
        return scored;
    }

    // The best local maxima of the lattice, with votes as exact as those of climbs.
    std::vector<Sample> starts(std::span<const double> votes, const LongCall& call) {
        std::vector<Sample> maxima = lattice_.local_maxima(votes, options_.climbs);
        if (options_.weigh) return maxima;
        std::vector<glm::dvec3> points;
        for (const Sample& maximum : maxima) points.push_back(maximum.point);
        std::vector<double> own(points.size());
        evaluate(points, own, call);
        for (std::size_t i = 0; i < maxima.size(); ++i) maxima[i].votes = own[i];
        return maxima;
    }

    // Returns the same point, or a better one near it.
    PointOfInterest refine(PointOfInterest best, const LongCall& call) {
        double width = 0.5 * spacing_of(domain_, options_.lattice) * options_.weighed_stride;
        for (std::uint32_t round = 0; round < k_max_rounds && width >= options_.weighed_tolerance;
             ++round) {
            const auto points = axis_pattern(domain_, best.point, width);
            std::array<double, 6> votes;
            evaluate(points, votes, call);
            std::vector<Sample> candidates;
            for (std::size_t i = 0; i < 6; ++i)
                if (is_allowed(points[i])) candidates.push_back({points[i], votes[i]});
            const std::optional<PointOfInterest> other = best_of(candidates, best.score(), call);
            if (other && other->score() > best.score() + tie_)
                best = *other;
            else
                width *= 0.5;
        }
        return best;
    }

    // The candidate with the best score, or nothing if none has votes. May skip candidates that cannot
    // exceed `bar`.
    std::optional<PointOfInterest> best_of(std::span<const Sample> candidates,
                                           std::optional<double> bar, const LongCall& call) {
        const std::vector<PointOfInterest> weighed = weighed_of(candidates, bar, 1.0, call);
        double max_score = bar.value_or(0.0);
        for (const PointOfInterest& point : weighed) max_score = std::max(max_score, point.score());
        // Resolves ties with the maximum score.
        std::optional<PointOfInterest> best;
        for (const PointOfInterest& point : weighed) {
            if (point.score() < max_score - tie_ || point.score() <= 0.0) continue;
            if (!best || comes_before(point.point, best->point)) best = point;
        }
        return best;
    }

    // Weighs candidates in falling order of what they may score. May skip those that cannot score `share` of the best
    // of them and `bar`.
    std::vector<PointOfInterest> weighed_of(std::span<const Sample> candidates,
                                            std::optional<double> bar, double share,
                                            const LongCall& call) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (candidates[i].votes > min_) order.push_back(i);
        const std::vector<double> highest = highest_scores(candidates);
        std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return highest[i]; });
        if (options_.weigh) result_.candidates += order.size();

        std::vector<PointOfInterest> weighed;
        double max_score = bar.value_or(0.0);
        std::size_t next = 0;
        while (next < order.size()) {
            std::vector<glm::dvec3> batch;
            const std::size_t begin = next;
            for (; next < order.size() && batch.size() < options_.weigh_batch; ++next) {
                const Sample& candidate = candidates[order[next]];
                if (!options_.weighs_all && highest[order[next]] < share * max_score - tie_) break;
                batch.push_back(candidate.point);
            }
            if (batch.empty()) break;
            call.checkpoint(0.0);
            const std::vector<double> weights = weights_of(batch);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                weighed.push_back({batch[i], candidates[order[begin + i]].votes, weights[i]});
                max_score = std::max(max_score, weighed.back().score());
            }
        }
        return weighed;
    }

    std::vector<double> highest_scores(std::span<const Sample> candidates) const {
        std::vector<double> scores;
        for (const Sample& candidate : candidates) scores.push_back(candidate.votes);
        if (!options_.weigh || !options_.bound) return scores;
        std::vector<glm::dvec3> points;
        for (const Sample& candidate : candidates) points.push_back(candidate.point);
        const std::vector<double> bounds = options_.bound(points, result_.points.size());
        RIMLINE_CHECK(bounds.size() == points.size());
        for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= bounds[i];
        return scores;
    }

    std::vector<double> weights_of(std::span<const glm::dvec3> points) {
        if (!options_.weigh) return std::vector<double>(points.size(), 1.0);
        std::vector<double> weights;
        while (weights.size() < points.size()) {
            const std::span<const glm::dvec3> left = points.subspan(weights.size());
            const auto batch = left.first(std::min<std::size_t>(left.size(), options_.weigh_batch));
            const std::vector<double> some = options_.weigh(batch, result_.points.size());
            RIMLINE_CHECK(some.size() == batch.size());
            weights.insert(weights.end(), some.begin(), some.end());
        }
        for (const double weight : weights) RIMLINE_CHECK(weight >= 0.0 && weight <= 1.0);
        result_.weighed += points.size();
        return weights;
    }

    // The order among equal scores. Positions of symmetric peaks have errors of a few tolerances.
    bool comes_before(const glm::dvec3& a, const glm::dvec3& b) const {
        const auto key = [&](const glm::dvec3& p) {
            const glm::dvec3 q = glm::round(p / (8.0 * options_.tolerance));
            return std::tuple(q.x, q.y, q.z);
        };
        return key(a) > key(b);
    }

    DiscountedField votes_;
    SearchDomain domain_;
    const InterestOptions& options_;
    Lattice lattice_;
    double tie_;
    double min_;
    PointsOfInterest result_;
};

void check(const SearchDomain& domain) {
    RIMLINE_CHECK(domain.inner_radius >= 0.0 && domain.inner_radius <= domain.outer_radius);
    RIMLINE_CHECK(domain.outer_radius > 0.0 && std::isfinite(domain.outer_radius));
}

}  // namespace

glm::dvec3 SearchDomain::nearest(const glm::dvec3& point) const {
    const double length = glm::length(point);
    if (length > outer_radius) return point * (outer_radius / length);
    if (length >= inner_radius) return point;
    return length > 0.0 ? point * (inner_radius / length) : glm::dvec3(inner_radius, 0.0, 0.0);
}

bool SearchDomain::contains(const glm::dvec3& point) const {
    const double square = glm::dot(point, point);
    return square >= inner_radius * inner_radius && square <= outer_radius * outer_radius;
}

PointsOfInterest find_points_of_interest(const TangentialField& field, const SearchDomain& domain,
                                         const InterestOptions& options, const LongCall& call) {
    check(domain);
    RIMLINE_CHECK(options.lattice >= 2 && options.lattice <= 1024);
    RIMLINE_CHECK(!options.mirror_axis || (*options.mirror_axis >= 0 && *options.mirror_axis <= 2));
    RIMLINE_CHECK(options.tolerance > 0.0 && options.weighed_tolerance > 0.0);
    RIMLINE_CHECK(!options.steady || (options.weigh && domain.inner_radius > 0.0));
    RIMLINE_CHECK(options.climbs >= 1 && options.weigh_batch >= 1 && options.weighed_stride >= 1);
    return Search(field, domain, options).run(call);
}

PointOfInterest climb(const TangentialField& field, const SearchDomain& domain,
                      const glm::dvec3& from, double within, double tolerance) {
    check(domain);
    RIMLINE_CHECK(within >= 0.0 && tolerance > 0.0);
    const glm::dvec3 start = domain.nearest(from);
    Climbs climbs(domain, 0.5 * within, tolerance);
    climbs.stay_within(start, within);
    climbs.start({start, field.value(start)});
    const Sample peak = climbs
                            .to_peaks([&](std::span<const glm::dvec3> points,
                                          std::span<double> out) { field.values(points, out); })
                            .front();
    return {peak.point, peak.votes};
}

}  // namespace rimline
