// The suites of `rimline bench` that need Vulkan in a build without the engine.

#include "tools/absent_part.h"
#include "tools/bench/suites.h"

namespace rimline::tools {

std::unique_ptr<Command> make_engine_suite() {
    return std::make_unique<AbsentCommand>(BuildPart::engine, "engine",
                                           "Streams and frames on a Vulkan device", "bench");
}

std::unique_ptr<Command> make_frames_suite() {
    return std::make_unique<AbsentCommand>(BuildPart::engine, "frames",
                                           "What a frame's time depends on", "bench");
}

std::unique_ptr<Command> make_views_suite() {
    return std::make_unique<AbsentCommand>(
        BuildPart::engine, "views", "The best views and lights beside those of other measures",
        "bench");
}

}  // namespace rimline::tools
