#include "tools/options/cloud_argument.h"

#include <CLI/App.hpp>
#include <optional>
#include <utility>

#include "silhouette/mesh/formats/point_file.h"
#include "tools/input_files.h"
#include "tools/options/standard_input.h"
#include "tools/progress.h"

namespace rimline::tools {

void CloudArgument::add_to(CLI::App& app) {
    app.add_option_function<std::string>(
           "CLOUD",
           [this](const std::string& text) {
               check_model_name(text, "CLOUD");
               model = text;
           },
           "File of points (PLY, OBJ, XYZ, PTS, CSV), or - for standard input; with --as-points, "
           "any "
           "model")
        ->type_name("")
        ->required();
    add_flags_to(app);
    add_subdivide(app, subdivide)->group("Cloud");
    app.add_option("--format", format, "Format of a CLOUD from standard input")
        ->check(CLI::IsMember({"ply", "obj", "xyz", "pts", "csv", "stl", "off", "glb"}))
        ->group("Cloud");
}

void CloudArgument::add_flags_to(CLI::App& app) {
    app.add_flag("--as-points", as_points,
                 "Use the vertices of a model as points, and its borders as ground truth")
        ->group("Cloud");
    app.add_flag("--drop-bad", drop_bad, "Ignore points that are not finite, and count them")
        ->group("Cloud");
}

PointCloud CloudArgument::load(const Context& context) const {
    PointCloud cloud =
        follow_progress(context, [&](const BeginCall& begin) { return load(begin); });
    context.times.end("reading");
    return cloud;
}

PointCloud CloudArgument::load(const BeginCall& begin) const {
    check_format_is_of_input(model, format);
    PointSource source;
    if (is_built_in_shape(model) || (as_points && subdivide > 0))
        source = points_of(load_model(model, subdivide, FaceRequirement::faces_or_points, begin,
                                      TexturePictures::skip, format));
    else if (model == k_standard_input)
        source =
            read_cloud_from_standard_input(format, drop_bad ? BadPoints::keep : BadPoints::refuse,
                                           begin("reading standard input"));
    else
        source = about_scene_files(model, [&] {
            return read_point_file(model, drop_bad ? BadPoints::keep : BadPoints::refuse,
                                   begin("reading " + model));
        });
    declare_inputs(source.files);
    if (subdivide > 0 && source.triangles.empty())
        throw Error(ErrorCode::bad_input, model + ": --subdivide: it has no faces");
    if (!as_points && !source.triangles.empty())
        throw Error(ErrorCode::bad_input, model + ": it has " +
                                              std::to_string(source.triangles.size()) +
                                              " faces; --as-points takes its vertices for a cloud");
    PointCloud cloud = about_model(model, [&] { return PointCloud(std::move(source)); });
    if (cloud.size() == 0)
        throw Error(ErrorCode::bad_input, model + ": none of its " +
                                              std::to_string(cloud.file_point_count()) +
                                              " points is finite");
    return cloud;
}

}  // namespace rimline::tools
