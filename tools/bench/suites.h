#pragma once

// The suites of `rimline bench`: one Command and one file a suite, its options the command's members.

#include <memory>

#include "tools/command.h"

namespace rimline::tools {

std::unique_ptr<Command> make_hough_suite();
std::unique_ptr<Command> make_service_suite();
std::unique_ptr<Command> make_engine_suite();
std::unique_ptr<Command> make_frames_suite();
std::unique_ptr<Command> make_fields_suite();
std::unique_ptr<Command> make_views_suite();
std::unique_ptr<Command> make_points_suite();
std::unique_ptr<Command> make_lines_suite();
std::unique_ptr<Command> make_edges_suite();

}  // namespace rimline::tools
