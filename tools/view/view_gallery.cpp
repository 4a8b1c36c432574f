#include "tools/view/view_gallery.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "silhouette/field/best_views.h"
#include "silhouette/field/camera_tour.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/clear_creases.h"
#include "tools/options/view_choice.h"

namespace rimline::tools {

GalleryView gallery_view(const LineSurface& surface, const glm::dvec3& towards_viewer,
                         const glm::dvec3& up, const LongCall& call) {
    const Mesh& mesh = surface.mesh();
    const double radius = mesh.radius() > 0.0 ? mesh.radius() : 1.0;
    const LineView view =
        LineView::orthographic(mesh.center() + 3.0 * radius * towards_viewer, mesh.center(), up);
    // Of the drawing, in the model's units: it is about a hundred pixels wide.
    const double pixel = 0.02 * radius;
    LineOptions options{
        .gap = pixel, .min_length = 3.0 * pixel, .stubble = 4.0 * pixel, .simplify = 0.1 * pixel};
    const std::vector<std::uint8_t> creases =
        clear_crease_flags(mesh, options.crease_angle_rad, call.stop);
    options.shown_creases = creases;
    LineDrawer drawer(surface);
    const LineDrawing& lines =
        drawer.draw(view, brute_force_silhouette(mesh, view.point()), options, call);
    GalleryView found{.towards_viewer = glm::normalize(towards_viewer), .strokes = {}};
    for (const LineStroke& stroke : lines.strokes)
        for (const StrokePart& part : lines.parts_of(stroke)) {
            std::vector<glm::vec2> points;
            for (const LinePoint& point : lines.points_of(part))
                points.push_back(glm::vec2(point.position / radius));
            found.strokes.push_back(std::move(points));
        }
    return found;
}

void ViewGallery::find(const ModelDocument& model, const glm::dvec3& up) {
    clear();
    is_finding_ = true;
    thread_ = std::jthread([this, &model, up](std::stop_token stop) {
        try {
            work({std::move(stop), {}}, model, up);
        } catch (const std::exception&) {
            // Cancelled, or without memory: the window works without.
        }
        {
            const std::lock_guard lock(mutex_);
            is_finding_ = false;
        }
        if (wake_) wake_();
    });
}

void ViewGallery::work(const LongCall& call, const ModelDocument& model, const glm::dvec3& up) {
    const Mesh& mesh = model.mesh();
    const ViewChoice choice{.count = k_views};
    const TangentialField field =
        make_view_field(mesh, choice.field_options(), view_function(), call.stop);
    const BestViews best = find_best_views(field, choice.options(mesh, up, {}), call);
    for (const BestView& view : best.views) {
        GalleryView found = gallery_view(model.lines().surface(),
                                         glm::normalize(view.eye - mesh.center()), up, call);
        {
            const std::lock_guard lock(mutex_);
            views_.push_back(std::make_shared<const GalleryView>(std::move(found)));
        }
        if (wake_) wake_();
    }
    if (best.views.size() < 2) return;
    std::vector<glm::dvec3> eyes, places;
    for (const BestView& view : best.views) eyes.push_back(view.eye);
    for (const TourNode& node : plan_tour(field, eyes, call)) places.push_back(node.place);
    CameraPath path(mesh.center(), places);
    const std::lock_guard lock(mutex_);
    path_ = std::move(path);
}

std::optional<CameraPath> ViewGallery::path() const {
    const std::lock_guard lock(mutex_);
    return path_;
}

void ViewGallery::clear() {
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
    }
    const std::lock_guard lock(mutex_);
    views_.clear();
    path_.reset();
    is_finding_ = false;
}

std::vector<std::shared_ptr<const GalleryView>> ViewGallery::views() const {
    const std::lock_guard lock(mutex_);
    return views_;
}

bool ViewGallery::is_finding() const {
    const std::lock_guard lock(mutex_);
    return is_finding_;
}

}  // namespace rimline::tools
