#include "silhouette/mesh/formats/mesh_file.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/file_format.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/lost_shape.h"

namespace rimline {

namespace {

MeshSource read_format(const KnownFile& known, BadPoints bad, const LongCall& call) {
    const SourceFile& file = known.file;
    switch (known.format) {
        case FileFormat::ply: return read_ply(file, call);
        case FileFormat::stl_text: return read_stl_text(file, bad, call);
        case FileFormat::stl_binary: return read_stl_binary(file, bad, call);
        case FileFormat::off: return read_off(file, bad, call);
        case FileFormat::obj: return read_obj(file, call);
        case FileFormat::gltf: return read_gltf(file, bad, call);
        case FileFormat::glb: return read_glb(file, bad, call);
        case FileFormat::point_text: break;
    }
    return read_point_text_as_mesh(file, call);
}

}  // namespace

std::string lost_shape_warning(const std::string& name, const MeshSource& source) {
    if (source.positions.empty()) return {};
    glm::vec3 low(source.positions.front()), high(low);
    for (const glm::vec3& position : source.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const double distance = glm::length(0.5 * (glm::dvec3(low) + glm::dvec3(high)));
    if (!floats_lose_shape(detail_size(source.positions, source.triangles), distance)) return {};
    return name +
           ": lies so far from the origin that single precision loses its shape; subtract an "
           "offset from its coordinates";
}

MeshSource read_mesh(const KnownFile& known, BadPoints bad, const LongCall& call) {
    MeshSource source = read_format(known, bad, call);
    for (const MaterialTexture& texture : source.materials.textures)
        if (!texture.path.empty()) source.files.push_back(texture.path);
    return source;
}

namespace {

MeshSource checked_mesh(const KnownFile& known, FaceRequirement requirement, const LongCall& call) {
    const SourceFile& file = known.file;
    MeshSource source = read_mesh(known, BadPoints::refuse, call);
    if (source.triangles.empty() && requirement == FaceRequirement::faces)
        bad_file(file.name, "no faces: it holds " +
                                (source.positions.empty()
                                     ? std::string("nothing")
                                     : std::to_string(source.positions.size()) + " points only") +
                                "; a model with faces is needed");
    if (source.positions.empty()) bad_file(file.name, "no points: there is nothing in it");
    drop_unused_materials(source);
    if (!source.triangles.empty()) {
        const std::string warning = lost_shape_warning(file.name, source);
        if (!warning.empty()) add_warning(source.warnings, warning);
    }
    call.checkpoint(1.0);
    return source;
}

}  // namespace

MeshSource read_mesh_file(const std::filesystem::path& path, FaceRequirement requirement,
                          const LongCall& call) {
    try {
        call.checkpoint(0.0);
        return checked_mesh(KnownFile(path, call), requirement, call);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large,
                    path.string() + ": there is not enough memory to read it");
    }
}

MeshSource read_mesh_bytes(std::string name, std::string bytes, const std::string& extension,
                           FaceRequirement requirement, const LongCall& call) {
    try {
        call.checkpoint(0.0);
        return checked_mesh(known_bytes(name, std::move(bytes), extension), requirement, call);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large, name + ": there is not enough memory to read it");
    }
}

}  // namespace rimline
