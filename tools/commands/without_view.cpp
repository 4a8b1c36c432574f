// rimline view in a build without the window.

#include "tools/absent_part.h"

namespace rimline::tools {

std::unique_ptr<Command> make_view_command() {
    return std::make_unique<AbsentCommand>(BuildPart::window, "view",
                                           "Open a window to walk around a model in");
}

}  // namespace rimline::tools
