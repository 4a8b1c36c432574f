#pragma once

// The views of a drawing sheet, in third-angle projection: the view from above lies above the view from the front,
// the view from the right to its right.
//
//            top     iso
//    left    front   right   back
//            bottom

#include <cstdint>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"
#include "tools/options/line_camera.h"

namespace rimline::tools {

enum class SheetView : std::uint8_t { front, top, right, iso, left, bottom, back };

struct SheetCell {
    int column, row;  ///< From the left and from above. The front is (1, 1).
};
SheetCell cell_of(SheetView view) noexcept;

/// Adds --views. A name that is unknown or given twice is a usage error.
CLI::Option* add_sheet_views(CLI::App& app, std::vector<SheetView>& views);

/// An orthographic camera that looks at the model's center. The front is where viewers stand in front of the model,
/// at +z if y is up (ground_axes.h).
LineCamera sheet_camera(SheetView view, const Mesh& mesh, const glm::dvec3& up);

}  // namespace rimline::tools
