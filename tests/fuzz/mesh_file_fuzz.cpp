// A file of one format (RIMLINE_FUZZ_ENDING): either it is read and what is read is a mesh, or there is a message.
// What is read as a mesh and what is read as a cloud have the same points and faces.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/formats/point_file.h"
#include "silhouette/mesh/mesh.h"
#include "tests/fuzz/fuzz_input.h"

using namespace rimline;

namespace {

const std::string k_ending = RIMLINE_FUZZ_ENDING;
const std::string k_name = "fuzz" + k_ending;

template <typename Read>
auto read_or_message(Read&& read) -> std::optional<decltype(read())> {
    try {
        return read();
    } catch (const Error& error) {
        fuzz::require_message(error.what(), k_name);
        return std::nullopt;
    }
}

void check_mesh(const MeshSource& source) {
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t corner : triangle)
            fuzz::require(corner < source.positions.size(), "a corner without a position");
    for (const glm::vec3& position : source.positions)
        fuzz::require(HomogeneousPoint::is_valid(position), "a position out of range");
    const FaceMaterials& materials = source.materials;
    fuzz::require(materials.of_face.empty() || materials.of_face.size() == source.triangles.size(),
                  "materials of other faces");
    for (const MaterialId material : materials.of_face)
        fuzz::require(material == k_no_material || index(material) < materials.materials.size(),
                      "a face without its material");
    for (const std::string& warning : source.warnings) fuzz::require_message(warning, "");
    (void)Mesh(source).radius();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const auto mesh = read_or_message(
        [&] { return read_mesh_bytes(k_name, bytes, k_ending, FaceRequirement::faces_or_points); });
    if (mesh) check_mesh(*mesh);
    const auto points =
        read_or_message([&] { return read_point_bytes(k_name, bytes, k_ending, BadPoints::keep); });
    if (mesh && points) {
        fuzz::require(points->positions.size() == mesh->positions.size(),
                      "other points as a cloud");
        fuzz::require(points->triangles.size() == mesh->triangles.size(), "other faces as a cloud");
    }
    return 0;
}
