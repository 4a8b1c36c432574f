#pragma once

// The readers behind mesh_file.h and point_file.h, one for each format. Each gives all of a file or throws
// Error{bad_input}; whether a file without faces or points will do is decided there.

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
// What these keep of a mesh with points that are not finite is no mesh: faces may be missing.
MeshSource read_stl_text(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_stl_binary(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_off(const SourceFile& file, BadPoints bad, const LongCall& call);
/// The JSON form; external buffers lie beside the file.
MeshSource read_gltf(const SourceFile& file, BadPoints bad, const LongCall& call);
MeshSource read_glb(const SourceFile& file, BadPoints bad, const LongCall& call);

/// By whichever of these it takes. Bad points are refused but by those that are asked.
MeshSource read_mesh(const KnownFile& known, BadPoints bad, const LongCall& call);

/// Points in double precision; `triangles` is left empty and `has_faces` says whether there are any.
struct PointRecords {
    PointSource source;
    bool has_faces = false;
};
PointRecords read_ply_points(const SourceFile& file, BadPoints bad, const LongCall& call);
PointRecords read_obj_points(const SourceFile& file, BadPoints bad, const LongCall& call);
PointRecords read_point_text(const SourceFile& file, BadPoints bad, const LongCall& call);

/// Why point `number` cannot be used; empty where it can, or where it is not finite and `bad` keeps it.
std::string refusal(std::uint64_t number, const glm::dvec3& position, BadPoints bad);
/// A share of 255 as a byte; NaN is 0.
std::uint8_t color_byte(float value) noexcept;
/// Colors that a file gives as numbers: as shares of 1, or of 255 where one is above 1.
std::vector<PointColor> point_colors(const std::vector<glm::vec3>& numbers);

/// The vertices a file may have: their numbers are 32 bits wide, with room for marks.
constexpr std::uint64_t k_max_file_vertices = 0xfffffff0u;

}  // namespace rimline
