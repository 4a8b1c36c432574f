#pragma once

// The headers that most programs need: a mesh file becomes a Mesh, a HoughOctree indexes the mesh, a
// SilhouetteTracker moves from point to point, and its ChangeSet says what changed.

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/mesh.h"
