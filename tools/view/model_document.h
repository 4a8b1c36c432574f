#pragma once

// A model that the window shows: its mesh, the octree over it, and the ground under it.

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/hough/box_walk.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/placed_model.h"
#include "tools/output/shown_lines.h"
#include "tools/view/document_base.h"
#include "tools/view/reduced_model.h"

namespace rimline::tools {

/// Cannot be copied or moved: the octree refers to the mesh by its address, and a renderer refers to the
/// octree by its address.
class ModelDocument final : public DocumentBase {
public:
    /// Of the model `name`, which is read. `begin` is called before each part of the work (begin_call.h). Throws Error
    /// naming the model.
    ModelDocument(std::string name, const MeshSource& source, const BeginCall& begin);

    /// What a scene file says of the document: the models that are joined in it, by default the one of its
    /// name, and the scene's up direction, where it is not the camera's.
    const std::vector<PlacedModel>& models() const noexcept { return models_; }
    const std::optional<glm::dvec3>& scene_up() const noexcept { return scene_up_; }
    /// Whether a model is painted: its color is not that of the appearance.
    bool has_paint() const noexcept;
    void set_models(std::vector<PlacedModel> models, const std::optional<glm::dvec3>& up,
                    bool has_file_colors = true) {
        models_ = std::move(models);
        scene_up_ = up;
        has_file_colors_ = has_file_colors;
    }
    /// Whether models that are not painted have the colors of their files.
    bool has_file_colors() const noexcept { return has_file_colors_; }

    Subject subject() const override { return mesh_; }
    const Mesh& mesh() const noexcept { return mesh_; }
    const HoughOctree& octree() const noexcept { return octree_; }
    bool is_solid() const noexcept { return is_solid_; }
    /// Lines with exact visibility.
    ShownLines& lines() noexcept { return lines_; }
    const ShownLines& lines() const noexcept { return lines_; }
    /// The boxes of the octree's first origin, for display.
    const HoughBoxes& hough_boxes() const noexcept { return hough_boxes_; }
    /// What is drawn of it while something moves on a slow device; null until it is set.
    const ReducedModel* reduced() const noexcept { return reduced_.get(); }
    void set_reduced(std::unique_ptr<const ReducedModel> reduced) { reduced_ = std::move(reduced); }
    /// The ground for this up axis. Built at the first call; valid as long as the document.
    const HoughOctree& ground(const glm::dvec3& up);

private:
    struct Ground {
        Ground(const Mesh& model, const glm::dvec3& up_axis);
        glm::dvec3 up;
        Mesh mesh;
        HoughOctree octree;
    };

    std::vector<PlacedModel> models_;
    std::optional<glm::dvec3> scene_up_;
    bool has_file_colors_ = true;
    Mesh mesh_;
    HoughOctree octree_;
    bool is_solid_;
    ShownLines lines_;
    HoughBoxes hough_boxes_;
    std::unique_ptr<const ReducedModel> reduced_;
    std::vector<std::unique_ptr<Ground>> grounds_;
};

}  // namespace rimline::tools
