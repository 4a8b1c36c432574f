#pragma once

// What the window shows, apart from windows: the model or the cloud, the camera, the lights, the look, and
// the silhouette when it is frozen. Everything that hands and panels change is here, and picture() is what
// is drawn of it.

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "engine/clouds/splat_renderer.h"
#include "engine/scene.h"
#include "tools/options/option_types.h"
#include "tools/view/document.h"

namespace rimline::tools {

struct ViewLook {
    /// As the style is drawn where nobody says otherwise.
    explicit ViewLook(Style chosen = Style::ink) { set_style(chosen); }
    /// Another style, with its own colors, width and creases.
    void set_style(Style chosen);

    Style style = Style::ink;
    glm::vec3 background{1.0f};  ///< Linear light, as those below.
    /// Of the model's surfaces and of its lines; where there are none, the style's own.
    std::optional<glm::vec3> color, line_color;
    bool lines = true;
    float line_width_px = 2.5f;
    bool hidden = false;            ///< Lines that something hides are drawn, dashed.
    float crease_angle_deg = 0.0f;  ///< Over 0: edges that bend by at least this are lines too.
    bool shadows = true;
    ShadowMethod shadow_method = ShadowMethod::automatic;  ///< Pictures are the same.
    bool ground = false;
    double fov_y_deg = 35.0;
    bool orthographic = false;
};

/// Of a model, and of a cloud.
using ViewPicture = std::variant<Scene, SplatScene>;

class ViewSession {
public:
    ViewLook look;
    Camera camera;
    std::vector<Light> lights;

    /// Shows another model or cloud, wholly in view, a model lit by a sun; the look stays, the silhouette thaws.
    /// What was shown before is kept until forget_previous(), for frames in flight know it by its address.
    void show(Document opened, double aspect);
    /// The same with a camera and lights that were chosen already; the look is taken to fit them.
    void show(Document opened, const Camera& chosen, std::vector<Light> chosen_lights);
    /// Goes back to what was shown before, where there is something: the device could not hold the new one.
    bool show_previous(double aspect);
    /// A frame of the new one has been drawn.
    void forget_previous() noexcept { previous_ = {}; }

    bool is_empty() const noexcept { return !opened_; }
    const Document& opened() const noexcept { return opened_; }
    /// Where it is shown.
    bool is_cloud() const noexcept { return opened_.cloud() != nullptr; }
    const ModelDocument& model() const noexcept { return *opened_.model(); }
    const CloudDocument& cloud() const noexcept { return *opened_.cloud(); }
    /// The sphere around what is shown, which handles and speeds are measured by.
    SceneBounds bounds() const;

    /// Looks at the whole of it from where the camera stands.
    void fit(double aspect);
    /// Brings the camera in line with look.fov_y_deg and look.orthographic: what lies at the target
    /// keeps its size.
    void apply_lens();

    /// From here on the lines stay those of where the camera is now; the camera goes on.
    void freeze() { frozen_ = camera; }
    /// The same with the lines of another camera.
    void freeze_at(const Camera& from) { frozen_ = from; }
    void thaw() noexcept { frozen_.reset(); }
    const std::optional<Camera>& frozen() const noexcept { return frozen_; }

    /// Another sun, from the side where no light is yet.
    void add_light();
    void remove_light(std::size_t light);

    /// Where the lines' silhouette is seen from, in the coordinates of what is shown.
    HomogeneousPoint silhouette_point() const;

    /// Valid until the session changes. The one of what is shown.
    ViewPicture picture() const;
    Scene scene() const;
    /// Moves the cloud's silhouette to silhouette_point().
    SplatScene cloud_scene() const;

private:
    Document opened_;
    Document previous_;
    std::optional<Camera> frozen_;
};

}  // namespace rimline::tools
