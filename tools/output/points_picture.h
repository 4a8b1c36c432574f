#pragma once

// Pictures of a point cloud and its results.
//
//   drawn     discs or dots, darker with a higher feature weight; borders in their own color; consensus edges of
//             the silhouette as ink
//   features  discs or dots, with lines along creases and borders, each in its color; consensus edges as ink
//   compare   six pictures: visible points only, and the picture `drawn`; silhouette points by thresholding
//             normals (Zakaria and Seidel 2004), as many as ours, and ours; discs with normals of principal
//             components, and with ours. The last two have discs in either look, because their shade shows the normals

#include <optional>
#include <span>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/options/picture_options.h"
#include "tools/output/cloud_look.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

enum class PointsMode { drawn, features, compare };

struct PointsPicture {
    const std::string& name;  ///< The cloud's name, for messages.
    const PointCloud& cloud;
    const PointSurface& surface;
    const UmbrellaIndex& umbrellas;
    std::span<const float> weights;
    std::uint32_t k;  ///< Number of neighbors for normals of principal components.
    PointsMode mode;
    CloudLook look;
    /// Of the camera, in the cloud's coordinates. Not set: chosen.
    std::optional<glm::dvec3> eye, target;
    /// In the coordinates of `umbrellas`. Not set: that of the camera.
    std::optional<HomogeneousPoint> silhouette_point;
    /// The other options of camera, image and machine.
    const PictureOptions& options;
};

struct PointsPictureReport {
    HomogeneousPoint silhouette_point;  ///< Of the silhouette that was drawn.
    // The camera, in the cloud's coordinates. One of the last two is set.
    glm::dvec3 eye, target;
    std::optional<double> fov_deg, ortho_height;
    std::string device, driver;
    std::optional<std::uint32_t> validation_messages;
    double ms = 0.0;  ///< Drawing only.
};

/// Draws the picture and writes the file. Throws Error.
PointsPictureReport draw_points(const PointsPicture& picture, OutputFile& file);

}  // namespace rimline::tools
