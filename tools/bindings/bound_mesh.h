#pragma once

// A mesh as other languages hold it (tools/python, tools/c), with what is found for it once and shared by all that use
// it.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bindings/turns.h"

namespace rimline::tools {

/// A value that the first thread makes that needs it. Others wait, until their own call is stopped.
template <typename Value>
class MadeOnce {
public:
    template <typename Make>
    const Value& get(const LongCall& call, Make&& make) {
        if (const Value* const made = get_if_made()) return *made;
        const Turns::Turn turn(turns_, call);
        if (const Value* const made = get_if_made()) return *made;
        std::optional<Value> made(std::in_place, make());
        const std::lock_guard lock(mutex_);
        value_ = std::move(made);
        return *value_;
    }
    const Value* get_if_made() {
        const std::lock_guard lock(mutex_);
        return value_ ? &*value_ : nullptr;
    }

private:
    Turns turns_;
    std::mutex mutex_;  // Of the value.
    std::optional<Value> value_;
};

/// Objects of other languages share it, and end in any order.
using SharedMesh = std::shared_ptr<class BoundMesh>;

/// Any number of threads may use one.
class BoundMesh {
public:
    /// Takes the positions of `source`. Throws as Mesh, and Error{bad_input} for a mesh smaller than 2^-50.
    BoundMesh(std::string name, MeshSource source, Welding welding, const LongCall& call);

    const std::string& name() const noexcept { return name_; }
    const Mesh& mesh() const noexcept { return mesh_; }
    /// By the numbers of the file, with unused ones.
    const std::vector<glm::vec3>& positions() const noexcept { return positions_; }

    // Made when first needed.
    const HoughOctree& octree(const LongCall& call) {
        return octree_.get(call, [&] { return HoughOctree(mesh_, {}, call); });
    }
    const HoughOctree* octree_if_made() { return octree_.get_if_made(); }
    using Pair = std::array<std::uint32_t, 2>;
    /// The corners of each face, and the vertices of each edge, by the numbers of the file: of equal positions the
    /// first stands for all. And the first two faces of each edge, -1 for the second of a border.
    const std::vector<std::array<std::uint32_t, 3>>& faces();
    const std::vector<Pair>& edges();
    const std::vector<std::array<std::int64_t, 2>>& edge_faces();
    const LineSurface& line_surface(const LongCall& call) {
        return line_surface_.get(
            call, [&] { return LineSurface(mesh_, LineSurface::Contacts::found, call); });
    }

private:
    std::string name_;
    std::vector<glm::vec3> positions_;
    Mesh mesh_;
    MadeOnce<HoughOctree> octree_;
    MadeOnce<LineSurface> line_surface_;
    MadeOnce<std::vector<std::array<std::uint32_t, 3>>> faces_;
    MadeOnce<std::vector<Pair>> edges_;
    MadeOnce<std::vector<std::array<std::int64_t, 2>>> edge_faces_;
};

/// The same direction, with a length at which no component counts as zero beside another (k_min_point_component).
glm::dvec3 long_direction(const glm::dvec3& direction);

/// A file or built-in shape (model_argument.h), which must have faces. Adds to `warnings`. Throws Error naming it. The
/// message about a file of points ends with `advice_for_clouds`.
SharedMesh load_bound_mesh(const std::string& model, std::uint32_t subdivide, bool reads_textures,
                           const char* advice_for_clouds, std::vector<std::string>& warnings,
                           const LongCall& call);

}  // namespace rimline::tools
