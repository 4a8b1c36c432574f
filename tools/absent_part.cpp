#include "tools/absent_part.h"

#include <CLI/App.hpp>
#include <utility>

namespace rimline::tools {

Error absent_part_error(const std::string& what, BuildPart part) {
    const std::string start = what + ": this rimline was built without ";
    const std::string end = " and build again";
    switch (part) {
        case BuildPart::engine:
            return {ErrorCode::no_device,
                    start + "the engine; configure it with -DRIMLINE_ENGINE=ON" + end};
        case BuildPart::window:
            return {ErrorCode::no_device,
                    start +
                        "its window; install GLFW and Dear ImGui (libglfw3-dev, libimgui-dev), "
                        "configure with -DRIMLINE_ENGINE=ON -DRIMLINE_VIEW=ON" +
                        end};
        case BuildPart::methods:
            return {ErrorCode::bad_input,
                    start + "the other silhouette methods; configure it with -DRIMLINE_METHODS=ON" +
                        end};
    }
    RIMLINE_CHECK(false);
}

void require_methods([[maybe_unused]] const std::string& what) {
    if constexpr (!RIMLINE_HAS_METHODS) throw absent_part_error(what, BuildPart::methods);
}

AbsentCommand::AbsentCommand(BuildPart part, std::string name, std::string summary,
                             std::string parent)
    : part_(part),
      name_(std::move(name)),
      summary_(std::move(summary)),
      parent_(std::move(parent)) {}

std::string AbsentCommand::summary() const { return summary_ + " (not in this build)"; }

void AbsentCommand::add_options(CLI::App& app) { app.allow_extras(); }

ExitStatus AbsentCommand::run(const Context&) {
    throw absent_part_error(parent_.empty() ? name_ : parent_ + " " + name_, part_);
}

}  // namespace rimline::tools
