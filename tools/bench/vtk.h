#pragma once

// VTK's vtkPolyDataSilhouette at the same points (vtk_silhouette.py), in a Python with VTK 9: the
// alternative of users of visualization libraries. It tests every edge at every point.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

struct VtkResult {
    std::string skipped{};  ///< The reason why there are no times; else empty.
    std::string version;
    std::vector<double> us;  ///< One a point: the filter's update alone, the least of the rounds.
    double mean_lines = 0.0;
};

/// `points` must be viewpoints. Slow: another program reads the whole mesh. Throws Error{cancelled}.
VtkResult time_vtk(const Mesh& mesh, std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                   const Context& context);

}  // namespace rimline::tools
