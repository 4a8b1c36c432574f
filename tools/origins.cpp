// rimline origins: origins for Hough spaces, given their number or by trying.

#include <array>
#include <chrono>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/field/origins.h"
#include "tools/canvas.h"
#include "tools/command.h"
#include "tools/group_picture.h"
#include "tools/model_argument.h"
#include "tools/option_types.h"
#include "tools/output_file.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

std::array<double, 3> list(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json to_json(const OriginTrial& trial) {
    const HoughOctreeStatistics& s = trial.statistics;
    return {{"origins", trial.count},
            {"sfo_edges", s.sfo_edges},
            {"box_checks", trial.mean.box_checks},
            {"edge_checks", trial.mean.edge_checks},
            {"work", trial.work}};
}

class OriginsCommand final : public Command {
public:
    std::string name() const override { return "origins"; }
    std::string summary() const override { return "Choose origins for Hough spaces"; }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        count_option_ = add_count(app, "-k,--count", count_, 1, 64,
                                  "How many (default: as many as take the least work)");
        count_option_->default_str("");
        most_option_ = add_count(app, "--most", most_, 1, 64, "Try up to so many without -k");
        add_number(app, "--alpha", alpha_, 0.01, 6.0,
                   "Where the voting function ends, in radii of the model");
        add_count(app, "--viewpoints", viewpoints_, 1, 1'000'000,
                  "Extractions to count the work of, at 1, 2 and 3 radii");
        app.add_option("-o,--output", output_, "A picture of the groups of faces")
            ->type_name("FILE.png");
        add_direction(app, "--direction", direction_,
                      "Of the picture: from the model towards the viewer");
        add_direction(app, "--up", up_, "Of the picture (default: the file format's)");
        app.footer(
            "An origin is good for an index when few edges are on the silhouette from there (SFO)\n"
            "and its distances from the planes spread. Each face belongs to one origin. "
            "box_checks\n"
            "and work are of one extraction, on average. Without -k the center alone is among "
            "what\n"
            "is tried, and often wins: see docs/field.md.\n\n"
            "Examples:\n"
            "  rimline origins horse.ply -k 3 -o groups.png\n"
            "  rimline origins igea.ply --json");
    }

    ExitStatus run(const Context& context) override {
        if (count_option_->count() > 0 && most_option_->count() > 0)
            throw UsageError("origins: --count and --most exclude each other");
        std::optional<OutputFile> file;
        if (!output_.empty()) file.emplace(output_);
        const Mesh mesh = model_.load_mesh(context);
        return about_model(model_.model, [&] { return run(mesh, file, context); });
    }

private:
    ExitStatus run(const Mesh& mesh, std::optional<OutputFile>& file, const Context& context) {
        OriginOptions options;
        options.alpha = alpha_;
        const auto start = Clock::now();
        ChosenOrigins chosen;
        double search_ms = 0.0;
        {
            Progress progress(context, "choosing origins of " + model_.model);
            const LongCall call = progress.call();
            if (count_option_->count() > 0) {
                chosen.found = find_origins(mesh, count_, options, call);
                search_ms = milliseconds_since(start);
            } else {
                chosen = choose_origins(mesh, most_, viewpoints_, options, call);
                search_ms = milliseconds_since(start);
                chosen.found.origins.resize(chosen.best);
                chosen.found.votes.resize(chosen.best);
            }
        }
        const OriginTrial trial =
            chosen.trials.empty()
                ? try_origins(mesh, chosen.found.origins, viewpoints_, {context.stop, {}})
                : chosen.trials[chosen.best];
        if (file) {
            const HoughOctree octree(mesh, {chosen.found.origins});
            const bool is_z_up = mesh.up() == UpAxis::z;
            const glm::dvec3 up =
                up_ ? glm::dvec3(*up_) : (is_z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
            const glm::dvec3 towards =
                direction_ ? glm::dvec3(*direction_)
                           : (is_z_up ? glm::dvec3(0.9, -0.7, 0.4) : glm::dvec3(0.9, 0.4, 0.7));
            write_picture(*file, draw_groups(octree, towards, up, 700));
        }
        report(mesh, chosen, trial, search_ms, context);
        return ExitStatus::success;
    }

    static double milliseconds_since(Clock::time_point start) {
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }

    void report(const Mesh& mesh, const ChosenOrigins& chosen, const OriginTrial& trial,
                double search_ms, const Context& context) const {
        std::vector<glm::dvec3> origins = chosen.found.origins;
        std::vector<double> votes = chosen.found.votes;
        if (origins.empty()) {
            origins.push_back(mesh.center());
            votes.push_back(0.0);
        }
        if (!context.json) {
            std::printf("%s: %zu origins in %.0f ms\n", model_.model.c_str(), origins.size(),
                        search_ms);
            for (std::size_t i = 0; i < origins.size(); ++i)
                std::printf("  %.9g,%.9g,%.9g  %u faces, %.1f%% of the votes\n", origins[i].x,
                            origins[i].y, origins[i].z, trial.statistics.group_faces[i],
                            100.0 * votes[i]);
            if (count_option_->count() > 0 && origins.size() < count_)
                std::printf("  no plane has votes left for more\n");
            std::printf("  %u SFO edges; %llu boxes, %llu edges an extraction\n",
                        trial.statistics.sfo_edges,
                        static_cast<unsigned long long>(trial.mean.box_checks),
                        static_cast<unsigned long long>(trial.mean.edge_checks));
            for (const OriginTrial& t : chosen.trials)
                std::printf("  tried %u: %u SFO edges, %llu boxes, work %.0f%s\n", t.count,
                            t.statistics.sfo_edges,
                            static_cast<unsigned long long>(t.mean.box_checks), t.work,
                            &t == &chosen.trials[chosen.best] ? "  least" : "");
            return;
        }
        nlohmann::ordered_json list_of_origins = nlohmann::ordered_json::array();
        for (const glm::dvec3& origin : origins) list_of_origins.push_back(list(origin));
        nlohmann::ordered_json object{{"model", model_.model},
                                      {"alpha", alpha_},
                                      {"origins", std::move(list_of_origins)},
                                      {"votes", votes},
                                      {"sfo_edges", trial.statistics.sfo_edges},
                                      {"groups", trial.statistics.group_faces},
                                      {"box_checks", trial.mean.box_checks},
                                      {"edge_checks", trial.mean.edge_checks},
                                      {"work", trial.work},
                                      {"ms", search_ms}};
        if (!chosen.trials.empty()) {
            nlohmann::ordered_json trials = nlohmann::ordered_json::array();
            for (const OriginTrial& t : chosen.trials) trials.push_back(to_json(t));
            object["trials"] = std::move(trials);
        }
        if (!output_.empty()) object["output"] = output_;
        print_json(object);
    }

    ModelArgument model_;
    std::uint32_t count_ = 3;
    std::uint32_t most_ = 5;
    double alpha_ = 1.72;
    std::uint32_t viewpoints_ = 600;
    std::string output_;
    std::optional<glm::vec3> direction_;
    std::optional<glm::vec3> up_;
    CLI::Option *count_option_ = nullptr, *most_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_origins_command() { return std::make_unique<OriginsCommand>(); }

}  // namespace rimline::tools
