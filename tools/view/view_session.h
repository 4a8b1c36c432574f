#pragma once

// What the window shows, apart from windows: the model, the camera, the lights, the look, and the
// silhouette when it is frozen. Everything that hands and panels change is here, and scene() is what is
// drawn of it.

#include <memory>
#include <optional>
#include <vector>

#include "engine/scene.h"
#include "tools/option_types.h"
#include "tools/view/opened_model.h"

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

class ViewSession {
public:
    ViewLook look;
    Camera camera;
    std::vector<Light> lights;

    /// Shows another model, wholly in view and lit by a sun; the look stays, the silhouette thaws. The
    /// model before is kept until forget_previous(), for frames in flight know it by its address.
    void show(std::unique_ptr<OpenedModel> model, double aspect);
    /// The same with a camera and lights that were chosen already; the look is taken to fit them.
    void show(std::unique_ptr<OpenedModel> model, const Camera& chosen,
              std::vector<Light> chosen_lights);
    /// Goes back to the model before, where there is one: the device could not hold the new one.
    bool show_previous(double aspect);
    /// A frame of the new model has been drawn.
    void forget_previous() noexcept { previous_.reset(); }

    bool has_model() const noexcept { return model_ != nullptr; }
    const OpenedModel& model() const noexcept { return *model_; }
    /// The sphere around the model, which handles and speeds are measured by.
    SceneBounds model_bounds() const;

    /// Looks at the whole model from where the camera stands.
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

    /// Where the lines' silhouette is seen from, in the model's coordinates.
    HomogeneousPoint silhouette_point() const;

    /// Valid until the session changes. A model must be shown.
    Scene scene() const;

private:
    std::unique_ptr<OpenedModel> model_;
    std::unique_ptr<OpenedModel> previous_;
    std::optional<Camera> frozen_;
};

}  // namespace rimline::tools
