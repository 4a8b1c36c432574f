#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "tools/bench/silhouette_hits.h"

namespace rimline::tools {

namespace {

// One line: recall and precision in %, the same of near points, and the score.
struct Columns {
    double recall = 0.0, precision = 0.0, near_recall = 0.0, near_precision = 0.0;
    double score = 0.0, near_score = 0.0;

    static Columns of(const SilhouetteHits& hits) {
        return {hits.recall(),         hits.precision(), hits.near_recall(),
                hits.near_precision(), hits.score(),     hits.near_score()};
    }
    void add(const Columns& other, double share) {
        recall += share * other.recall;
        precision += share * other.precision;
        near_recall += share * other.near_recall;
        near_precision += share * other.near_precision;
        score += share * other.score;
        near_score += share * other.near_score;
    }
    void print() const {
        std::printf("  %5.1f %5.1f %5.1f  %5.1f %5.1f %5.1f", 100.0 * recall, 100.0 * precision,
                    100.0 * score, 100.0 * near_recall, 100.0 * near_precision, 100.0 * near_score);
    }
};

}  // namespace

namespace {

// The hits of umbrellas, of the model's best threshold, and of the common threshold.
using Line = std::array<Columns, 3>;

void print_line(const std::string& name, const Line& line, const std::string& own_threshold) {
    std::printf("%-28s", name.c_str());
    line[0].print();
    line[1].print();
    std::printf("  %5s", own_threshold.c_str());
    line[2].print();
    std::printf("\n");
}

// The mean over the lines of a kind, or of all for "".
void print_mean(const std::vector<ComparedModel>& models, const std::vector<Line>& lines,
                const std::string& kind) {
    std::size_t count = 0;
    for (const ComparedModel& model : models) count += kind.empty() || model.kind == kind;
    if (count == 0) return;
    Line mean{};
    for (std::size_t m = 0; m < models.size(); ++m)
        for (std::size_t i = 0; i < mean.size(); ++i)
            if (kind.empty() || models[m].kind == kind)
                mean[i].add(lines[m][i], 1.0 / double(count));
    print_line("mean of " + (kind.empty() ? "all" : kind) + ", " + std::to_string(count), mean, "");
}

}  // namespace

void print_silhouettes(const std::vector<ComparedModel>& models) {
    if (models.empty()) return;
    const std::uint32_t common = best_threshold(models);
    std::printf(
        "\nsilhouettes: recall, precision and score in %%, of the very vertices and within a "
        "ring\n%-28s  %-37s  %-37s  %5s  t = %.3f\n",
        "", "umbrellas", "normals, at the model's best t", "t", threshold(common));
    std::vector<Line> lines;
    std::vector<std::string> kinds;
    for (const ComparedModel& model : models) {
        const std::uint32_t own = best_threshold({model});
        lines.push_back({Columns::of(model.silhouettes->umbrellas),
                         Columns::of(model.silhouettes->thresholds[own]),
                         Columns::of(model.silhouettes->thresholds[common])});
        char text[16];
        std::snprintf(text, sizeof text, "%.3f", threshold(own));
        print_line(model.name, lines.back(), text);
        if (std::ranges::find(kinds, model.kind) == kinds.end()) kinds.push_back(model.kind);
    }
    for (const std::string& kind : kinds) print_mean(models, lines, kind);
    print_mean(models, lines, "");
}

nlohmann::ordered_json to_json(const SilhouetteComparison& silhouettes) {
    const auto object = [](const SilhouetteHits& hits) -> nlohmann::ordered_json {
        return {{"true", hits.truth},
                {"found", hits.found},
                {"hits", hits.hits},
                {"near_found", hits.near_found},
                {"near_true", hits.near_truth}};
    };
    nlohmann::ordered_json thresholds = nlohmann::ordered_json::array();
    for (std::uint32_t t = 0; t < silhouettes.thresholds.size(); ++t) {
        thresholds.push_back(object(silhouettes.thresholds[t]));
        thresholds.back()["t"] = threshold(t);
    }
    return {{"umbrellas", object(silhouettes.umbrellas)}, {"thresholds", std::move(thresholds)}};
}

}  // namespace rimline::tools
