#include "tools/options/picture_scene.h"

#include "tools/command.h"

namespace rimline::tools {

glm::vec3 linear_from_srgb(const Color& color) {
    return linear_from_srgb(glm::vec3(float(color.red) / 255.0f, float(color.green) / 255.0f,
                                      float(color.blue) / 255.0f));
}

glm::dvec3 up_of(const Subject& subject, const PictureOptions& options) {
    if (options.up) return glm::dvec3(*options.up);
    return direction_of(subject.up);
}

Camera make_camera(const Subject& subject, const std::string& model,
                   const PictureOptions& options) {
    const glm::dvec3 up = up_of(subject, options);
    const double aspect = double(options.size.width) / options.size.height;
    Camera camera{.eye = {},
                  .target = {},
                  .up = up,
                  .fov_y_deg = options.fov_degrees,
                  .ortho_height = options.ortho_height.value_or(0.0)};
    if (options.eye) {
        camera.eye = glm::dvec3(*options.eye);
        camera.target = options.target ? glm::dvec3(*options.target) : subject.center;
        if (camera.eye == camera.target)
            throw UsageError(options.target ? "--eye and --target are the same point"
                                            : "--eye is the model's center, where it looks");
        return camera;
    }
    camera = fit_camera(camera, subject, default_view_of(model, up), aspect);
    if (options.target) {
        camera.eye += glm::dvec3(*options.target) - camera.target;
        camera.target = glm::dvec3(*options.target);
    }
    return camera;
}

SceneInstance ground_instance(const Scene& scene, const Mesh& mesh, const HoughOctree& octree) {
    return {.octree = &octree,
            .material = {.color = scene.style == Style::mask ? glm::vec3(1.0f)
                                                             : scene.palette.background},
            // On no background only the shadows are left of it.
            .has_surfaces = scene.has_background,
            .has_lines = false,
            .casts_shadows = false,
            .fade_radius = k_ground_fade * mesh.radius(),
            .fade_center = mesh.center()};
}

}  // namespace rimline::tools
