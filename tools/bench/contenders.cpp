#include "tools/bench/contenders.h"

#include <algorithm>
#include <limits>

#include "silhouette/error.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// Sums the own counts of all points. time_in_turn() divides the sums at the end.
void add_counts(std::vector<Times::OwnCount>& sums, const std::vector<NamedCount>& counts) {
    for (const NamedCount& count : counts) {
        const auto found = std::ranges::find(sums, count.name, &Times::OwnCount::name);
        if (found == sums.end())
            sums.push_back({std::string(count.name), static_cast<double>(count.count)});
        else
            found->mean += static_cast<double>(count.count);
    }
}

void run_round(const Contender& contender, std::span<const HomogeneousPoint> points,
               bool is_warm_up, Times& times, const Context& context) {
    if (contender.prepare) contender.prepare();
    for (std::size_t i = 0, k = 0; i < points.size(); i += contender.every, ++k) {
        context.checkpoint();
        const double us = time_step_us([&] { contender.step(points[i]); });
        if (!is_warm_up) {
            times.us[k] = std::min(times.us[k], us);
            continue;
        }
        times.us.push_back(std::numeric_limits<double>::infinity());
        times.work.push_back(contender.counters());
        if (contender.own_counts) add_counts(times.own_counts, contender.own_counts());
    }
}

}  // namespace

std::vector<Times> time_in_turn(std::span<const Contender> contenders,
                                std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                                const std::string& doing, const Context& context) {
    RIMLINE_CHECK(!points.empty());
    std::vector<Times> results;
    for (const Contender& contender : contenders)
        results.push_back({contender.name, contender.is_part, {}, {}, {}});
    Progress progress(context, doing);
    const LongCall call = progress.call();
    const double share = 1.0 / (static_cast<double>(contenders.size()) * (rounds + 1.0));
    double done = 0.0;
    for (std::uint32_t round = 0; round <= rounds; ++round) {
        for (std::size_t c = 0; c < contenders.size(); ++c) {
            call.checkpoint(done);
            done += share;
            run_round(contenders[c], points, round == 0, results[c], context);
        }
    }
    for (Times& times : results)
        for (Times::OwnCount& count : times.own_counts)
            count.mean /= static_cast<double>(times.us.size());
    return results;
}

double Times::mean_us() const {
    double sum = 0.0;
    for (const double value : us) sum += value;
    return sum / static_cast<double>(us.size());
}

double Times::quantile_us(double share) const { return quantile(us, share); }

TraversalCounters Times::mean_work() const {
    TraversalCounters sum;
    for (const TraversalCounters& counters : work) sum += counters;
    const std::size_t n = work.size();
    return {sum.box_checks / n, sum.face_checks / n, sum.edge_checks / n};
}

}  // namespace rimline::tools
