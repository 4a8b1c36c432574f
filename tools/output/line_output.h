#pragma once

// Files of silhouettes: each edge once, with its faces.
//
//   .obj  `l` elements, each after a comment with its vertices and faces in the numbering of the model's file
//   .ply  an edge element: vertex1 vertex2 face1 face2 border
//   .svg  the edges projected from the point, hidden ones too, fitted to the view box, with data-faces
//
// If the edge has front and back faces, face1 is a front face and face2 a back face. Faces are numbered as
// triangles, from 0; a missing face is -1.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

enum class LineFormat { obj, ply, svg };

/// The format of the file name's ending, in upper or lower case. Throws UsageError for other endings.
LineFormat line_format_of(const std::string& file_name);

struct Lines {
    const Mesh& mesh;
    HomogeneousPoint point;              ///< The viewpoint or direction of the silhouette.
    std::span<const EdgeId> silhouette;  ///< In the order of the file.
    std::span<const EdgeId> borders;     ///< Written after the silhouette and marked; may be empty.
    std::string title;                   ///< One line, for the file's comment.
};

/// The content of the file.
std::string format_lines(const Lines& lines, LineFormat format);

}  // namespace rimline::tools
