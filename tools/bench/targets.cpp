#include "tools/bench/targets.h"

#include <cmath>
#include <cstdio>

namespace rimline::tools {

void print_targets(std::span<const Target> targets) {
    for (const Target& target : targets) {
        const char* const unit = target.unit.c_str();
        std::printf("  %-52s %9.3g%s, %s %.3g", target.what.c_str(), target.value, unit,
                    target.less_is_better ? "at most" : "at least", target.reach);
        if (target.aim > 0.0) std::printf(" (aim %.3g)", target.aim);
        std::printf(target.is_reached() ? ": reached" : ": MISSED");
        if (!target.is_reached() && std::isfinite(target.shortfall()))
            std::printf(", by a factor of %.2f", target.shortfall());
        std::printf("%s\n",
                    !target.is_reached() && target.is_time ? "; a time, which fails nothing" : "");
    }
}

ExitStatus report_missed(const std::string& missed) {
    return report_check(missed.empty() ? "" : missed + ": missed");
}

std::string first_missed(std::span<const Target> targets) {
    for (const Target& target : targets)
        if (!target.is_reached() && !target.is_time) return target.what;
    return {};
}

void TargetList::add(const std::string& model, std::span<const Target> targets) {
    const std::string missed = tools::first_missed(targets);
    if (first_missed_.empty() && !missed.empty()) first_missed_ = model + ": " + missed;
    for (const Target& target : targets)
        json_.push_back({{"model", model},
                         {"target", target.what},
                         {"value", target.value},
                         {"reach", target.reach},
                         {"aim", target.aim},
                         {"less_is_better", target.less_is_better},
                         {"is_time", target.is_time},
                         {"reached", target.is_reached()}});
}

}  // namespace rimline::tools
