// Stands in for rimline view in a build without it: it says so, whatever it is asked.

#include "tools/command.h"

namespace rimline::tools {

namespace {

class WithoutViewCommand final : public Command {
public:
    std::string name() const override { return "view"; }
    std::string summary() const override {
        return "Open a window to walk around a model in (not in this build)";
    }
    void add_options(CLI::App& app) override { app.allow_extras(); }
    ExitStatus run(const Context&) override {
        throw Error(ErrorCode::no_device,
                    "view: this rimline was built without its window; install GLFW and Dear ImGui "
                    "(libglfw3-dev, libimgui-dev), configure with -DRIMLINE_ENGINE=ON "
                    "-DRIMLINE_VIEW=ON and build again");
    }
};

}  // namespace

std::unique_ptr<Command> make_view_command() { return std::make_unique<WithoutViewCommand>(); }

}  // namespace rimline::tools
