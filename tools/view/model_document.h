#pragma once

// A model as the window shows it: its mesh, the index over it, and the ground under it.

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "silhouette/hough/box_tree.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

/// Stays where it is: octrees know their meshes by address, and a renderer knows octrees by theirs.
class ModelDocument {
public:
    /// `name` is a file or shape:NAME[:FACES]. Takes as long as loading and indexing do; `begin` is told
    /// of the parts (model_argument.h). Throws Error naming the model; CLI::ValidationError where there
    /// is no such shape.
    ModelDocument(std::string name, std::uint32_t subdivide, const BeginCall& begin);
    /// The same of what was read already.
    ModelDocument(std::string name, const MeshSource& source, const BeginCall& begin);
    ModelDocument(const ModelDocument&) = delete;
    ModelDocument& operator=(const ModelDocument&) = delete;

    const std::string& name() const noexcept { return name_; }
    const Mesh& mesh() const noexcept { return mesh_; }
    const HoughOctree& octree() const noexcept { return octree_; }
    bool is_solid() const noexcept { return is_solid_; }
    /// The tree over the faces of the index's origin, to look at (silhouette/hough/box_walk.h).
    const BoxTree& face_tree() const noexcept { return face_tree_; }
    /// The ground when `up` is up, made when it is first asked for. It stays as long as the model.
    const HoughOctree& ground(const glm::dvec3& up);

private:
    struct Ground {
        Ground(const Mesh& model, const glm::dvec3& upwards);
        glm::dvec3 up;
        Mesh mesh;
        HoughOctree octree;
    };

    std::string name_;
    Mesh mesh_;
    HoughOctree octree_;
    bool is_solid_;
    BoxTree face_tree_;
    std::vector<std::unique_ptr<Ground>> grounds_;
};

}  // namespace rimline::tools
