#include <array>
#include <cstdio>
#include <utility>

#include "tools/silhouette_hits.h"

namespace rimline::tools {

namespace {

// What a line says: recall and precision in %, and what is near; then what both come to.
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

void print_silhouettes(const std::vector<ComparedModel>& models) {
    if (models.empty()) return;
    const std::uint32_t common = best_threshold(models);
    std::printf(
        "\nsilhouettes: recall, precision and score in %%, of the very vertices and within a "
        "ring\n%-28s%s  %-37s  %-37s%s   t = %.3f\n",
        "", "", "umbrellas", "normals, the model's best t", "     t", threshold(common));
    std::array<Columns, 3> means;
    const double share = 1.0 / double(models.size());
    for (const ComparedModel& model : models) {
        const std::uint32_t own = best_threshold({model});
        const std::array columns{Columns::of(model.silhouettes->umbrellas),
                                 Columns::of(model.silhouettes->thresholds[own]),
                                 Columns::of(model.silhouettes->thresholds[common])};
        std::printf("%-28s", model.name.c_str());
        columns[0].print();
        columns[1].print();
        std::printf("  %.3f", threshold(own));
        columns[2].print();
        std::printf("\n");
        for (std::size_t i = 0; i < means.size(); ++i) means[i].add(columns[i], share);
    }
    std::printf("%-28s", "mean");
    means[0].print();
    means[1].print();
    std::printf("  %5s", "");
    means[2].print();
    std::printf("\n");
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
