// rimline origins: origins for Hough spaces, given their number or by trying.

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/field/origins.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "tools/absent_part.h"
#include "tools/command.h"
#include "tools/commands/literal_origins.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/up_option.h"
#include "tools/output/canvas.h"
#include "tools/output/group_picture.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_file.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

nlohmann::ordered_json to_json(const OriginTrial& trial) {
    const HoughOctreeStatistics& s = trial.statistics;
    return {{"origins", trial.count},
            {"sfo_edges", s.sfo_edges},
            {"box_checks", trial.mean.box_checks},
            {"edge_checks", trial.mean.edge_checks},
            {"work", trial.work}};
}

// One a set of origins that was tried.
using LiteralTrials = std::vector<std::vector<LiteralTrial>>;

// Microseconds of an extraction for each trial, with its first few `origins`, on one thread. The trials
// alternate; the least time of all rounds counts.
std::vector<double> time_extractions(const Mesh& mesh, std::span<const glm::dvec3> origins,
                                     std::span<const OriginTrial> trials, std::uint32_t viewpoints,
                                     const Context& context) {
    constexpr std::uint32_t k_rounds = 7;
    Progress progress(context, "timing extractions");
    const LongCall call = progress.call();
    std::vector<HoughOctree> octrees;
    for (const OriginTrial& trial : trials) {
        const auto used = origins.first(trial.count);
        octrees.emplace_back(mesh, HoughOctreeOptions{{used.begin(), used.end()}},
                             LongCall{context.stop, {}});
    }
    const std::vector<HomogeneousPoint> points = spread_viewpoints(mesh, viewpoints);
    std::vector<double> min_us(trials.size(), INFINITY);
    std::vector<EdgeId> edges;
    for (std::uint32_t round = 0; round < k_rounds; ++round)
        for (std::size_t i = 0; i < octrees.size(); ++i) {
            call.checkpoint(double(round) / k_rounds);
            BlockScratch scratch = octrees[i].make_scratch();
            TraversalCounters counters;
            const Stopwatch watch;
            for (const HomogeneousPoint& point : points)
                octrees[i].extract(point, edges, counters, scratch);
            const double took_us = watch.us();
            min_us[i] = std::min(min_us[i], took_us / viewpoints);
        }
    return min_us;
}

class OriginsCommand final : public Command {
public:
    std::string name() const override { return "origins"; }
    std::string summary() const override { return "Choose origins for Hough spaces"; }

    void add_options(CLI::App& app) override {
        app_ = &app;
        model_.add_to(app);
        count_option_ = add_count(app, "-k,--count", count_, 1, 64,
                                  "How many (default: as many as take the least work)");
        count_option_->default_str("");
        max_option_ = add_count(app, "--most", max_, 1, 64, "Try up to so many without -k");
        add_number(app, "--alpha", alpha_, 0.01, 6.0,
                   "Where the voting function ends, in radii of the model");
        add_count(app, "--viewpoints", viewpoints_, 1, 1'000'000,
                  "Extractions to count the work of, at 1, 2 and 3 radii");
        app.add_flag(
            "--literal", literal_,
            "Count also what the thesis's octrees cost, by both cullings and lists of edges");
        app.add_flag("--time", time_, "Measure by the clock too what an extraction takes")
            ->excludes(count_option_);
        add_output(app, "-o,--output", output_, ".png", "A picture of the groups of faces");
        add_direction(app, "--direction", direction_,
                      "Of the picture: from the model towards the viewer");
        add_up(app, up_, is_up_auto_,
               "Of the picture: X,Y,Z, one of x, y, z, -x, -y, -z, or auto: along which the model "
               "stands (default: as the file format says, else auto)");
        app.footer(
            "An origin is good for an index when few edges are on the silhouette from there (SFO)\n"
            "and its distances from the planes spread. Each face belongs to one origin. "
            "box_checks\n"
            "and work are of one extraction, on average. Without -k the center alone is among "
            "what\n"
            "is tried, and often wins: see docs/results/field.md.\n\n"
            "Examples:\n"
            "  rimline origins horse.ply -k 3 --up 0,0,1 -o groups.png\n"
            "  rimline origins igea.ply --json");
    }

