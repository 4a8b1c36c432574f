// rimline view: an interactive window that shows a model or a cloud and its silhouette.

#include <CLI/App.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "engine/vulkan/vulkan_instance.h"
#include "tools/command.h"
#include "tools/options/up_option.h"
#include "tools/output/output_file.h"
#include "tools/process/interrupt.h"
#include "tools/progress.h"
#include "tools/view/view_arguments.h"
#include "tools/view/view_loop.h"

namespace rimline::tools {

namespace {

class ViewCommand final : public Command {
public:
    std::string name() const override { return "view"; }
    std::string summary() const override { return "Open a window that shows a model or a cloud"; }

    void add_options(CLI::App& app) override {
        view_.add_to(app);
        constexpr const char* k_window = "Window";
        app.add_flag("--no-panel", no_panel_,
                     "Show only the picture: no panel, and mouse and keys do nothing")
            ->group(k_window);
        app.add_flag("--inspect", inspect_, "Start with the Hough space window open")
            ->group(k_window);
        add_count(app, "--frames", frames_, 1, 1'000'000,
                  "Close after this number of frames (default: the user closes the window)")
            ->default_str("")
            ->group(k_window);
        add_output(app, "--screenshot", screenshot_, ".png",
                   "Save the window in the last of --frames to this PNG file")
            ->group(k_window);
        app.footer(
            "Without a model, a built-in scene is shown. Drop a file on the window to open it. A "
            "file "
            "without\n"
            "faces is shown as a cloud: its points, borders and features, and its silhouette in "
            "ink. "
            "Drag to orbit,\n"
            "drag with the right button to pan, turn the wheel to zoom, drag the handles of lights "
            "to "
            "move them. The\n"
            "panel has best views to click, flying, styles, a frozen silhouette to be viewed from "
            "other viewpoints,\n"
            "and Hough space. It adds models to the scene, moves and paints them. P saves a "
            "picture, X "
            "a scene file,\n"
            "which render, animate and view read, C copies the command that draws the picture, and "
            "Ctrl+Z undoes.\n"
            "Several models make a scene, as in render.\n\n"
            "Examples:\n"
            "  rimline view horse.ply\n"
            "  rimline view shape:knot --style toon --ground --inspect\n"
            "  rimline view scan.xyz\n"
            "  rimline view --frames 1 --screenshot window.png");
    }

    bool has_json() const override { return false; }

    ExitStatus run(const Context& context) override {
        if (context.json) throw UsageError("view has nothing to say in --json");
        view_.settle();
        if (!screenshot_.empty() && frames_ == 0)
            throw UsageError("--screenshot needs --frames, to know which frame is the last");
        std::optional<OutputFile> screenshot;
        if (!screenshot_.empty()) {
            view_.models().check_output_is_no_input(screenshot_);
            screenshot.emplace(screenshot_);
        }

        // Who ends a window by a signal has what was wanted.
        if (frames_ == 0) end_without_words();
        // Before the model is loaded, so that a missing display is reported at once.
        const PictureOptions& picture = view_.picture();
        Window window("Rimline - " + view_.models().name(), static_cast<int>(picture.size.width),
                      static_cast<int>(picture.size.height), least_size());
        const VulkanInstance instance(
            {.validate = picture.validate, .window_extensions = window.vulkan_extensions()});
        ViewSession session;
        const bool fits = view_.fits();
        std::optional<OpenedView> loaded = open(context, window);
        if (!loaded) return ExitStatus::success;
        OpenedView opened = std::move(*loaded);
        for (const std::string& warning : opened.document.warnings()) print_warning(warning);
        print_up(opened.up);
        std::vector<std::string> warnings = opened.warnings;
        for (const std::string& warning : opened.document.warnings()) warnings.push_back(warning);
        const std::optional<ImageSize> picture_size = opened.size;
        if (no_panel_) opened.frame_aspect.reset();  // The picture is all of the window.
        session.show(std::move(opened));
        ViewLoop loop(window, instance, session,
                      {.device = picture.device,
                       .panel = !no_panel_,
                       .inspector = inspect_,
                       .frames = frames_,
                       .fits = fits,
                       .picture_size = picture_size,
                       .warnings = std::move(warnings)});
        loop.run(context);
        if (screenshot) {
            const std::vector<std::byte> png = encode_png(loop.captured());
            screenshot->write({reinterpret_cast<const char*>(png.data()), png.size()});
            screenshot->commit();
        }
        if (const auto count = instance.validation_message_count(); count.value_or(0) > 0)
            throw Error(ErrorCode::no_device,
                        "validation: " + std::to_string(*count) +
                            " messages, the first: " + instance.first_validation_message());
        return ExitStatus::success;
    }

private:
    // Of a window that may differ from the picture's size. A run for a screenshot has what it is asked for.
    std::optional<Window::Least> least_size() const {
        const bool has_size_of_scene = view_.models().scene_size() == view_.picture().size;
        if (no_panel_) return frames_ == 0 ? std::optional(Window::Least{}) : std::nullopt;
        if (frames_ > 0 && !has_size_of_scene) return {};
        return Window::Least{.width = 800, .height = 600};
    }

    // Says in the window's title how far it is. Nothing if the window is closed meanwhile.
    std::optional<OpenedView> open(const Context& context, Window& window) {
        std::stop_source closed;
        const std::stop_callback on_stop(context.stop, [&] { closed.request_stop(); });
        const auto watched = [&](const LongCall& call, const std::string& task) {
            return LongCall{
                closed.get_token(), [&, call, task](double done) {
                    if (call.progress) call.progress(done);
                    window.poll(0.0);
                    if (window.should_close()) closed.request_stop();
                    const int percent = static_cast<int>(100.0 * done);
                    window.set_title("Rimline - " + task + ", " + std::to_string(percent) + "%");
                }};
        };
        try {
            OpenedView opened = follow_progress(context, [&](const BeginCall& begin) {
                return view_.open(
                    [&](const std::string& task) { return watched(begin(task), task); }, inspect_);
            });
            window.set_title("Rimline - " + view_.models().name());
            return opened;
        } catch (const Error& error) {
            const bool was_closed = error.code() == ErrorCode::cancelled && window.should_close();
            if (!was_closed) throw;
            return std::nullopt;
        }
    }

    ViewArguments view_;
    bool no_panel_ = false;
    bool inspect_ = false;
    std::uint32_t frames_ = 0;
    std::string screenshot_;
};

}  // namespace

std::unique_ptr<Command> make_view_command() { return std::make_unique<ViewCommand>(); }

}  // namespace rimline::tools
