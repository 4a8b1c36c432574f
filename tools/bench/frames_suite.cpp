// rimline bench frames: what a frame's time depends on, on one Vulkan device.

#include <CLI/App.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/tested_device.h"
#include "tools/bench/frames.h"
#include "tools/bench/machine.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

// The columns of passes, by what their names begin with. The first is all of them.
constexpr const char* k_kinds[] = {"",        "silhouettes", "surfaces", "shadow volumes",
                                   "resolve", "lines",       "picture"};

// What a device of the CPU type, or --quick, can do in minutes.
constexpr FramesBenchOptions k_small{
    .width = 512, .height = 384, .frames = 5, .max_faces = 300'000};

void print_head(const Device& device, const FramesBenchOptions& options) {
    print_machine(this_machine());
    std::printf(
        "%s, %s\n%ux%u, medians of %u frames, ms; frame and record by the clock, the "
        "rest by the device's\ntimestamps%s. Last, of limits: sample tests of volumes, millions, "
        "counted on the\nprocessor at one sample a pixel: in the drawn area, the shadows' "
        "rectangles, these and their depths;\nand in the rectangles up to the ends of these "
        "depths\n\n",
        device.facts().name.c_str(), device.facts().driver.c_str(), options.width, options.height,
        options.frames,
        device.facts().type == VK_PHYSICAL_DEVICE_TYPE_CPU
            ? ", which miss the work of threads that still rasterize"
            : "");
    std::printf("%-8s %-28s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "", "",
                "faces", "frame", "record", "passes", "silhouet.", "surfaces", "volumes", "resolve",
                "lines", "picture", "area", "rects", "depths", "ends");
}

void print_row(const FrameRow& row) {
    std::printf("%-8s %-28s %9u", row.group.c_str(), row.name.c_str(), row.faces);
    if (!row.refusal.empty()) {
        std::printf("   not measured: %s\n", row.refusal.c_str());
    } else {
        std::printf(" %9.3f %9.3f", row.frame_ms, row.record_ms);
        for (const char* const kind : k_kinds) std::printf(" %9.3f", row.passes.sum_ms(kind));
        if (row.tests.drawn_area > 0.0)
            for (const double tests :
                 {row.tests.drawn_area, row.tests.rectangle, row.tests.depth, row.tests.ended})
                std::printf(" %9.2f", 1e-6 * tests);
        std::printf("\n");
    }
    std::fflush(stdout);
}

Json to_json(const FrameRow& row) {
    Json object{{"group", row.group}, {"name", row.name}, {"faces", row.faces}};
    if (!row.refusal.empty()) {
        object["refusal"] = row.refusal;
        return object;
    }
    Json passes = Json::array();
    for (const PassTime& pass : row.passes.each())
        passes.push_back({{"name", pass.name}, {"ms", pass.time_ms}});
    object.update({{"frame_ms", row.frame_ms},
                   {"record_ms", row.record_ms},
                   {"passes_ms", row.passes.sum_ms("")},
                   {"passes", std::move(passes)}});
    if (row.tests.drawn_area > 0.0)
        object["sample_tests"] = {{"drawn_area", row.tests.drawn_area},
                                  {"rectangle", row.tests.rectangle},
                                  {"depth", row.tests.depth},
                                  {"ended", row.tests.ended}};
    return object;
}

class FramesSuite final : public Command {
public:
    std::string name() const override { return "frames"; }
    std::string summary() const override { return "What a frame's time depends on"; }

    void add_options(CLI::App& app) override {
        app.add_option("MODEL", model_,
                       "File or built-in shape (default: igea.ply of the folders in "
                       "RIMLINE_MODELS, or shape:knot:270000; with little work, "
                       "shape:knot:70000)")
            ->group("Input");
        app.add_flag("--quick", quick_,
                     "Little work: 512x384, 5 frames, up to 300,000 faces. The default of devices "
                     "of the CPU type")
            ->group("Amount");
        size_option_ =
            add_image_size(app, "--size", size_, "Width and height in pixels")->group("Amount");
        frames_option_ = add_count(app, "--frames", options_.frames, 1, 1'000'000,
                                   "Steps of half a degree on an orbit at 2 radii")
                             ->group("Amount");
        max_option_ = add_count(app, "--most-faces", options_.max_faces, 1, 1u << 28,
                                "The greatest size of the growing knots; 0 of them below 10,000")
                          ->group("Amount");
        app.add_option("--only", only_, "Measure one group of rows")
            ->check(CLI::IsMember({"light", "limits", "scale", "samples", "lines", "growth"}))
            ->group("Amount");
        add_device(app, device_, "gpu, cpu, an index, or a part of a name");
        app.footer(
            "One table: the sun and lamps near and far, limits of shadows, output scales, sample "
            "counts, ways to "
            "draw lines,\n"
            "and growing knots. Columns: a frame by the clock, with reading the picture back; the "
            "processor's\n"
            "part of it; and the device's passes. The pictures of all ways to draw lines are "
            "compared.\n\n"
            "Examples:\n"
            "  rimline bench frames --device gpu\n"
            "  rimline bench frames shape:knot:20000 --quick --json");
    }

    ExitStatus run(const Context& context) override {
        const VulkanInstance instance;
        const TestedDevice device(instance, device_);
        const bool is_small = quick_ || device.facts().type == VK_PHYSICAL_DEVICE_TYPE_CPU;
        const FramesBenchOptions options = options_for(is_small);
        std::string model = model_;
        if (model.empty())
            model = is_small ? "shape:knot:70000"
                             : known_models({"igea.ply"}, {"shape:knot:270000"}).front();
        const Mesh mesh = load_mesh(model, 0, context);
        check_has_extent(model, mesh);
        if (!context.json) {
            print_head(device, options);
            std::printf("%s\n", model.c_str());
        }
        const FramesResult result = bench_frames(
            model, mesh, device, options,
            [&](const FrameRow& row) {
                if (!context.json) print_row(row);
            },
            context);
        if (context.json) {
            Json rows = Json::array();
            for (const FrameRow& row : result.rows) rows.push_back(to_json(row));
            print_json(
                {{"machine", to_json(this_machine())},
                 {"device", {{"name", device.facts().name}, {"driver", device.facts().driver}}},
                 {"model", model},
                 {"width", options.width},
                 {"height", options.height},
                 {"frames", options.frames},
                 {"verified", result.difference.empty()},
                 {"rows", std::move(rows)}});
        }
        return report_check(
            result.difference.empty() ? "" : model + ": " + result.difference + " differs");
    }

private:
    FramesBenchOptions options_for(bool is_small) const {
        FramesBenchOptions options = is_small ? k_small : FramesBenchOptions{};
        if (size_option_->count() > 0) {
            options.width = size_.width;
            options.height = size_.height;
        }
        if (frames_option_->count() > 0) options.frames = options_.frames;
        if (max_option_->count() > 0) options.max_faces = options_.max_faces;
        options.only = only_;
        return options;
    }

    std::string model_, device_;
    std::string only_;
    bool quick_ = false;
    ImageSize size_{FramesBenchOptions{}.width, FramesBenchOptions{}.height};
    FramesBenchOptions options_;
    const CLI::Option *size_option_ = nullptr, *frames_option_ = nullptr, *max_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_frames_suite() { return std::make_unique<FramesSuite>(); }

}  // namespace rimline::tools
