// rimline info: the content of a model.

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <tuple>

#include "silhouette/mesh/mesh.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

namespace {

// Position and size of a model. For a file without faces: as if all points were vertices of faces.
struct Extent {
    std::uint32_t vertices;
    glm::dvec3 center;
    double radius;
    Bounds bounds;
};

Extent extent_of(const Mesh& mesh) {
    return {mesh.vertex_count(), mesh.center(), mesh.radius(), mesh.bounds()};
}

Extent extent_of(std::vector<glm::vec3> points) {
    if (points.empty()) return {};
    const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    Extent extent{static_cast<std::uint32_t>(points.size()), {}, 0.0, {points[0], points[0]}};
    for (const glm::vec3& p : points) {
        extent.bounds.low = glm::min(extent.bounds.low, p);
        extent.bounds.high = glm::max(extent.bounds.high, p);
    }
    extent.center = 0.5 * (glm::dvec3(extent.bounds.low) + glm::dvec3(extent.bounds.high));
    for (const glm::vec3& p : points)
        extent.radius = std::max(extent.radius, glm::distance(glm::dvec3(p), extent.center));
    return extent;
}

template <typename Vector>
std::array<double, 3> list(const Vector& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

// The materials of faces, and the textures among them, named by their files, or by their place in the model's file.
struct UsedMaterials {
    std::size_t count = 0;
    std::vector<std::string> textures;

    explicit UsedMaterials(const FaceMaterials& materials) {
        std::vector<bool> is_used(materials.materials.size());
        for (const MaterialId material : materials.of_face)
            if (material != k_no_material) is_used[index(material)] = true;
        for (std::size_t m = 0; m < is_used.size(); ++m) {
            if (!is_used[m]) continue;
            ++count;
            const TextureId number = materials.materials[m].texture;
            if (number == k_no_texture || materials.corner_uvs.empty()) continue;
            const MaterialTexture& texture = materials.textures[index(number)];
            const std::string name = texture.path.empty() ? texture.place : texture.path.string();
            if (std::ranges::find(textures, name) == textures.end()) textures.push_back(name);
        }
    }
};

void print_summary(const std::string& model, const Mesh& mesh, const Extent& extent) {
    const auto size_of = [&](EdgeClass c) { return mesh.edges_of_class(c).size(); };
    std::printf("%s\n", model.c_str());
    std::printf("  vertices    %u used, %u in the file\n", extent.vertices,
                mesh.file_vertex_count());
    std::printf("  faces       %u, %u of them degenerate\n", mesh.face_count(),
                mesh.degenerate_face_count());
    std::printf("  edges       %u: %u border, %u non-manifold, %u inconsistent\n",
                mesh.edge_count(), size_of(EdgeClass::border), size_of(EdgeClass::nonmanifold),
                size_of(EdgeClass::inconsistent));
    std::printf("  components  %u, %s, %s\n", mesh.component_count(),
                mesh.is_closed() ? "closed" : "open",
                mesh.is_oriented() ? "oriented" : "not oriented");
    std::printf("  center      %.9g,%.9g,%.9g\n", extent.center.x, extent.center.y,
                extent.center.z);
    std::printf("  radius      %.9g\n", extent.radius);
    std::printf("  bounds      %.9g,%.9g,%.9g to %.9g,%.9g,%.9g\n", double{extent.bounds.low.x},
                double{extent.bounds.low.y}, double{extent.bounds.low.z},
                double{extent.bounds.high.x}, double{extent.bounds.high.y},
                double{extent.bounds.high.z});
    const UsedMaterials materials(mesh.materials());
    if (materials.count == 0) return;
    std::printf("  materials   %zu%s\n", materials.count,
                mesh.materials().corner_colors.empty() ? "" : ", and colors of vertices");
    for (const std::string& texture : materials.textures)
        std::printf("  texture     %s\n", texture.c_str());
}

class InfoCommand final : public Command {
public:
    std::string name() const override { return "info"; }
    std::string summary() const override { return "Show counts, topology and size of a model"; }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        app.footer(
            "`vertices` is the number of distinct positions that faces use; in a file without "
            "faces, of all\n"
            "distinct points. `center` is the center of their bounding box, `radius` their "
            "greatest distance\n"
            "from it.\n\n"
            "Examples:\n"
            "  rimline info bunny.obj\n"
            "  rimline info shape:torus:50000 --json");
    }

    ExitStatus run(const Context& context) override {
        const MeshSource source = model_.load(context, FaceRequirement::faces_or_points);
        const Mesh mesh = make_mesh(model_.model, source, context);
        const Extent extent =
            source.triangles.empty() ? extent_of(source.positions) : extent_of(mesh);
        if (!context.json) {
            print_summary(model_.model, mesh, extent);
            return ExitStatus::success;
        }
        const auto size_of = [&](EdgeClass c) { return mesh.edges_of_class(c).size(); };
        const UsedMaterials materials(mesh.materials());
        print_json({{"model", model_.model},
                    {"vertices", extent.vertices},
                    {"file_vertices", mesh.file_vertex_count()},
                    {"faces", mesh.face_count()},
                    {"edges", mesh.edge_count()},
                    {"border_edges", size_of(EdgeClass::border)},
                    {"nonmanifold_edges", size_of(EdgeClass::nonmanifold)},
                    {"inconsistent_edges", size_of(EdgeClass::inconsistent)},
                    {"degenerate_faces", mesh.degenerate_face_count()},
                    {"components", mesh.component_count()},
                    {"closed", mesh.is_closed()},
                    {"oriented", mesh.is_oriented()},
                    {"center", list(extent.center)},
                    {"radius", extent.radius},
                    {"bounds", {list(extent.bounds.low), list(extent.bounds.high)}},
                    {"up", mesh.up() == UpAxis::z ? "z" : "y"},
                    {"materials", materials.count},
                    {"textures", materials.textures}});
        return ExitStatus::success;
    }

private:
    ModelArgument model_;
};

}  // namespace

std::unique_ptr<Command> make_info_command() { return std::make_unique<InfoCommand>(); }

}  // namespace rimline::tools
