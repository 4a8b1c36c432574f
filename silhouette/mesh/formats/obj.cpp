// OBJ: obj_scan.h checks the file, tinyobjloader parses its faces, triangulate.h triangulates them.
//
// The triangulation of tinyobjloader is not used, because it loses or damages concave polygons. Its
// materials are not used: `mtllib` opens no file. Lines and points are checked, but a mesh has
// none.

#include <tiny_obj_loader.h>

#include <istream>
#include <streambuf>
#include <utility>

#include "silhouette/mesh/formats/obj_scan.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/triangulate.h"

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

struct FaceReader {
    const LongCall& call;
    const TextBuffer& text;
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
    }
};

}  // namespace

MeshSource read_obj(const SourceFile& file, const LongCall& call) {
    ObjScan scan = scan_obj(file, call);
    MeshSource source;
    source.positions = std::move(scan.positions);
    source.triangles.reserve(scan.corner_count - 2 * scan.face_count);

    TextBuffer buffer(scan.statements);
    std::istream stream(&buffer);
    FaceReader reader{call, buffer, source, 0, 0, 0, {}, Triangulator(call.stop)};
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
    return source;
}

}  // namespace rimline
