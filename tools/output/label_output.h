#pragma once

// A point cloud with what was found about each point, as a PLY file that any viewer of clouds opens:
//
//   double x y z             as the file has them
//   float nx ny nz           of the umbrella, turned as the file's own where it has normals; 0 where there
//                            is none
//   uchar red green blue     the file's own, or by label: orange border, gray interior, blue feature, red
//                            undecided
//   uchar label              0 border, 1 interior, 2 feature, 3 undecided
//   uchar reason             why it is undecided: UndecidedReason
//   float weight             of features, in [0, 1]
//   uchar silhouette         1 on the silhouette
//   uint number              the point's in the file
//
// binary_little_endian, points in the file's order.

#include <span>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_surface.h"

namespace rimline::tools {

struct LabeledPoints {
    const PointCloud& cloud;
    const PointSurface& surface;
    std::span<const float> weights;       ///< One a point.
    std::span<const PointId> silhouette;  ///< Ascending.
};

/// The whole file.
std::string format_labels(const LabeledPoints& points);

/// What stands for a label in pictures and files.
PointColor label_color(PointLabel label);

/// The normal of a point, turned as the file's own; zero where there is none.
glm::dvec3 oriented_normal(const PointCloud& cloud, const PointSurface& surface, PointId point);

}  // namespace rimline::tools
