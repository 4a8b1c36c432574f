#pragma once

// rimline.Mesh and Silhouette.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>

#include "tools/bindings/bound_mesh.h"

namespace rimline::python {

using tools::BoundMesh;
using tools::SharedMesh;

/// Throws TypeError naming `mesh` for anything but a rimline.Mesh.
SharedMesh mesh_of(const pybind11::object& mesh);

/// The numbers of the file of an edge's vertices, N x 2.
pybind11::array edge_vertices(const Mesh& mesh, std::span<const EdgeId> edges);

void bind_mesh(pybind11::module_& module);

}  // namespace rimline::python
