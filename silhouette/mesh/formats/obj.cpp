// OBJ: obj_scan.h checks the file, tinyobjloader parses its faces, triangulate.h triangulates them.
//
// The triangulation of tinyobjloader is not used, because it loses or damages concave polygons. mtl.h reads the
// materials, because tinyobjloader reads a word for a number as 0. Lines and points are checked, but a mesh
// has none.

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <span>
#include <streambuf>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/mtl.h"
#include "silhouette/mesh/formats/obj_scan.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/triangulate.h"
#include "silhouette/srgb.h"

namespace rimline {

namespace {

// Reads from a string, which must outlive the buffer.
class TextBuffer : public std::streambuf {
public:
    explicit TextBuffer(const std::string& text) {
        char* begin = const_cast<char*>(text.data());  // The get area is never written to.
        setg(begin, begin, begin + text.size());
    }
    double share() const {
        return static_cast<double>(gptr() - eback()) / static_cast<double>(egptr() - eback());
    }
};

// The materials and texture coordinates of faces in their order.
class FaceMaterialReader {
public:
    // Without any color, there are no materials.
    FaceMaterialReader(const SourceFile& file, const ObjScan& scan, const LongCall& call,
                       MeshSource& source)
        : scan_(scan), source_(source) {
        if (scan.libraries.empty()) return;
        MaterialLibraries libraries =
            read_material_libraries(file, scan.libraries, call, source.warnings);
        source.files = std::move(libraries.files);
        for (const NamedLine& name : scan.material_names) {
            const LibraryMaterial* material = libraries.find(name.text);
            uses_.push_back(material ? add(*material) : Use());
            // A library that is missing has its own warning.
            if (!material && libraries.is_complete)
                add_warning(source.warnings, file.name + ":" + std::to_string(name.line) +
                                                 ": no material library has a material " +
                                                 excerpt(name.text));
        }
    }

    // Call it after the triangles of face `number`, counted from 0, were appended, with the vertices of its
    // corners, the first of which is `first_corner` of all faces.
    void end_face(std::uint64_t number, std::span<const std::uint32_t> polygon,
                  std::uint64_t first_corner) {
        FaceMaterials& materials = source_.materials;
        if (materials.materials.empty()) return;
        for (;
             next_ < scan_.material_uses.size() && scan_.material_uses[next_].first_face <= number;
             ++next_)
            current_ = uses_[scan_.material_uses[next_].name];
        const std::size_t first_triangle = materials.of_face.size();
        materials.of_face.resize(source_.triangles.size(), current_.material);
        if (materials.textures.empty()) return;
        materials.corner_uvs.resize(3 * source_.triangles.size(), glm::vec2(0.0f));
        if (current_.has_map) fill_uvs(first_triangle, polygon, first_corner);
    }

private:
    struct Use {
        MaterialId material = k_no_material;
        bool has_map = false;
        glm::vec2 scale{1.0f}, offset{0.0f};
    };

    Use add(const LibraryMaterial& material) {
        if (!material.color && !material.map) return {};
        FaceMaterials& materials = source_.materials;
        SurfaceMaterial added{material.color.value_or(glm::vec3(1.0f))};
        Use use{MaterialId{static_cast<std::uint32_t>(materials.materials.size())}};
        if (material.map) {
            // Exporters that mean the texture alone write Kd 0 0 0, too.
            if (added.base_color == glm::vec3(0.0f)) added.base_color = glm::vec3(1.0f);
            added.texture = TextureId{static_cast<std::uint32_t>(materials.textures.size())};
            materials.textures.push_back(material.map->texture);
            use.has_map = true;
            use.scale = material.map->scale;
            use.offset = material.map->offset;
        }
        materials.materials.push_back(added);
        return use;
    }

    void fill_uvs(std::size_t first_triangle, std::span<const std::uint32_t> polygon,
                  std::uint64_t first_corner) {
        // (vertex, corner) in order, so that the corner of a vertex is found in a polygon of any length. Where a
        // vertex occurs twice, its first corner counts.
        corners_.clear();
        for (std::uint32_t i = 0; i < polygon.size(); ++i) corners_.push_back({polygon[i], i});
        std::ranges::sort(corners_);
        for (std::size_t t = first_triangle; t < source_.triangles.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::pair<std::uint32_t, std::uint32_t> first{source_.triangles[t][c], 0};
                const auto corner = std::ranges::lower_bound(corners_, first);
                source_.materials.corner_uvs[3 * t + c] = uv_of(first_corner + corner->second);
            }
    }

