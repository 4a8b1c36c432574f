#pragma once

// What recording a frame produces besides commands, kept until the GPU is done with the frame.

#include <chrono>
#include <vector>

#include "engine/frame_report.h"
#include "engine/stream/deforming_instance.h"
#include "engine/stream/tracked_silhouette.h"

namespace rimline {

struct RecordedFrame {
    std::chrono::steady_clock::time_point started;
    std::vector<TrackedSilhouette*> silhouettes;  ///< Those whose streams the frame records.
    DeformedFrame deformed;
    FrameReport report;
};

}  // namespace rimline
