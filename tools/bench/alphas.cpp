#include "tools/bench/alphas.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/absent_part.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

AlphaRow alpha_row(const Mesh& mesh, double alpha, std::span<const glm::dvec3> origins,
                   std::uint32_t viewpoints, const Context& context) {
    const LongCall silent{context.stop, {}};
    return {alpha, try_origins(mesh, {origins.begin(), origins.end()}, viewpoints, silent),
            count_literal_work(mesh, origins, viewpoints, silent)};
}

Json row_json(const AlphaRow& row) {
    Json json{{"alpha", nullptr},
              {"origins", row.trial.count},
              {"sfo_edges", row.trial.statistics.sfo_edges},
              {"box_checks", row.trial.mean.box_checks},
              {"edge_checks", row.trial.mean.edge_checks},
              {"work", row.trial.work},
              {"literal", to_json(row.literal)}};
    if (row.alpha > 0.0) json["alpha"] = row.alpha;
    return json;
}

void print_alpha_row(const AlphaRow& row) {
    if (row.alpha > 0.0)
        std::printf("  %7u %6.2f", row.trial.count, row.alpha);
    else
        std::printf("  %7s %6s", "center", "");
    for (const LiteralTrial& trial : row.literal)
        std::printf(" %8u %7llu %7llu %8llu", trial.listed_edges,
                    static_cast<unsigned long long>(trial.pbv_checks),
                    static_cast<unsigned long long>(trial.ebv_checks),
                    static_cast<unsigned long long>(trial.box_checks()));
    std::printf(" %8.1f %8u %8llu %9.0f\n", row.literal[1].missed_edges,
                row.trial.statistics.sfo_edges,
                static_cast<unsigned long long>(row.trial.mean.box_checks), row.trial.work);
}

}  // namespace

AlphaResult bench_alphas(const std::string& model, const Mesh& mesh, const AlphaOptions& options,
                         const Context& context) {
    require_methods("bench fields --alphas");
    AlphaResult result;
    result.model = model;
    result.faces = mesh.face_count();
    Progress progress(context, "counting boxes of " + model);
    const LongCall call = progress.call();
    call.checkpoint(0.0);
    const auto compare = [&](const AlphaRow& row) {
        if (result.difference.empty()) result.difference = difference_of(row.literal);
    };
    result.center = alpha_row(mesh, 0.0, {}, options.viewpoints, context);
    compare(result.center);
    std::vector<std::vector<AlphaRow>> by_count(options.max_origins);
    double done = 0.0;
    for (const double alpha : k_alphas) {
        OriginOptions origin_options;
        origin_options.alpha = alpha;
        const OriginSet found =
            find_origins(mesh, options.max_origins, origin_options, {context.stop, {}});
        for (std::size_t k = 1; k <= found.origins.size(); ++k) {
            call.checkpoint((done + double(k - 1) / options.max_origins) / k_alphas.size());
            by_count[k - 1].push_back(alpha_row(mesh, alpha, std::span(found.origins).first(k),
                                                options.viewpoints, context));
            compare(by_count[k - 1].back());
        }
        done += 1.0;
    }
    for (std::vector<AlphaRow>& rows : by_count)
        result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    return result;
}

std::vector<AlphaMean> means_of(const std::vector<AlphaResult>& results) {
    std::vector<AlphaMean> means;
    for (const AlphaResult& result : results)
        for (const AlphaRow& row : result.rows) {
            if (result.center.literal[0].box_checks() == 0 ||
                result.center.trial.mean.box_checks == 0)
                continue;
            auto mean = means.begin();
            while (mean != means.end() &&
                   (mean->alpha != row.alpha || mean->origins != row.trial.count))
                ++mean;
            if (mean == means.end())
                mean = means.insert(means.end(), AlphaMean{row.alpha, row.trial.count});
            ++mean->models;
            const auto add = [](double& product, double value, double center) {
                product *= value / center;
            };
            const AlphaRow& center = result.center;
            add(mean->literal_boxes, double(row.literal[0].box_checks()),
                double(center.literal[0].box_checks()));
            add(mean->letter_boxes, double(row.literal[1].box_checks()),
                double(center.literal[1].box_checks()));
            add(mean->work, row.trial.work, center.trial.work);
            add(mean->index_boxes, double(row.trial.mean.box_checks),
                double(center.trial.mean.box_checks));
        }
    for (AlphaMean& mean : means)
        for (double* product :
             {&mean.literal_boxes, &mean.letter_boxes, &mean.work, &mean.index_boxes})
            *product = std::pow(*product, 1.0 / mean.models);
    return means;
}

void print_result(const AlphaResult& result) {
    std::printf("%s: %u faces\n", result.model.c_str(), result.faces);
    std::printf("  %7s %6s %33s %33s %33s %8s %26s\n", "", "", "PBV and EBV, SFO from any listed",
                "SFO from all listed", "straddling", "", "HoughOctree");
    std::printf("  %7s %6s", "origins", "alpha");
    for (int i = 0; i < 3; ++i) std::printf(" %8s %7s %7s %8s", "listed", "PBV", "EBV", "boxes");
    std::printf(" %8s %8s %8s %9s\n", "missed", "SFO", "boxes", "work");
    print_alpha_row(result.center);
    for (const AlphaRow& row : result.rows) print_alpha_row(row);
    std::printf("\n");
}

void print_means(const std::vector<AlphaMean>& means) {
    std::printf("over the center, geometric means of the models\n");
    std::printf("  %7s %6s %7s %14s %14s %14s %14s\n", "origins", "alpha", "models", "PBV and EBV",
                "SFO from all", "index boxes", "index work");
    for (const AlphaMean& mean : means)
        std::printf("  %7u %6.2f %7u %14.3f %14.3f %14.3f %14.3f\n", mean.origins, mean.alpha,
                    mean.models, mean.literal_boxes, mean.letter_boxes, mean.index_boxes,
                    mean.work);
}

Json to_json(const AlphaResult& result) {
    Json rows = Json::array();
    for (const AlphaRow& row : result.rows) rows.push_back(row_json(row));
    return {{"model", result.model},
            {"faces", result.faces},
            {"verified", result.difference.empty()},
            {"center", row_json(result.center)},
            {"rows", std::move(rows)}};
}

Json to_json(const std::vector<AlphaMean>& means) {
    Json list = Json::array();
    for (const AlphaMean& mean : means)
        list.push_back({{"origins", mean.origins},
                        {"alpha", mean.alpha},
                        {"models", mean.models},
                        {"literal_boxes", mean.literal_boxes},
                        {"letter_boxes", mean.letter_boxes},
                        {"index_boxes", mean.index_boxes},
                        {"work", mean.work}});
    return list;
}

}  // namespace rimline::tools
