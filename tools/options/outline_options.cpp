#include "tools/options/outline_options.h"

#include <CLI/App.hpp>

#include "tools/command.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

void OutlineOptions::add_to(CLI::App& app) {
    constexpr const char* k_group = "Style";
    app.add_option("--outline", method_,
                   "lines: exact edges. For comparison, what programs without edges draw, in one "
                   "color and without hidden lines: sobel, steps of depth and normals between "
                   "pixels; backs, back faces moved outwards by the width of a line")
        ->check(CLI::IsMember({"lines", "sobel", "backs"}))
        ->capture_default_str()
        ->group(k_group);
    add_number(app, "--depth-step", depth_step_, 0.0, 1.0,
               "sobel: the least step of depth, as a share of the height that the picture shows "
               "at its distance (default: 0.004)")
        ->group(k_group);
    add_number(app, "--normal-step", normal_step_, 0.0, 180.0,
               "sobel: the least bend between normals, in degrees; 180: none is found (default: "
               "40)")
        ->group(k_group);
}

void OutlineOptions::check_usage(const CLI::App& app) const {
    if (method_ != "sobel")
        refuse_options(app, {"--depth-step", "--normal-step"}, "belongs to --outline sobel");
    if (method_ == "lines") return;
    refuse_options(app,
                   {"--crease", "--hidden", "--intersections", "--min-length", "--silhouette-from",
                    "--silhouette-direction"},
                   "belongs to --outline lines");
    const CLI::Option* const color = app.get_option("--line-color");
    if (color->count() > 0 && color->results().back() == "material")
        throw UsageError("--line-color material: belongs to --outline lines");
}

Outline OutlineOptions::outline() const {
    Outline outline;
    if (method_ == "sobel") outline.method = OutlineMethod::sobel;
    if (method_ == "backs") outline.method = OutlineMethod::backs;
    if (depth_step_) outline.depth_step = static_cast<float>(*depth_step_);
    if (normal_step_) outline.normal_step_deg = static_cast<float>(*normal_step_);
    return outline;
}

}  // namespace rimline::tools
