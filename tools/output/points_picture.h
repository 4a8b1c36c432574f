#pragma once

// Pictures of a point cloud and what was found about it.
//
//   drawn     discs, darker the more a point weighs; borders in a color of their own; the silhouette's
//             consensus edges as ink
//   compare   six pictures: points that are not hidden alone, the same with silhouettes and features;
//             silhouette points by thresholding normals (Zakaria and Seidel 2004), as many as ours, and ours;
//             discs with normals of principal components and with ours

#include <optional>
#include <span>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/options/picture_options.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

enum class PointsMode { drawn, compare };

struct PointsPicture {
    const std::string& name;  ///< Of the cloud, for messages.
    const PointCloud& cloud;
    const PointSurface& surface;
    const UmbrellaIndex& umbrellas;
    std::span<const float> weights;
    std::uint32_t k;  ///< Neighbors for the comparison's normals.
    PointsMode mode;
    /// Where the camera stands and looks, in the cloud's own coordinates; chosen where not given.
    std::optional<glm::dvec3> eye, target;
    /// Of umbrellas; the camera's where not given.
    std::optional<HomogeneousPoint> silhouette_point;
    /// For the rest of the camera, the image and the machine.
    const PictureOptions& options;
};

struct PointsPictureReport {
    HomogeneousPoint silhouette_point;  ///< Whose silhouette was drawn.
    std::string device, driver;
    std::optional<std::uint32_t> validation_messages;
    double ms = 0.0;  ///< Of the drawing alone.
};

/// Draws and writes it. Throws Error.
PointsPictureReport draw_points(const PointsPicture& picture, OutputFile& file);

}  // namespace rimline::tools