    ExitStatus run(const Context& context) override {
        check_output(context, output_);
        if (count_option_->count() > 0 && max_option_->count() > 0)
            throw UsageError("origins: --count and --most exclude each other");
        if (literal_) require_methods("origins --literal");
        if (output_.empty())
            refuse_options(*app_, {"--direction", "--up"}, "there is no picture; give -o FILE.png");
        std::optional<OutputFile> file;
        if (!output_.empty()) file.emplace(output_, model_.model);
        const Mesh mesh = model_.load_mesh(context);
        check_has_planes(model_.model, mesh);
        return about_model(model_.model, [&] { return run(mesh, file, context); });
    }

private:
    ExitStatus run(const Mesh& mesh, std::optional<OutputFile>& file, const Context& context) {
        OriginOptions options;
        options.alpha = alpha_;
        const Stopwatch watch;
        ChosenOrigins chosen;
        std::vector<glm::dvec3> tried;
        double search_ms = 0.0;
        {
            Progress progress(context, "choosing origins of " + model_.model);
            const LongCall call = progress.call();
            if (count_option_->count() > 0) {
                chosen.found = find_origins(mesh, count_, options, call);
                search_ms = watch.ms();
            } else {
                chosen = choose_origins(mesh, max_, viewpoints_, options, call);
                search_ms = watch.ms();
                tried = chosen.found.origins;
                chosen.found.origins.resize(chosen.best);
                chosen.found.votes.resize(chosen.best);
            }
        }
        const OriginTrial trial =
            chosen.trials.empty()
                ? try_origins(mesh, chosen.found.origins, viewpoints_, {context.stop, {}})
                : chosen.trials[chosen.best];
        context.times.end("choosing origins");
        if (file) {
            const HoughOctree octree(mesh, {chosen.found.origins});
            const glm::dvec3 up = settle_up(mesh, up_, is_up_auto_, context.stop).up;
            const bool is_z_up = std::abs(up.z) > std::abs(up.y);
            const glm::dvec3 towards =
                direction_ ? glm::dvec3(*direction_)
                           : (is_z_up ? glm::dvec3(0.9, -0.7, 0.4) : glm::dvec3(0.9, 0.4, 0.7));
            write_picture(*file, draw_groups(octree, towards, up, 700));
            context.times.end("drawing");
        }
        // One a trial, or of the requested origins.
        const LiteralTrials literal = count_literal(mesh, chosen, tried, context);
        if (literal_) context.times.end("counting the thesis's boxes");
        std::vector<double> times_us;
        if (time_) {
            times_us = time_extractions(mesh, tried, chosen.trials, viewpoints_, context);
            context.times.end("timing extractions");
        }
        report(mesh, chosen, trial, literal, times_us, search_ms, context);
        return ExitStatus::success;
    }

    LiteralTrials count_literal(const Mesh& mesh, const ChosenOrigins& chosen,
                                std::span<const glm::dvec3> tried, const Context& context) const {
        LiteralTrials literal;
        if (!literal_) return literal;
        Progress progress(context, "counting the thesis's boxes");
        const LongCall call = progress.call();
        if (chosen.trials.empty())
            literal.push_back(count_literal_work(mesh, chosen.found.origins, viewpoints_, call));
        for (const OriginTrial& trial : chosen.trials) {
            const double share = 1.0 / static_cast<double>(chosen.trials.size());
            const double begin = share * static_cast<double>(literal.size());
            literal.push_back(count_literal_work(mesh, tried.first(trial.count), viewpoints_,
                                                 call.part(begin, begin + share)));
        }
        return literal;
    }

    static std::string share_text(double votes) {
        std::array<char, 40> text{};
        std::snprintf(text.data(), text.size(), "%.1f%% of the votes", 100.0 * votes);
        return text.data();
    }

