#include "tools/bench/methods.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/methods/brute_force_packed.h"
#include "silhouette/methods/method_registry.h"
#include "tools/bench/hough.h"
#include "tools/bench/hough_report.h"
#include "tools/bench/viewpoints.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

struct Made {
    const SilhouetteMethodInfo* info;
    std::unique_ptr<SilhouetteMethod> method;
};

// What one table asks, and of whom.
struct Question {
    std::string name;
    bool is_update;
    bool is_of_directions;
    std::vector<HomogeneousPoint> points;

    bool is_for(const SilhouetteMethodInfo& info) const {
        return (info.has_update || !is_update) && (is_of_directions || !info.directions_only);
    }
};

class MethodsBench {
public:
    MethodsBench(MethodsResult& result, const Mesh& mesh, std::uint32_t rounds,
                 const Context& context)
        : result_(result), packed_(mesh), rounds_(rounds), context_(context) {
        Progress progress(context, "making every method for " + result.model);
        const LongCall call = progress.call();
        for (const SilhouetteMethodInfo& info : silhouette_methods()) {
            call.checkpoint(static_cast<double>(made_.size()) /
                            static_cast<double>(silhouette_methods().size()));
            const Clock::time_point start = Clock::now();
            made_.push_back({&info, make_silhouette_method(info.name, mesh)});
            const std::chrono::duration<double, std::milli> took = Clock::now() - start;
            result.builds.push_back({std::string(info.name), took.count()});
        }
    }

    // False when a result is wrong.
    bool ask(const Question& question) {
        MethodTable table{question.name, {}, {}};
        std::vector<Contender> contenders;
        for (const Made& made : made_) {
            if (!question.is_for(*made.info)) continue;
            table.recalls.push_back(recall_of(made, question));
            if (!result_.difference.empty()) return false;
            contenders.push_back(contender_of(made, question));
        }
        table.methods =
            time_in_turn(contenders, question.points, rounds_,
                         "measuring " + question.name + " of " + result_.model, context_);
        result_.tables.push_back(std::move(table));
        return true;
    }

private:
    // Over all points; says in the result what is wrong where something is.
    double recall_of(const Made& made, const Question& question) {
        Progress progress(context_, "checking " + std::string(made.info->name));
        const LongCall call = progress.call();
        std::size_t found = 0;
        std::size_t expected = 0;
        for (std::size_t i = 0; i < question.points.size(); ++i) {
            call.checkpoint(static_cast<double>(i) / static_cast<double>(question.points.size()));
            packed_.face_bits(question.points[i], words_);
            packed_.silhouette(words_, truth_);
            answer(*made.method, question, question.points[i]);
            std::sort(edges_.begin(), edges_.end());
            const bool is_right =
                made.info->exact ? edges_ == truth_ : std::ranges::includes(truth_, edges_);
            if (!is_right) {
                result_.difference = question.name + ", " + result_.model + ": " +
                                     std::string(made.info->name) + ", point " + std::to_string(i);
                return 0.0;
            }
            found += edges_.size();
            expected += truth_.size();
        }
        return expected == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(expected);
    }

    Contender contender_of(const Made& made, const Question& question) {
        SilhouetteMethod& method = *made.method;
        Contender contender{
            .name = std::string(made.info->name),
            .step = [this, &method,
                     &question](const HomogeneousPoint& point) { answer(method, question, point); },
            .counters = [this] { return work_; },
            .own_counts = [&method] { return method.own_counts(); }};
        if (question.is_update)
            contender.prepare = [this, &method, &question] {
                answer(method, question, question.points.front());
            };
        return contender;
    }

    void answer(SilhouetteMethod& method, const Question& question, const HomogeneousPoint& point) {
        work_ = {};
        if (question.is_update)
            method.update(point, edges_, work_);
        else
            method.extract(point, edges_, work_);
    }

    MethodsResult& result_;
    PackedBruteForce packed_;
    std::uint32_t rounds_;
    const Context& context_;
    std::vector<Made> made_;
    std::vector<EdgeId> edges_, truth_;
    std::vector<std::uint32_t> words_;
    TraversalCounters work_;
};

}  // namespace

MethodsResult bench_methods(const std::string& model, const Mesh& mesh,
                            const MethodsOptions& options, const Context& context) {
    MethodsResult result;
    result.model = model;
    result.faces = mesh.face_count();
    const std::uint32_t viewpoints = point_count(options.viewpoints, mesh.face_count());
    const std::uint32_t frames = point_count(options.frames, mesh.face_count());
    MethodsBench bench(result, mesh, options.rounds, context);
    for (const Question& question :
         {Question{"extraction, viewpoints", false, false, spread_viewpoints(mesh, viewpoints)},
          Question{"extraction, directions", false, true, spread_directions(viewpoints)},
          Question{"update, viewpoints", true, false, half_degree_orbit(mesh, frames)},
          Question{"update, directions", true, true, half_degree_turn(mesh, frames)}})
        if (!bench.ask(question)) break;
    return result;
}

void print_result(const MethodsResult& result) {
    std::printf("%s: %u faces; made in ms:", result.model.c_str(), result.faces);
    for (const MethodsResult::Build& build : result.builds)
        std::printf(" %s %.1f", build.method.c_str(), build.ms);
    std::printf("\n");
    for (const MethodTable& table : result.tables) {
        std::printf("%s\n", table.name.c_str());
        print_row_names();
        for (const Times& times : table.methods) print_row(times, table.methods.front());
        for (std::size_t m = 0; m < table.methods.size(); ++m) {
            const Times& times = table.methods[m];
            if (times.own_counts.empty() && table.recalls[m] == 1.0) continue;
            std::printf("  %s:", times.name.c_str());
            if (table.recalls[m] < 1.0) std::printf(" finds %.2f%%;", 100.0 * table.recalls[m]);
            for (const Times::OwnCount& count : times.own_counts)
                std::printf(" %s %.1f", count.name.c_str(), count.mean);
            std::printf("\n");
        }
    }
    if (!result.difference.empty())
        std::printf("  not measured: it differs from brute force: %s\n", result.difference.c_str());
    std::printf("\n");
}

nlohmann::ordered_json to_json(const MethodsResult& result) {
    nlohmann::ordered_json builds;
    for (const MethodsResult::Build& build : result.builds) builds[build.method] = build.ms;
    nlohmann::ordered_json tables = nlohmann::ordered_json::array();
    for (const MethodTable& table : result.tables) {
        nlohmann::ordered_json methods = nlohmann::ordered_json::array();
        for (std::size_t m = 0; m < table.methods.size(); ++m) {
            methods.push_back(to_json(table.methods[m], table.methods.front()));
            methods.back()["recall"] = table.recalls[m];
        }
        tables.push_back({{"table", table.name}, {"methods", std::move(methods)}});
    }
    return {{"model", result.model},
            {"faces", result.faces},
            {"verified", result.difference.empty()},
            {"build_ms", std::move(builds)},
            {"tables", std::move(tables)}};
}

}  // namespace rimline::tools
