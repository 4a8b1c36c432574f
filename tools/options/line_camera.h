#pragma once

// The camera of `draw`: the options of PictureOptions, as a LineView. It needs no engine.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"
#include "tools/options/up_option.h"
#include "tools/options/view_option.h"

namespace rimline::tools {

struct LineCamera {
    std::string name;
    LineView view;
    glm::dvec3 eye, target, up;
    /// Half the height that the field of view, or the height of an orthographic picture, shows, in picture
    /// coordinates.
    double half_height;
    /// The options fix what the picture shows. If not, it shows the whole model.
    bool is_framed;
};

/// The part of a picture that a drawing shows, in picture coordinates.
struct ShownPart {
    glm::dvec2 low, high;
    bool is_cut;  ///< Lines can leave it.
};

struct LineCameraOptions : UpOptions {
    std::optional<glm::vec3> eye;
    ViewOption view;  ///< Where the camera stands without `eye`.
    std::optional<glm::vec3> target;
    std::optional<double> fov_degrees;  ///< Not set: 35.
    bool is_orthographic = false;
    std::optional<double>
        ortho_height;  ///< Not set in an orthographic view: it shows the whole model.

    void add_to(CLI::App& app);
    /// Whether an option says where the camera stands.
    bool has_place() const noexcept {
        return eye || view.name || view.azimuth_deg || view.elevation_deg;
    }
    /// As `render` chooses it, unless there is an eye: ViewOption::choose(). It comes before make_camera(), or a chosen
    /// view is the default one.
    void choose_view(const std::string& model, const Mesh& mesh, const LongCall& call = {});
    /// Throws UsageError if eye and target coincide, and Error{too_large} if the eye is too far away.
    LineCamera make_camera(const std::string& model, const Mesh& mesh) const;
    glm::dvec3 up_of(const Mesh& mesh) const;
};

/// The frame of the camera if it is framed, or if the model reaches beside or behind the eye: of this aspect. If
/// not, the bounds of the model's picture. O(vertices).
ShownPart shown_part(const LineCamera& camera, const Mesh& mesh, double aspect);

}  // namespace rimline::tools
