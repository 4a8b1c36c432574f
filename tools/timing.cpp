#include "tools/timing.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "silhouette/error.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

double thread_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

// The own counts of all points, summed up; the mean is made at the end.
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

double time_step_us(const std::function<void()>& step) {
    const double thread_start_us = thread_us();
    const Clock::time_point start = Clock::now();
    step();
    const std::chrono::duration<double, std::micro> took = Clock::now() - start;
    return std::min(took.count(), thread_us() - thread_start_us);
}

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

double quantile(std::vector<double> values, double share) {
    RIMLINE_CHECK(!values.empty());
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto at =
        values.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(rank), 1) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace rimline::tools
