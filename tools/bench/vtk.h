#pragma once

// VTK's vtkPolyDataSilhouette at the same points, by vtk_silhouette.py in a Python that has VTK 9: what
// a user of visualization libraries has instead. It tests every edge, each time.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

struct VtkResult {
    std::string skipped{};  ///< Why there are no times; empty where there are.
    std::string version;
    std::vector<double> us;  ///< By point, of the filter's update alone, the least of the rounds.
    double mean_lines = 0.0;
};

/// `points` must be viewpoints. Takes its time: another program reads the whole mesh. Throws
/// Error{cancelled}.
VtkResult time_vtk(const Mesh& mesh, std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                   const Context& context);

}  // namespace rimline::tools