    // From the left top corner of the picture.
    glm::vec2 uv_of(std::uint64_t corner) const {
        if (corner >= scan_.corner_uvs.size() || scan_.corner_uvs[corner] == ObjScan::k_no_uv)
            return glm::vec2(0.0f);
        const glm::vec2 uv = current_.scale * scan_.uvs[scan_.corner_uvs[corner]] + current_.offset;
        return finite_uv({uv.x, 1.0f - uv.y});
    }

    const ObjScan& scan_;
    MeshSource& source_;
    std::vector<Use> uses_;  // By index in ObjScan::material_names.
    std::size_t next_ = 0;
    Use current_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners_;
};

// Numbers in [0, 1], or in [0, 255] if one is above 1, as linear light. A missing color becomes white.
std::vector<glm::vec3> linear_colors(std::vector<glm::vec3> colors) {
    float largest = 0.0f;
    for (const glm::vec3& c : colors)
        for (int i = 0; i < 3; ++i)
            if (c[i] > largest) largest = c[i];
    const float scale = largest > 1.0f ? 1.0f / 255.0f : 1.0f;
    for (glm::vec3& c : colors)
        c = std::isnan(c.x) ? glm::vec3(1.0f) : linear_from_srgb(clamped_color(scale * c));
    return colors;
}

struct FaceReader {
    const LongCall& call;
    const TextBuffer& text;
    FaceMaterialReader& materials;
    MeshSource& source;
    std::uint64_t vertex_count = 0;
    std::uint64_t face_count = 0;
    std::uint64_t corner_count = 0;
    std::vector<std::uint32_t> polygon;
    Triangulator triangulator;

    // A negative index counts back from the last vertex. The scan has checked the range.
    void read_face(const tinyobj::index_t* corners, int count) {
        if (++face_count % k_checkpoint_interval == 0)
            parse_checkpoint(call, 0.5 + 0.5 * text.share());
        corner_count += static_cast<std::uint64_t>(count);
        polygon.clear();
        for (int i = 0; i < count; ++i) {
            const std::int64_t written = corners[i].vertex_index;
            const std::int64_t v =
                written < 0 ? static_cast<std::int64_t>(vertex_count) + written : written - 1;
            RIMLINE_CHECK(v >= 0 && static_cast<std::size_t>(v) < source.positions.size());
            polygon.push_back(static_cast<std::uint32_t>(v));
        }
        triangulator.triangulate(source.positions, polygon, source.triangles);
        materials.end_face(face_count - 1, polygon,
                           corner_count - static_cast<std::uint64_t>(count));
    }
};

}  // namespace

MeshSource read_obj(const SourceFile& file, const LongCall& call) {
    ObjScan scan = scan_obj(file, call);
    MeshSource source;
    source.positions = std::move(scan.positions);
    source.triangles.reserve(scan.corner_count - 2 * scan.face_count);

    FaceMaterialReader materials(file, scan, call, source);

    TextBuffer buffer(scan.statements);
    std::istream stream(&buffer);
    FaceReader reader{call, buffer, materials, source, 0, 0, 0, {}, Triangulator(call.stop)};
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* user, float, float, float, float) {
        ++static_cast<FaceReader*>(user)->vertex_count;
    };
    callback.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
        static_cast<FaceReader*>(user)->read_face(corners, count);
    };
    std::string warning;
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callback, &reader, nullptr, &warning, &error))
        bad_file(file.name, "tinyobjloader cannot read it: " + error);
    // The scan and tinyobjloader must agree.
    RIMLINE_CHECK(reader.vertex_count == source.positions.size());
    RIMLINE_CHECK(reader.face_count == scan.face_count);
    RIMLINE_CHECK(reader.corner_count == scan.corner_count);
    if (!scan.colors.empty()) {
        whiten_triangles(source);
        color_corners(source, linear_colors(std::move(scan.colors)));
    }
    return source;
}

}  // namespace rimline
