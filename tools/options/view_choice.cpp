#include "tools/options/view_choice.h"

#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "silhouette/mesh/winding.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/progress.h"

namespace rimline::tools {

void ViewChoice::add_to(CLI::App& app, std::uint32_t min_count) {
    add_count(app, "-k", count, min_count, 64, "Number of views")->group("Views");
    app.add_flag("--by-area", by_area,
                 "Weight votes by the areas of faces, for faces of very different sizes")
        ->group("Views");
    app.add_option(
           "--below", below,
           "Views from below the horizon count less, down to a half at 60 degrees, and views from "
           "behind a fifth less than three-quarter views, and those that show little of the "
           "surface "
           "less; full: none of these")
        ->check(CLI::IsMember({"less", "full"}))
        ->capture_default_str()
        ->group("Views");
    app.add_flag("--no-ratio", no_ratio,
                 "Use votes only: do not measure the visible share of the silhouettes")
        ->group("Views");
}

FieldOptions ViewChoice::field_options() const {
    FieldOptions options{.tolerance = k_view_tolerance};
    if (by_area) options.weight = FieldOptions::Weight::area;
    return options;
}

BestViewsOptions ViewChoice::options(const Mesh& mesh, const glm::dvec3& up,
                                     const VisibleRatios& ratios) const {
    BestViewsOptions options;
    options.count = count;
    options.visible_ratios = ratios;
    if (below == "less") {
        options.up = up;
        options.mesh = &mesh;
    }
    options.mirror_axis = symmetry_axis(mesh);
    options.for_people = true;
    return options;
}

ChosenViews ViewChoice::choose(const std::string& model, const Mesh& mesh, const glm::dvec3& up,
                               const VisibleRatios& ratios, std::uint32_t min_count,
                               const Context& context) const {
    const auto start = std::chrono::steady_clock::now();
    Progress progress(context, "choosing views");
    TangentialField field = make_view_field(mesh, field_options(), view_function(), context.stop);
    BestViews best = find_best_views(field, options(mesh, up, ratios), progress.call());
    if (best.views.size() < min_count)
        throw Error(ErrorCode::bad_input,
                    model + ": " +
                        (best.views.empty()
                             ? "no face has a plane, so no view is better than another: take a "
                               "model with faces that are not degenerate"
                             : "one view shows all there is to see: take a model with more faces"));
    return {
        .field = std::move(field),
        .best = std::move(best),
        .requested_count = count,
        .is_inside_out = is_inside_out(mesh),
        .is_weighted = bool(ratios),
        .ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count()};
}

nlohmann::ordered_json to_json(const ChosenViews& chosen) {
    nlohmann::ordered_json views = nlohmann::ordered_json::array();
    for (const BestView& view : chosen.best.views) {
        nlohmann::ordered_json ratio = nullptr;
        if (chosen.is_weighted) ratio = view.visible_ratio;
        views.push_back({{"eye", {view.eye.x, view.eye.y, view.eye.z}},
                         {"score", view.score()},
                         {"votes", view.votes},
                         {"visible_ratio", std::move(ratio)},
                         {"preference", view.preference}});
    }
    return views;
}

nlohmann::ordered_json views_json(const std::string& model, const Mesh& mesh,
                                  const ChosenViews& chosen) {
    const glm::dvec3 center = mesh.center();
    return {{"model", model},
            {"views", to_json(chosen)},
            {"asked", chosen.requested_count},
            {"center", {center.x, center.y, center.z}},
            {"radius", mesh.radius()},
            {"inside_out", chosen.is_inside_out},
            {"renders", chosen.best.renders},
            {"candidates", chosen.best.candidates},
            {"ms", chosen.ms}};
}

void print_views(const ChosenViews& chosen) {
    for (const BestView& view : chosen.best.views) {
        std::printf("  view        from %.9g,%.9g,%.9g  score %.1f", view.eye.x, view.eye.y,
                    view.eye.z, view.score());
        if (chosen.is_weighted) std::printf(", %.0f%% visible", 100.0 * view.visible_ratio);
        std::printf("\n");
    }
    if (chosen.best.views.size() < chosen.requested_count)
        std::printf("  fewer       %zu of %u: no other view shows more\n", chosen.best.views.size(),
                    chosen.requested_count);
    if (chosen.is_inside_out)
        std::printf("  winding     inside out: faces are taken the other way round\n");
    if (chosen.is_weighted)
        std::printf("  measured    %llu of %llu candidates\n",
                    static_cast<unsigned long long>(chosen.best.renders),
                    static_cast<unsigned long long>(chosen.best.candidates));
    std::printf("  time        %.1f ms\n", chosen.ms);
}

}  // namespace rimline::tools
