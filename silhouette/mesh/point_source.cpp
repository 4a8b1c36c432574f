#include "silhouette/mesh/point_source.h"

#include <utility>

namespace rimline {

PointSource points_of(MeshSource mesh) {
    PointSource source;
    source.positions.assign(mesh.positions.begin(), mesh.positions.end());
    source.triangles = std::move(mesh.triangles);
    source.up = mesh.up;
    source.is_up_known = mesh.is_up_known;
    source.files = std::move(mesh.files);
    return source;
}

}  // namespace rimline
