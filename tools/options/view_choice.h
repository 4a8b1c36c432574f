#pragma once

// Choosing the best views of a model: what `views` and `path` share, with a device and without.

#include <CLI/App.hpp>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "silhouette/field/best_views.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// The views of a mesh, and the field they are peaks of.
struct ChosenViews {
    TangentialField field;
    BestViews best;
    std::uint32_t asked;  ///< How many views were.
    bool is_inside_out;   ///< The model's faces are; they were taken the other way round.
    bool is_weighted;     ///< By visible ratios.
    double ms;            ///< Field and views; not reading the model, not opening a device.
};

struct ViewChoice {
    std::uint32_t count = 4;
    bool by_area = false;   ///< Planes' votes weigh as their faces' areas.
    bool no_ratio = false;  ///< Votes alone; as always in a build without the engine.

    void add_to(CLI::App& app, std::uint32_t least);

    /// With progress. `ratios` may be empty. Throws Error{bad_input} naming the model where fewer than
    /// `least` views are distinct: without a face that has a plane there is none.
    ChosenViews choose(const std::string& model, const Mesh& mesh, const VisibleRatios& ratios,
                       std::uint32_t least, const Context& context) const;
};

/// `eye score votes visible_ratio` of each; the ratio is null where nobody drew it.
nlohmann::ordered_json to_json(const ChosenViews& chosen);
/// The same as `views`, with `asked center radius inside_out renders candidates ms`.
nlohmann::ordered_json views_json(const std::string& model, const Mesh& mesh,
                                  const ChosenViews& chosen);
/// A line for each view, and what there is to say.
void print_views(const ChosenViews& chosen);

}  // namespace rimline::tools
