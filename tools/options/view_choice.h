#pragma once

// Choosing the best views of a model, for `views` and `path`, with a device and without.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "silhouette/field/best_views.h"
#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"
#include "tools/command.h"

namespace rimline::tools {

/// The best views of a mesh, and the field of which they are peaks.
struct ChosenViews {
    TangentialField field;
    BestViews best;
    std::uint32_t requested_count;
    bool is_inside_out;  ///< The faces of the model are inside out; the field uses them reversed.
    bool is_weighted;    ///< The votes are weighted by visible ratios.
    double ms;           ///< Field and views, without loading the model and opening a device.
};

struct ViewChoice {
    std::uint32_t count = 4;
    bool by_area = false;        ///< Weights the votes of planes by the areas of their faces.
    std::string below = "less";  ///< Views from below count less, or fully.
    bool no_ratio = false;       ///< Votes only.

    /// `min_count` is the least value of -k.
    void add_to(CLI::App& app, std::uint32_t min_count);

    /// How the views are chosen. `ratios` may be empty.
    BestViewsOptions options(const Mesh& mesh, const glm::dvec3& up,
                             const VisibleRatios& ratios) const;
    FieldOptions field_options() const;
    /// Chooses the views and shows progress. `ratios` may be empty. Throws Error{bad_input} naming the model
    /// if there are fewer than `min_count` distinct views. A model without a proper face has none.
    ChosenViews choose(const std::string& model, const Mesh& mesh, const glm::dvec3& up,
                       const VisibleRatios& ratios, std::uint32_t min_count,
                       const Context& context) const;
};

/// A list of `eye score votes visible_ratio preference`. The ratio is null if it was not measured.
nlohmann::ordered_json to_json(const ChosenViews& chosen);
/// An object of that list as `views`, and `asked center radius inside_out renders candidates ms`.
nlohmann::ordered_json views_json(const std::string& model, const Mesh& mesh,
                                  const ChosenViews& chosen);
/// Prints one line per view, and a summary.
void print_views(const ChosenViews& chosen);

}  // namespace rimline::tools
