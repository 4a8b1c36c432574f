#pragma once

// The state that the window shows, without the window: the model or the cloud, the camera, the lights, the
// appearance, and the camera of a frozen silhouette. Input and panel change this state; picture() converts
// it into a scene.

#include <algorithm>
#include <glm/vec2.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "engine/clouds/splat_renderer.h"
#include "engine/scene.h"
#include "tools/options/line_style.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_finish.h"
#include "tools/options/scene_file.h"
#include "tools/options/up_option.h"
#include "tools/view/document.h"

namespace rimline::tools {

struct ViewAppearance {
    /// With the defaults of the style.
    explicit ViewAppearance(Style chosen = Style::ink) { set_style(chosen); }
    /// Changes the style. Colors, lines, their width and creases become those of the style.
    void set_style(Style chosen);
    LineStyle line_style() const;
    /// A color of surfaces that the user has chosen hides those of the file.
    bool shows_file_colors() const noexcept { return materials && !color; }

    Style style = Style::ink;
    glm::vec3 background{1.0f};  ///< Linear, as the two colors below.
    /// Of surfaces and of lines. Not set: the style's own.
    std::optional<glm::vec3> color, line_color;
    bool materials = true;  ///< Surfaces have the colors of the model's file unless `color` is set.
    bool material_lines = false;  ///< Lines have shades of these colors.
    bool lines = true;
    float line_width_px = 2.5f;
    bool hidden = false;  ///< Draws hidden lines too, dashed.
    /// Above 0: edges that bend by at least this angle are lines too.
    float crease_angle_deg = 0.0f;
    bool only_clear_creases = true;  ///< Of these, only those that stand out.
    bool shadows = true;
    ShadowMethod shadow_method = ShadowMethod::automatic;  ///< All methods give the same picture.
    bool ground = false;
    bool three_point = false;  ///< A sun that is alone has a fill and a rim light (three_point.h).
    double fov_y_deg = 35.0;
    bool orthographic = false;

    bool operator==(const ViewAppearance&) const = default;
};

/// What the user sets of a session besides the camera.
struct ViewEdit {
    std::vector<PlacedModel> models;     ///< Of the document. Empty for a cloud.
    std::optional<glm::dvec3> scene_up;  ///< ModelDocument::scene_up().
    bool has_chosen_sun = false;
    std::vector<Light> lights;
    std::optional<Camera> frozen;
    ViewAppearance appearance;

    /// A chosen sun equals another one: it follows the camera, which is no edit. What follows from the models,
    /// scene_up, is not compared.
    bool operator==(const ViewEdit& other) const;
};

/// All that ViewSession::picture() depends on, but the size of the picture. Equal ones give the same picture.
struct ViewSight {
    const void* document = nullptr;  ///< While it lives.
    Camera camera;
    std::vector<Light> lights;
    std::optional<Camera> frozen;
    ViewAppearance appearance;

    bool operator==(const ViewSight&) const = default;
};

/// The part of a window that no panel covers, in any unit.
struct FreeArea {
    glm::dvec2 window{1.0};          ///< Width and height.
    double left = 0.0, right = 0.0;  ///< Widths of what is covered at the sides.

    double width() const { return std::max(window.x - left - right, 0.3 * window.x); }
    double aspect() const { return width() / std::max(window.y, 1e-9); }
    /// Its corners, with a margin for marks.
    std::pair<glm::dvec2, glm::dvec2> corners(double margin) const {
        return {{left + margin, margin}, {left + width() - margin, window.y - margin}};
    }
    bool operator==(const FreeArea&) const = default;
};

/// A document with all that says how it is shown.
struct OpenedView {
    Document document;
    Camera camera;
    std::vector<Light> lights;
    bool has_chosen_sun = false;  ///< The last of the lights is a sun that nobody named.
    ViewAppearance appearance;
    std::optional<Camera> frozen;  ///< Whose silhouette is shown.
    ChosenUp up;                   ///< Of the mesh of a model that stands alone.
    /// Where eye or target were given: width / height of the picture that they were given for.
    std::optional<double> frame_aspect = {};
    /// What else a scene file has: the size of its picture, all of its cameras, and the keys of its picture that the
    /// window has no option for, with warnings.
    std::optional<ImageSize> size;
    nlohmann::ordered_json scene_cameras = nlohmann::ordered_json::object();
    nlohmann::ordered_json unused_picture = nlohmann::ordered_json::object();
    std::vector<std::string> warnings = {};
};

/// The scene of a model or of a cloud.
using ViewPicture = std::variant<Scene, SplatScene>;

class ViewSession {
public:
    ViewAppearance appearance;
    Camera camera;
    std::vector<Light> lights;

    /// Shows another document. The camera sees all of it; a model is lit by one sun. The appearance stays
    /// and the silhouette is no longer frozen. The document before is kept until forget_previous(), because
    /// frames in flight refer to it by address.
    void show(Document document, double aspect);
    /// The same with the given camera and lights. The appearance takes over the camera's lens.
    void show(Document document, const Camera& chosen, std::vector<Light> chosen_lights);
    /// The same with the appearance too. A picture that is given (OpenedView::frame_aspect) is whole in the window.
    void show(OpenedView opened);
    /// Shows another document with the same camera and lights and the same frozen silhouette, for models that have been
    /// moved.
    void replace(Document document);
    /// Returns to the document before; for a document that is too large for the device. False if there is
    /// none.
    bool show_previous(double aspect);
    /// Destroys the document before. No frame in flight may refer to it.
    void forget_previous() noexcept { previous_ = {}; }

