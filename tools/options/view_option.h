#pragma once

// Where a camera stands that is not given as a point: a named view, an azimuth and an elevation, or auto, the direction
// that shows the model best (silhouette/field/picture_view.h). Directions are those of ground_axes.h: the front
// is at +z if y is up, and at -y if z is up.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"

namespace rimline::tools {

enum class NamedView : std::uint8_t {
    automatic,
    front,
    back,
    left,
    right,
    top,
    bottom,
    three_quarter,
};

/// Of all views but NamedView::automatic.
std::vector<std::string> view_names();

struct ViewOption {
    std::optional<NamedView> name;  ///< Of --eye.
    std::optional<double> azimuth_deg, elevation_deg;
    std::optional<glm::dvec3> chosen;  ///< By choose().

    /// Adds --eye, which sets `eye` or a name, --azimuth and --elevation.
    void add_to(CLI::App& app, std::optional<glm::vec3>& eye);
    /// The same of a cloud, for which auto chooses nothing: without it.
    void add_to_cloud(CLI::App& app, std::optional<glm::dvec3>& eye);

    /// The direction towards the viewer that the options name. Nothing for auto and where no option is given.
    std::optional<glm::dvec3> given(const glm::dvec3& up) const;
    /// Chooses the direction of auto, which is the default but for the built-in scene, unless another one is given.
    void choose(const std::string& model, const Mesh& mesh, const glm::dvec3& up,
                const LongCall& call = {});
    /// The direction that is given or chosen, or else the default of default_view.h.
    glm::dvec3 direction(const std::string& model, const glm::dvec3& up) const;

private:
    // `first` is the first view that --eye takes, which becomes the name; set_eye() takes points.
    void add(CLI::App& app, NamedView first, std::function<void(const std::string&)> set_eye,
             const char* description);
};

/// The angle of this direction on an orbit about `up` (silhouette/hough/orbit.h): 0 at the right, a quarter turn at the
/// back. 0 for a direction along `up`.
double orbit_angle_rad(const glm::dvec3& direction, const glm::dvec3& up);

/// Up in a picture seen from this direction: `up`, or where the camera looks along it, the axis that points away from a
/// viewer in front if seen from above, and towards that viewer if seen from below.
glm::dvec3 up_in_picture(const glm::dvec3& direction, const glm::dvec3& up);

}  // namespace rimline::tools
