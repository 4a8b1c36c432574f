#include "tools/options/surface_options.h"

#include <CLI/App.hpp>
#include <numbers>

#include "tools/command.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

constexpr double k_radians = std::numbers::pi / 180.0;

}  // namespace

void SurfaceOptions::add_to(CLI::App& app) {
    const char* group = "Umbrellas";
    add_count(app, "-k", k_, 4, 32, "Number of nearest neighbors of a point")->group(group);
    app.add_option_function<std::string>(
           "--method",
           [this](const std::string& text) {
               if (text != "robust" && text != "thesis")
                   throw CLI::ValidationError("--method",
                                              "expected robust or thesis, not '" + text + "'");
               method_ = text;
           },
           "robust, or thesis: the method of chapter 5 of the thesis, which its options below "
           "choose too")
        ->type_name("NAME")
        ->default_str("robust")
        ->group(group);
    add_number(app, "--gap-ratio", gap_ratio_, 1.001, 1000.0,
               "robust: smallest circumradius of a gap, in scales of its corners (default: 2.75)")
        ->group(group);
    app.add_flag(
           "--drop-outliers", drops_outliers_,
           "Find the points that lie on no surface, about three spacings or more away, and the "
           "umbrellas of the others without them; none if they are more than a tenth")
        ->group(group);
    add_number(app, "--omega", omega_, 0.001, 89.999,
               "thesis: largest angle between a neighbor and the plane, in degrees (default: 30)")
        ->group(group);
    add_number(app, "--omega-t", omega_t_, 0.0, 89.999,
               "thesis: half width of the marginal band around omega, in degrees (default: "
               "omega / 3)")
        ->group(group);
    add_number(app, "--phi", phi_, 0.001, 180.0,
               "thesis: widest sector that is not a gap, in degrees (default: 180 - omega)")
        ->group(group);
    add_number(app, "--gamma", gamma_, 1.001, 1000.0,
               "thesis: smallest circumradius of a gap, in circumradii of the Gabriel triangle "
               "(default: 2)")
        ->group(group);
}

PointSurfaceOptions SurfaceOptions::options() const {
    const bool is_of_thesis = omega_ || omega_t_ || phi_ || gamma_;
    if (is_of_thesis && (method_ == "robust" || gap_ratio_))
        throw UsageError("--omega, --omega-t, --phi and --gamma belong to --method thesis");
    if (gap_ratio_ && method_ == "thesis")
        throw UsageError("--gap-ratio belongs to --method robust");
    PointSurfaceOptions options;
    options.k = k_;
    options.drops_outliers = drops_outliers_;
    if (gap_ratio_) options.gap_ratio = *gap_ratio_;
    if (method_ != "thesis" && !is_of_thesis) return options;
    options.method = PointSurfaceOptions::Method::thesis;
    if (omega_) {
        options.omega = *omega_ * k_radians;
        options.omega_t = options.omega / 3.0;
        options.phi = std::numbers::pi - options.omega;
    }
    if (omega_t_) options.omega_t = *omega_t_ * k_radians;
    if (phi_) options.phi = *phi_ * k_radians;
    if (gamma_) options.gamma = *gamma_;
    if (options.omega_t > options.omega) throw UsageError("--omega-t: is above --omega");
    return options;
}

}  // namespace rimline::tools
