#pragma once

// The sun that lights a picture of a mesh well: neither dark nor flat.
//
// Suns are compared by what they do at the places of the mesh that the camera sees, a grid of about a thousand, or
// where the mesh covers little of that, as many through its faces.
// A place is dark where its normal is too far from the sun for the styles to draw light (surface_shading.glsl),
// where its face turns away, and where a ray towards the sun meets a face: cast shadows count. Of the lit
// places, those whose normal is near the sun are bright, the others half bright. The score of a sun is the
// product of
//
//   lit       1 where a third to two thirds of the places are lit, and less the farther their share lies outside; a
//             picture that is too dark loses more than one that is too light;
//   spread    the entropy of the shares of dark, half bright and bright places: low for light from beside the camera,
//             which leaves all bright, and for light from behind;
//   detail    the share of the detail that is lit. The detail of a place is how much its normal differs from those of
//             its neighbors in the grid: a face is in the light, and the back of a head may be dark;
//   usual     0.5 to 1: people expect light from above, on their side, from the left rather than from the right.
//
// Candidates are 96 directions: 24 around the up axis at 12, 25, 40 and 55 degrees; with a ground those at 40
// and 55, so that shadows are short. For a camera below the horizon, and no ground, 72 more at 0, 25 and 50
// degrees below it.
//
// The constants were chosen by looking at pictures of the meshes of this project (docs/contributing.md), and
// judged on no others.
//
// A moving sun has one of these directions at each key camera, 10 degrees or more apart. The choice minimizes
// the sum of -log(score) and of the angles by which the sun turns, over all sequences (Viterbi). Between the
// keys it moves smoothly.

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// What a picture shows. Axes are of length 1 and perpendicular to each other.
struct PictureFrame {
    glm::dvec3 eye;
    glm::dvec3 right, up, back;  ///< Of the picture, and towards the viewer.
    /// Half the width and height of the picture at distance 1 from the eye; if orthographic, at any distance.
    glm::dvec2 half_size;
    bool is_orthographic = false;
};

/// What a sun does at the visible places of a mesh, as shares of these.
struct SunTones {
    double lit = 0.0;     ///< Not dark. Cast shadows are dark.
    double bright = 0.0;  ///< Of all places; half bright are lit - bright.
    double detail = 0.0;  ///< Of the detail, what is lit.
    double spread = 0.0;  ///< Entropy of dark, half bright and bright: 1 if each is a third.
};

struct PictureSun {
    glm::dvec3 direction;  ///< Of length 1, from the mesh towards the light.
    SunTones tones;
    double score;  ///< 0 to 1, the product above.
};

/// A place of a mesh that a camera sees.
struct SeenPlace {
    glm::dvec3 position;
    glm::dvec3 normal;       ///< As surfaces are shaded, on the visible side.
    glm::dvec3 face_normal;  ///< On the visible side.
    std::uint32_t face;
    double detail;
};

/// The default of RendererOptions::crease_angle_rad.
inline constexpr float k_shading_crease_rad = 0.7f;

/// Measures suns for one mesh and any number of cameras.
class SunSurvey {
public:
    /// `mesh` must outlive the survey. `crease_angle_rad` is that of corner_normals.h. O(n log n). Throws
    /// Error{cancelled}.
    explicit SunSurvey(const Mesh& mesh, float crease_angle_rad = k_shading_crease_rad,
                       const LongCall& call = {});

    /// The places that a grid of at most `rays` rays through the picture of the mesh meets. Where fewer than a
    /// hundredth meet it, as of two small parts far apart: those that rays through the pictures of its faces meet,
    /// without detail.
    std::vector<SeenPlace> places(const PictureFrame& frame, std::uint32_t rays) const;
    SunTones tones(std::span<const SeenPlace> places, const glm::dvec3& sun) const;
    /// The same, or nothing once is_enough(tones) holds of what lit, bright and detail still can be at most: as if no
    /// place that is not looked at yet lay in a cast shadow. Of these `spread` is not set.
    std::optional<SunTones> tones(std::span<const SeenPlace> places, const glm::dvec3& sun,
                                  const std::function<bool(const SunTones&)>& is_enough) const;

    const Mesh& mesh() const noexcept { return mesh_; }

private:
    std::optional<SeenPlace> place_at(const PictureFrame& frame, const glm::dvec2& at) const;
    std::vector<SeenPlace> places_in_faces(const PictureFrame& frame, std::uint32_t rays) const;
    bool is_blocked(const SeenPlace& place, const glm::dvec3& sun) const;

    const Mesh& mesh_;
    FaceTree tree_;
    std::vector<glm::vec3> normals_;
};

struct PictureSunOptions {
    glm::dvec3 up{0.0, 1.0, 0.0};
    bool has_ground = false;  ///< Then no sun is below the horizon.
};

/// The candidates for one camera.
std::vector<glm::dvec3> picture_sun_candidates(const PictureFrame& frame,
                                               const PictureSunOptions& options);
/// The product above for a sun with these tones.
double picture_sun_score(const SunTones& tones, const glm::dvec3& sun, const PictureFrame& frame);

/// The candidate with the best score, the first of equals. Candidates that cannot have it are not measured: mostly more
/// than half. Nothing if no ray meets the mesh. Does not depend on the number of threads. Throws Error{cancelled}.
std::optional<PictureSun> choose_picture_sun(const SunSurvey& survey, const PictureFrame& frame,
                                             const PictureSunOptions& options,
                                             const LongCall& call = {});

/// One direction for each frame, of length 1. Between two key cameras the sun turns by at most twice the angle
/// by which the camera turns, or by one step of the candidates where that is more. If the camera ends about
/// where it began, so does the sun. Where nothing is seen, any sun will do. 48 key cameras at most,
/// each with a third of the places of choose_picture_sun(), and with all candidates. Throws Error{cancelled}.
std::vector<glm::dvec3> choose_moving_sun(const SunSurvey& survey,
                                          std::span<const PictureFrame> frames,
                                          const PictureSunOptions& options,
                                          const LongCall& call = {});

}  // namespace rimline