    void report(const Mesh& mesh, const ChosenOrigins& chosen, const OriginTrial& trial,
                const LiteralTrials& literal, std::span<const double> times_us, double search_ms,
                const Context& context) const {
        std::vector<glm::dvec3> origins = chosen.found.origins;
        std::vector<std::optional<double>> votes(chosen.found.votes.begin(),
                                                 chosen.found.votes.end());
        // None was better than the center, which nothing votes for.
        if (origins.empty()) {
            origins.push_back(mesh.center());
            votes.emplace_back();
        }
        if (!context.json) {
            std::printf("%s: %zu origin%s in %.0f ms\n", model_.model.c_str(), origins.size(),
                        origins.size() == 1 ? "" : "s", search_ms);
            for (std::size_t i = 0; i < origins.size(); ++i)
                std::printf("  %.9g,%.9g,%.9g  %u face%s, %s\n", origins[i].x, origins[i].y,
                            origins[i].z, trial.statistics.group_faces[i],
                            trial.statistics.group_faces[i] == 1 ? "" : "s",
                            votes[i] ? share_text(*votes[i]).c_str() : "the center");
            if (count_option_->count() > 0 && origins.size() < count_)
                std::printf("  no plane has votes left for more\n");
            std::printf("  %u SFO edges; %llu boxes, %llu edges an extraction\n",
                        trial.statistics.sfo_edges,
                        static_cast<unsigned long long>(trial.mean.box_checks),
                        static_cast<unsigned long long>(trial.mean.edge_checks));
            if (literal_)
                for (const LiteralTrial& t : literal[chosen.best])
                    std::printf(
                        "  thesis's octrees, %s, %s: %u edges listed; %llu PBVs, %llu EBVs, %llu "
                        "edges; %.1f missed, %.1f twice\n",
                        t.culling, t.listing, t.listed_edges,
                        static_cast<unsigned long long>(t.pbv_checks),
                        static_cast<unsigned long long>(t.ebv_checks),
                        static_cast<unsigned long long>(t.edge_checks), t.missed_edges,
                        t.repeated_edges);
            for (std::size_t i = 0; i < chosen.trials.size(); ++i) {
                const OriginTrial& t = chosen.trials[i];
                std::printf("  tried %u: %u SFO edges, %llu boxes, work %.0f", t.count,
                            t.statistics.sfo_edges,
                            static_cast<unsigned long long>(t.mean.box_checks), t.work);
                if (time_) std::printf(", %.1f us", times_us[i]);
                std::printf("%s\n", i == chosen.best ? "  least" : "");
            }
            return;
        }
        nlohmann::ordered_json list_of_origins = nlohmann::ordered_json::array();
        nlohmann::ordered_json list_of_votes = nlohmann::ordered_json::array();
        for (const std::optional<double>& v : votes)
            list_of_votes.push_back(v ? nlohmann::ordered_json(*v) : nlohmann::ordered_json());
        for (const glm::dvec3& origin : origins) list_of_origins.push_back(json_vector(origin));
        nlohmann::ordered_json object{{"model", model_.model},
                                      {"alpha", alpha_},
                                      {"origins", std::move(list_of_origins)},
                                      {"votes", std::move(list_of_votes)},
                                      {"sfo_edges", trial.statistics.sfo_edges},
                                      {"groups", trial.statistics.group_faces},
                                      {"box_checks", trial.mean.box_checks},
                                      {"edge_checks", trial.mean.edge_checks},
                                      {"work", trial.work},
                                      {"ms", search_ms}};
        if (literal_) object["literal"] = to_json(literal[chosen.best]);
        if (!chosen.trials.empty()) {
            nlohmann::ordered_json trials = nlohmann::ordered_json::array();
            for (const OriginTrial& t : chosen.trials) {
                trials.push_back(to_json(t));
                if (time_) trials.back()["us"] = times_us[trials.size() - 1];
                if (literal_) trials.back()["literal"] = to_json(literal[trials.size() - 1]);
            }
            object["trials"] = std::move(trials);
        }
        if (!output_.empty()) object["output"] = output_;
        print_json(context, std::move(object));
    }

    const CLI::App* app_ = nullptr;
    ModelArgument model_;
    std::uint32_t count_ = 3;
    std::uint32_t max_ = 5;
    double alpha_ = OriginOptions{}.alpha;
    std::uint32_t viewpoints_ = 600;
    bool literal_ = false;
    bool time_ = false;
    std::string output_;
    std::optional<glm::vec3> direction_;
    std::optional<glm::vec3> up_;
    bool is_up_auto_ = false;
    CLI::Option *count_option_ = nullptr, *max_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_origins_command() { return std::make_unique<OriginsCommand>(); }

}  // namespace rimline::tools
