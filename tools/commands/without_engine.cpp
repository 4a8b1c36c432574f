// Stands in for the subcommands that need Vulkan in a build without it: they say so, whatever they are
// asked.

#include "tools/bench/engine_request.h"
#include "tools/bench/views_request.h"
#include "tools/command.h"
#include "tools/output/points_picture.h"

namespace rimline::tools {

namespace {

class WithoutEngineCommand final : public Command {
public:
    WithoutEngineCommand(std::string name, std::string summary)
        : name_(std::move(name)), summary_(std::move(summary)) {}

    std::string name() const override { return name_; }
    std::string summary() const override { return summary_ + " (not in this build)"; }
    void add_options(CLI::App& app) override { app.allow_extras(); }
    ExitStatus run(const Context&) override {
        throw Error(ErrorCode::no_device,
                    name_ +
                        ": this rimline was built without the engine; configure it with "
                        "-DRIMLINE_ENGINE=ON and build again");
    }

private:
    std::string name_;
    std::string summary_;
};

}  // namespace

std::unique_ptr<Command> make_render_command() {
    return std::make_unique<WithoutEngineCommand>("render", "Draw one picture");
}

std::unique_ptr<Command> make_animate_command() {
    return std::make_unique<WithoutEngineCommand>("animate", "Draw a sequence of pictures");
}

std::unique_ptr<Command> make_devices_command() {
    return std::make_unique<WithoutEngineCommand>("devices", "List the Vulkan devices");
}

ExitStatus run_bench_engine(const EngineBenchRequest&, const Context&) {
    throw Error(ErrorCode::no_device,
                "bench engine: this rimline was built without the engine; configure it with "
                "-DRIMLINE_ENGINE=ON and build again");
}

ExitStatus run_bench_views(const ViewsBenchRequest&, const Context&) {
    throw Error(ErrorCode::no_device,
                "bench views: this rimline was built without the engine; configure it with "
                "-DRIMLINE_ENGINE=ON and build again");
}

PointsPictureReport draw_points(const PointsPicture&, OutputFile&) {
    throw Error(ErrorCode::no_device,
                "points -o: this rimline was built without the engine; configure it with "
                "-DRIMLINE_ENGINE=ON and build again");
}

}  // namespace rimline::tools
