#include "tools/view/view_arguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "silhouette/srgb.h"
#include "tools/command.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/standard_input.h"
#include "tools/usage_words.h"

namespace rimline::tools {

void ViewArguments::add_to(CLI::App& app) {
    models_.add_to(app, StandardInput::not_read);
    cloud_.add_flags_to(app);
    scene_.add_to(app);
    picture_.add_silhouette_to(app);
    picture_.add_camera_to(app);
    models_.add_to_camera(app);
    picture_.add_lights_to(app);
    picture_.add_image_to(app);
    picture_.add_machine_to(app);
}

void ViewArguments::settle() {
    models_.settle(picture_, {});
    scene_.has_painted_models = models_.has_paint();
    models_.check_usage([&] { scene_.check_usage(picture_); });
    for (const PlacedModel& model : models_.models())
        if (model.model == k_standard_input)
            throw UsageError("MODEL: the window reads no standard input");
}

OpenedView ViewArguments::open(const BeginCall& begin, bool inspects) {
    Document document = open_document_of_models(begin);
    OpenedView view = document.cloud() ? cloud_view(std::move(document), inspects)
                                       : model_view(std::move(document));
    if (!fits()) view.frame_aspect = double(picture_.size.width) / picture_.size.height;
    return view;
}

Document ViewArguments::open_document_of_models(const BeginCall& begin) {
    if (models_.is_plain()) {
        CloudArgument argument = cloud_;
        argument.model = models_.models().front().model;
        argument.subdivide = models_.models().front().subdivide;
        return open_document(argument, begin);
    }
    if (cloud_.as_points || cloud_.drop_bad)
        throw UsageError("--as-points and --drop-bad: a scene has no clouds");
    const MeshSource source =
        models_.load(picture_, {TexturePictures::read, scene_.shows_file_colors()}, begin);
    auto document = std::make_unique<ModelDocument>(models_.name(), source, begin);
    document->set_models(models_.models(), glm::dvec3(*picture_.ground_up),
                         scene_.shows_file_colors());
    return document;
}

OpenedView ViewArguments::cloud_view(Document document, bool inspects) const {
    const bool is_lit = !picture_.lights.empty() || !picture_.suns.empty() ||
                        picture_.has_chosen_sun || scene_.ground;
    if (is_lit || scene_.hidden || scene_.has_creases() || scene_.style != "ink" || inspects)
        throw UsageError(models_.name() +
                         " is a cloud: lights, ground, styles, hidden lines, creases and Hough "
                         "space are of models");
    const CloudDocument& cloud = *document.cloud();
    OpenedView view;
    view.camera = make_cloud_camera(cloud.drawing(), cloud.umbrellas(), models_.name(),
                                    in_double(picture_.eye), in_double(picture_.target), picture_);
    if (picture_.background) view.appearance.background = linear_from_srgb(*picture_.background);
    if (scene_.color) view.appearance.color = linear_from_srgb(*scene_.color);
    if (scene_.line_color) view.appearance.line_color = linear_from_srgb(*scene_.line_color);
    view.appearance.lines = scene_.draws_lines();
    if (scene_.line_width) view.appearance.line_width_px = float(*scene_.line_width);
    std::optional<glm::dvec3> from = in_double(picture_.silhouette_from);
    if (from) from = glm::dvec3(cloud.umbrellas().to_index(*from));
    view.frozen = silhouette_camera_of(document.subject(), view.camera, from, picture_);
    view.document = std::move(document);
    return view;
}

OpenedView ViewArguments::model_view(Document document) {
    ModelDocument& model = *document.model();
    OpenedView view;
    if (models_.is_plain()) {
        view.up = settle_up(model.mesh(), picture_.up, picture_.is_up_auto);
        model.set_models(models_.models(), std::nullopt);
    }
    if (!picture_.eye) picture_.view.choose(models_.name(), model.mesh(), glm::dvec3(*picture_.up));
    const Camera camera = make_camera(model.mesh(), models_.name(), picture_);
    const double aspect = double(picture_.size.width) / picture_.size.height;
    Scene scene = scene_.make_scene(
        camera, SceneLights(picture_, model.mesh(), scene_.ground).lights(camera, aspect),
        picture_);
    if (scene_.ground) frame_ground(scene, model.mesh(), picture_);
    ViewAppearance& appearance = view.appearance;
    appearance.set_style(scene.style);
    appearance.background = scene.palette.background;
    if (scene_.color) appearance.color = linear_from_srgb(*scene_.color);
    if (scene_.line_color) appearance.line_color = linear_from_srgb(*scene_.line_color);
    appearance.materials = scene_.materials == "on";
    appearance.material_lines = scene_.has_material_lines;
    appearance.lines = scene.lines;
    appearance.line_width_px = scene.line_width_px;
    appearance.hidden = scene_.hidden;
    appearance.crease_angle_deg = scene.crease_angle_deg;
    appearance.only_clear_creases = scene.only_clear_creases;
    appearance.shadows = scene.shadows;
    appearance.shadow_method = scene.shadow_method;
    appearance.ground = scene_.ground;
    appearance.three_point = picture_.is_three_point();
    view.camera = scene.camera;
    view.lights = std::move(scene.lights);
    view.has_chosen_sun = picture_.lights.empty() && picture_.suns.empty();
    view.frozen = silhouette_camera_of(document.subject(), view.camera,
                                       in_double(picture_.silhouette_from), picture_);
    if (is_scene_file()) {
        view.size = models_.scene_size();
        view.scene_cameras = models_.scene_cameras();
        view.unused_picture = models_.unused_picture();
        view.warnings = models_.warnings();
    }
    view.document = std::move(document);
    return view;
}

ParsedView open_view(std::vector<std::string> arguments, const BeginCall& begin,
                     std::span<const PlacedModel> subdivided) {
    CLI::App app("", "view");
    ViewArguments view;
    view.add_to(app);
    std::ranges::reverse(arguments);  // The order that CLI11 expects.
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        throw UsageError(first_usage_words(error, app));
    }
    view.settle();
    if (!subdivided.empty()) view.subdivide_as(subdivided);
    return {.view = view.open(begin), .is_scene_file = view.is_scene_file()};
}

}  // namespace rimline::tools
