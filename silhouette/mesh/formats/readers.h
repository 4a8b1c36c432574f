#pragma once

// The readers behind mesh_file.h and point_file.h, one per format. Each returns the whole content of a
// file or throws Error{bad_input}. mesh_file.h and point_file.h decide whether faces or points are
// required.

#include <cstdint>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/formats/file_format.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/mesh_source.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

MeshSource read_ply(const SourceFile& file, const LongCall& call);
MeshSource read_obj(const SourceFile& file, const LongCall& call);
MeshSource read_point_text_as_mesh(const SourceFile& file, const LongCall& call);
// With BadPoints::keep, faces of a file with positions that are not finite may be missing.
MeshSource read_stl_text(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_stl_binary(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_off(const SourceFile& file, BadPoints bad, const LongCall& call);
/// The JSON form. External buffers are in the file's folder.
MeshSource read_gltf(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_glb(const SourceFile& file, BadPoints bad, const LongCall& call);

/// Calls the reader of the file's format. Readers without the parameter `bad` always refuse bad points.
MeshSource read_mesh(const KnownFile& known, BadPoints bad, const LongCall& call);

/// Points in double precision. `triangles` stays empty. `has_faces` tells whether the file has faces.
struct PointRecords {
    PointSource source;
    bool has_faces = false;
};
PointRecords read_ply_points(const SourceFile& file, BadPoints bad, const LongCall& call);
PointRecords read_obj_points(const SourceFile& file, BadPoints bad, const LongCall& call);
PointRecords read_point_text(const SourceFile& file, BadPoints bad, const LongCall& call);

/// The reason why point `number` is refused. Empty if it is valid, or if it is not finite and `bad` is
/// keep.
std::string refusal(std::uint64_t number, const glm::dvec3& position, BadPoints bad);
/// A number in [0, 255] as a byte, rounded and clamped. NaN gives 0.
std::uint8_t color_byte(float value) noexcept;
/// Converts colors from numbers in [0, 1], or in [0, 255] if one is above 1.
std::vector<PointColor> point_colors(const std::vector<glm::vec3>& numbers);

/// Maximum number of vertices in a file. Numbers have 32 bits, and the highest values are reserved as
/// marks.
constexpr std::uint64_t k_max_file_vertices = 0xfffffff0u;

}  // namespace rimline