    bool is_empty() const noexcept { return !document_; }
    const Document& document() const noexcept { return document_; }
    bool is_cloud() const noexcept { return document_.cloud() != nullptr; }
    const ModelDocument& model() const noexcept { return *document_.model(); }
    const CloudDocument& cloud() const noexcept { return *document_.cloud(); }
    /// The bounding sphere of the document: the scale of handles and speeds. Its radius is not 0.
    SceneBounds bounds() const;

    /// The up direction of a scene of several models, which the camera may not share. For models only.
    glm::dvec3 scene_up() const { return model().scene_up().value_or(camera.up); }

    /// Moves the camera, but does not turn it, so that the whole document, with a ground its shadow too, is in the
    /// middle of a rectangle of the picture. O(positions).
    void fit(const FreeArea& area);
    /// Whether fit() frames a shadow too.
    bool frames_shadow() const {
        return document_.model() != nullptr && appearance.ground && appearance.shadows;
    }
    /// Moves the camera by as little as is needed for the whole document to be within the area, with the margin of
    /// fit(). It never comes nearer, so that nothing pumps while the camera turns. O(positions).
    void keep_whole(const FreeArea& area);
    /// The camera of the window's picture. It is `camera`, unless the picture was given: then, until fit(), it has the
    /// eye and direction of `camera`, and all of the given picture is in the middle of the area.
    Camera shown_camera(const FreeArea& area) const;
    /// The point in the middle of the area that is as far from the eye as the target.
    glm::dvec3 middle_of(const FreeArea& area) const;
    /// Turns the camera about the document's center so that it looks from this direction (towards the viewer,
    /// not zero), at most k_max_elevation_deg above or below the horizon.
    void look_from(const glm::dvec3& towards_viewer);
    /// The same for a camera that moves: the document keeps its place in the picture, and a sun that was chosen turns
    /// with the camera.
    void move_to(const glm::dvec3& towards_viewer);
    /// Whether all of the document is within the area. O(positions).
    bool is_whole(const FreeArea& area) const;
    /// The sun that is chosen for the camera (scene_lights.h) in place of all lights. For models only; about a
    /// tenth of a second for 100,000 faces.
    void choose_sun(double aspect);
    /// Whether the only light is a sun that was chosen: where the camera jumps, another one is to be chosen.
    bool has_chosen_sun() const;
    /// For a sun that the caller has chosen.
    void note_chosen_sun() { chosen_sun_ = lights.back().vector; }
    ViewEdit edit() const;
    /// Takes edit() back, but for the models, which must be loaded. Where a sun is chosen already, a chosen one is not
    /// restored.
    void restore(const ViewEdit& edit);
    /// Rounds camera and lights as options are parsed, so that command() draws the same picture.
    void round_to_options();
    /// The same of lights and of a frozen silhouette.
    void round_lights();
    /// Why no command line can say what is shown, and what to do instead; empty if one can.
    std::string command_obstacle() const;
    /// A command line that draws the picture without the window: of `render`, or of `points` for a cloud.
    /// command_obstacle() must be empty.
    std::string command(ImageSize size, const std::string& output) const;
    /// Applies appearance.fov_y_deg and appearance.orthographic to the camera. Objects at the target keep
    /// their size in the picture.
    void apply_lens();

    /// The lines stay those of the present camera while the camera moves.
    void freeze() { frozen_ = camera; }
    void thaw() noexcept { frozen_.reset(); }
    const std::optional<Camera>& frozen() const noexcept { return frozen_; }

    /// Adds a sun in a direction that no other light has.
    void add_light();
    /// One of several.
    void remove_light(std::size_t light);
    /// Whether scene() has a fill and a rim light.
    bool is_three_point() const {
        return appearance.three_point && lights.size() == 1 && lights[0].directional;
    }

    /// The viewpoint or direction of the lines' silhouette, in the coordinates of the document.
    HomogeneousPoint silhouette_point() const;

    /// The scene of the document. Valid until the session changes. Of a model whose silhouette is not frozen, a
    /// picture of `exact_size` has lines with exact visibility, as `render` draws them. They take longer; throws
    /// Error{cancelled}.
    ViewPicture picture(std::optional<ImageSize> exact_size = {}, const LongCall& call = {}) const;
    /// What is left to do with a picture that is saved, as `render` does it.
    PictureFinish finish() const {
        return {.is_mask = !is_cloud() && appearance.style == Style::mask};
    }
    ViewSight sight() const;
    /// For models only. A ground is under the model by the scene's up direction, or the camera's.
    Scene scene() const;
    /// What a scene file says of the session; `size` is that of its picture. With what the scene file that was opened
    /// says beyond the options of the window, unless `render` refuses it beside the rest. For models only.
    WrittenScene written_scene(ImageSize size) const;
    /// For clouds only. Moves the cloud's silhouette to silhouette_point().
    SplatScene cloud_scene() const;

private:
    // With a margin, within the area: in its middle, or moved as little as possible. Steps back where it is too large.
    enum class Place { middle, nearest };
    void bring_into(const FreeArea& area, Place place);
    std::string cloud_command(ImageSize size, const std::string& output) const;
    glm::dvec3 level_direction(const glm::dvec3& towards_viewer) const;

    Document document_;
    Document previous_;
    std::optional<Camera> frozen_;
    std::optional<glm::dvec3> chosen_sun_;
    std::optional<double> frame_aspect_;  // Of the picture that was given, until fit().
    struct KeptScene {
        nlohmann::ordered_json cameras = nlohmann::ordered_json::object();
        nlohmann::ordered_json picture = nlohmann::ordered_json::object();
        Style style{};  // Of the file: its palette belongs to it.
    };
    KeptScene kept_;  // Of the scene file that was opened.
};

}  // namespace rimline::tools
