#pragma once

// A point cloud with the results for each point, as a PLY file that any point cloud viewer can open:
//
//   double x y z             the coordinates of the file
//   float nx ny nz           normal of the umbrella, on the side of the file's normal if it has one; 0
//                            without umbrella
//   uchar red green blue     color of the file, or by label: orange border, gray interior, blue feature, red
//                            undecided
//   uchar label              0 border, 1 interior, 2 feature, 3 undecided
//   uchar reason             why the point is undecided: UndecidedReason, which a comment of the file lists
//   float weight             feature weight, in [0, 1]
//   uchar silhouette         1 if on the silhouette
//   uint number              number of the point in the file
//   float intensity          of the file, if it has any
//
// The format is binary_little_endian; points are in the order of the file.

#include <span>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_surface.h"

namespace rimline::tools {

struct LabeledPoints {
    const PointCloud& cloud;
    const PointSurface& surface;
    std::span<const float> weights;       ///< One per point.
    std::span<const PointId> silhouette;  ///< In ascending order.
};

/// The content of the file.
std::string format_labels(const LabeledPoints& points);

/// The color of a label in pictures and files.
PointColor label_color(PointLabel label);

/// The normal of a point, on the side of the file's normal. Zero if there is no normal.
glm::dvec3 oriented_normal(const PointCloud& cloud, const PointSurface& surface, PointId point);

}  // namespace rimline::tools
