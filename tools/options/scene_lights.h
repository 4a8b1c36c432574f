#pragma once

// The lights of a picture: those of the options, and a sun that is chosen for the camera
// (silhouette/field/picture_sun.h) with --sun auto and where no light is given.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene.h"
#include "silhouette/field/picture_sun.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/animation.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

/// What a camera shows in a picture `aspect` times as wide as high.
PictureFrame picture_frame(const Camera& camera, double aspect);

class SceneLights {
public:
    /// `mesh` must outlive this object. The default `options.up` is that of the mesh. O(n log n) if a sun is
    /// chosen.
    SceneLights(const PictureOptions& options, const Mesh& mesh, bool has_ground,
                const LongCall& call = {});

    /// Whether --sun is auto, or no light is given.
    bool chooses_sun() const noexcept { return survey_.has_value(); }

    /// The lights for one picture, the chosen sun last. Rounded to float as options are parsed, so that a direction
    /// which is printed gives the same picture. Where a camera sees nothing of the mesh, the sun is default_sun().
    std::vector<Light> lights(const Camera& camera, double aspect, const LongCall& call = {}) const;

    /// Directions of the chosen sun in an animation, one for each shot. Only if chooses_sun().
    std::vector<glm::dvec3> moving_sun(std::span<const Shot> shots, double aspect,
                                       const LongCall& call = {}) const;

private:
    std::vector<Light> given_;
    PictureSunOptions options_;
    std::optional<SunSurvey> survey_;
};

}  // namespace rimline::tools
