#pragma once

// A silhouette as a file: each edge once, with the faces that make it one.
//
//   .obj  `l` elements, each after a comment with its vertices and faces as the model's file numbers them
//   .ply  an edge element: vertex1 vertex2 face1 face2 border
//   .svg  the edges as seen from the point, hidden ones too, fitted to the view, with data-faces
//
// face1 is a front face and face2 a back one where the edge's faces differ. Faces are numbered as
// triangles, from 0; a missing one is -1.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

enum class LineFormat { obj, ply, svg };

/// By the name's ending, in any case. Throws UsageError naming the three when it is none of them.
LineFormat line_format_of(const std::string& file_name);

struct Lines {
    const Mesh& mesh;
    HomogeneousPoint point;              ///< Where `edges` are seen from.
    std::span<const EdgeId> silhouette;  ///< In the order in which they are written.
    std::span<const EdgeId> borders;     ///< Written after them, marked; may be empty.
    std::string title;                   ///< Of one line, for the file's own comment.
};

/// The file's bytes.
std::string format_lines(const Lines& lines, LineFormat format);

}  // namespace rimline::tools
