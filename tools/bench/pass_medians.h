#pragma once

// Medians of the times of passes over frames (FrameReport::passes).

#include <string>
#include <vector>

#include "engine/frame_report.h"

namespace rimline::tools {

class PassMedians {
public:
    void add(const FrameReport& report);

    /// A time for each pass, in the order of a frame. Empty where the device's queue has no timestamps.
    std::vector<PassTime> each() const;
    /// The median of a frame's sum over the passes whose names begin with `kind`: "surfaces", or "" for all.
    /// 0 where there are none.
    double sum_ms(const std::string& kind) const;

private:
    std::vector<std::vector<PassTime>> frames_;
};

}  // namespace rimline::tools
