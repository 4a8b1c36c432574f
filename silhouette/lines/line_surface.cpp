#include "silhouette/lines/line_surface.h"

#include "silhouette/lines/line_geometry.h"

namespace rimline {

LineSurface::LineSurface(const Mesh& mesh, Contacts contacts, const LongCall& call) {
    RIMLINE_CHECK(mesh.is_welded());
    geometry_ = std::make_unique<const LineGeometry>(mesh, contacts == Contacts::found, call);
}

LineSurface::~LineSurface() = default;
LineSurface::LineSurface(LineSurface&&) noexcept = default;
LineSurface& LineSurface::operator=(LineSurface&&) noexcept = default;

const Mesh& LineSurface::mesh() const noexcept { return geometry_->mesh(); }

}  // namespace rimline
