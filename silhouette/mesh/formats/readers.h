#pragma once

// The readers behind mesh_file.h, one for each format. Each gives all of a file or throws
// Error{bad_input}; whether a file without faces will do is decided by mesh_file.cpp.

#include <cstdint>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

MeshSource read_ply(const SourceFile& file, const LongCall& call);
MeshSource read_stl_text(const SourceFile& file, const LongCall& call);
MeshSource read_stl_binary(const SourceFile& file, const LongCall& call);
MeshSource read_off(const SourceFile& file, const LongCall& call);
MeshSource read_obj(const SourceFile& file, const LongCall& call);
/// The JSON form; external buffers lie beside the file.
MeshSource read_gltf(const SourceFile& file, const LongCall& call);
MeshSource read_glb(const SourceFile& file, const LongCall& call);

/// The vertices a file may have: their numbers are 32 bits wide, with room for marks.
constexpr std::uint64_t k_max_file_vertices = 0xfffffff0u;

}  // namespace rimline
