// What `rimline bench` does in a build without the other silhouette methods.

#include "tools/absent_part.h"
#include "tools/bench/machine.h"
#include "tools/bench/suites.h"

namespace rimline::tools {

std::unique_ptr<Command> make_hough_suite() {
    return std::make_unique<AbsentCommand>(BuildPart::methods, "hough",
                                           "The octree and its tracker against the other methods",
                                           "bench");
}

}  // namespace rimline::tools
