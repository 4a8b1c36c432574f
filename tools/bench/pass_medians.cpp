#include "tools/bench/pass_medians.h"

#include "tools/timing.h"

namespace rimline::tools {

void PassMedians::add(const FrameReport& report) {
    if (!report.passes.empty()) frames_.push_back(report.passes);
}

std::vector<PassTime> PassMedians::each() const {
    if (frames_.empty()) return {};
    std::vector<PassTime> medians;
    for (const PassTime& pass : frames_.back()) {
        std::vector<double> times_ms;
        for (const std::vector<PassTime>& frame : frames_)
            for (const PassTime& other : frame)
                if (other.name == pass.name) times_ms.push_back(other.time_ms);
        medians.push_back({pass.name, quantile(times_ms, 0.5)});
    }
    return medians;
}

double PassMedians::sum_ms(const std::string& kind) const {
    std::vector<double> sums_ms;
    for (const std::vector<PassTime>& frame : frames_) {
        sums_ms.push_back(0.0);
        for (const PassTime& pass : frame)
            if (pass.name.starts_with(kind)) sums_ms.back() += pass.time_ms;
    }
    return sums_ms.empty() ? 0.0 : quantile(sums_ms, 0.5);
}

}  // namespace rimline::tools
