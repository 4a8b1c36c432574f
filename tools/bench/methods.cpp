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

struct BuiltMethod {
    const SilhouetteMethodInfo* info;
    std::unique_ptr<SilhouetteMethod> method;
};

// The points of one table and the kind of call.
struct MethodCase {
    std::string name;
    bool is_update;
    bool is_of_directions;
    std::vector<HomogeneousPoint> points;

    bool includes(const SilhouetteMethodInfo& info) const {
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
            call.checkpoint(static_cast<double>(methods_.size()) /
                            static_cast<double>(silhouette_methods().size()));
            const Clock::time_point start = Clock::now();
            methods_.push_back({&info, make_silhouette_method(info.name, mesh)});
            const std::chrono::duration<double, std::milli> took = Clock::now() - start;
            result.builds.push_back({std::string(info.name), took.count()});
        }
    }

    // Returns false when a result is wrong.
    bool measure(const MethodCase& method_case) {
        MethodTable table{method_case.name, {}, {}};
        std::vector<Contender> contenders;
        for (const BuiltMethod& built : methods_) {
            if (!method_case.includes(*built.info)) continue;
            table.recalls.push_back(recall_of(built, method_case));
            if (!result_.difference.empty()) return false;
            contenders.push_back(contender_of(built, method_case));
        }
        table.methods =
            time_in_turn(contenders, method_case.points, rounds_,
                         "measuring " + method_case.name + " of " + result_.model, context_);
        result_.tables.push_back(std::move(table));
        return true;
    }

private:
    // The recall over all points. Sets the difference in the result where an edge is wrong.
    double recall_of(const BuiltMethod& built, const MethodCase& method_case) {
        Progress progress(context_, "checking " + std::string(built.info->name));
        const LongCall call = progress.call();
        std::size_t found = 0;
        std::size_t expected = 0;
        for (std::size_t i = 0; i < method_case.points.size(); ++i) {
            call.checkpoint(static_cast<double>(i) /
                            static_cast<double>(method_case.points.size()));
            packed_.face_bits(method_case.points[i], words_);
            packed_.silhouette(words_, truth_);
            run(*built.method, method_case, method_case.points[i]);
            std::sort(edges_.begin(), edges_.end());
            const bool is_right =
                built.info->exact ? edges_ == truth_ : std::ranges::includes(truth_, edges_);
            if (!is_right) {
                result_.difference = method_case.name + ", " + result_.model + ": " +
                                     std::string(built.info->name) + ", point " + std::to_string(i);
                return 0.0;
            }
            found += edges_.size();
            expected += truth_.size();
        }
        return expected == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(expected);
    }

    Contender contender_of(const BuiltMethod& built, const MethodCase& method_case) {
        SilhouetteMethod& method = *built.method;
        Contender contender{
            .name = std::string(built.info->name),
            .step = [this, &method, &method_case](
                        const HomogeneousPoint& point) { run(method, method_case, point); },
            .counters = [this] { return work_; },
            .own_counts = [&method] { return method.own_counts(); }};
        if (method_case.is_update)
            contender.prepare = [this, &method, &method_case] {
                run(method, method_case, method_case.points.front());
            };
        return contender;
    }

    void run(SilhouetteMethod& method, const MethodCase& method_case,
             const HomogeneousPoint& point) {
        work_ = {};
        if (method_case.is_update)
            method.update(point, edges_, work_);
        else
            method.extract(point, edges_, work_);
    }

    MethodsResult& result_;
    PackedBruteForce packed_;
    std::uint32_t rounds_;
    const Context& context_;
    std::vector<BuiltMethod> methods_;
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
    for (const MethodCase& method_case :
         {MethodCase{"extraction, viewpoints", false, false, spread_viewpoints(mesh, viewpoints)},
          MethodCase{"extraction, directions", false, true, spread_directions(viewpoints)},
          MethodCase{"update, viewpoints", true, false, half_degree_orbit(mesh, frames)},
          MethodCase{"update, directions", true, true, half_degree_turn(mesh, frames)}})
        if (!bench.measure(method_case)) break;
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
