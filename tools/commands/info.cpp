// rimline info: the content of a model.

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/formats/point_file.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/points/neighbor_lists.h"
#include "silhouette/points/point_cloud.h"
#include "tools/command.h"
#include "tools/options/exact_text.h"
#include "tools/options/model_argument.h"
#include "tools/options/standard_input.h"
#include "tools/options/up_option.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// Position and size of a model. For a file without faces: as if all points were vertices of faces.
struct Extent {
    std::uint32_t vertices;
    glm::dvec3 center;
    double radius;
    glm::dvec3 low, high;
};

Extent extent_of(const Mesh& mesh) {
    return {mesh.vertex_count(), mesh.center(), mesh.radius(), glm::dvec3(mesh.bounds().low),
            glm::dvec3(mesh.bounds().high)};
}

// In double: surveys lie far from the origin of their coordinates.
Extent extent_of(const PointCloud& cloud) {
    if (cloud.size() == 0) return {};
    Extent extent{cloud.size(), cloud.center(), cloud.radius(), cloud.positions()[0],
                  cloud.positions()[0]};
    for (const glm::dvec3& p : cloud.positions()) {
        extent.low = glm::min(extent.low, p);
        extent.high = glm::max(extent.high, p);
    }
    return extent;
}

template <typename Vector>
std::array<double, 3> list(const Vector& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

// Whether all corners of each face have one color.
bool has_face_colors(const FaceMaterials& materials) {
    const std::vector<glm::vec3>& colors = materials.corner_colors;
    for (std::size_t corner = 0; corner < colors.size(); ++corner)
        if (colors[corner] != colors[corner - corner % 3]) return false;
    return true;
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

// What a file of points has.
struct CloudFacts {
    Extent extent;
    std::optional<double> spacing;  // The median distance of a point to its nearest.
    bool has_normals, has_colors, has_intensities;
};

std::optional<double> median_spacing(const PointCloud& cloud, const LongCall& call) {
    if (cloud.size() < 2) return std::nullopt;
    const NeighborLists neighbors(cloud.positions(), 1, call);
    std::vector<double> distances;
    for (std::uint32_t p = 0; p < cloud.size(); ++p)
        distances.push_back(
            glm::distance(cloud.positions()[p], cloud.positions()[neighbors.of(p).front()]));
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

std::string place_text(const glm::dvec3& place, int digits) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.*g,%.*g,%.*g", digits, place.x, digits, place.y,
                  digits, place.z);
    return text.data();
}

void print_place(const std::string& center, double radius, const std::string& low,
                 const std::string& high) {
    std::printf("  center      %s\n", center.c_str());
    std::printf("  radius      %.9g\n", radius);
    std::printf("  bounds      %s to %s\n", low.c_str(), high.c_str());
}

void print_mesh_place(const Extent& extent) {
    print_place(place_text(extent.center, 9), extent.radius, vector_text(glm::vec3(extent.low)),
                vector_text(glm::vec3(extent.high)));
}

// Surveys lie far from the origin of their coordinates; floats need no more than 9 digits.
void print_cloud_place(const Extent& extent) {
    const bool are_floats = glm::dvec3(glm::vec3(extent.low)) == extent.low &&
                            glm::dvec3(glm::vec3(extent.high)) == extent.high;
    const int digits = are_floats ? 9 : 12;
    print_place(place_text(extent.center, digits), extent.radius, place_text(extent.low, digits),
                place_text(extent.high, digits));
}

// What the file says of the edges of its mesh; nothing if it says nothing.
std::optional<EdgeVisibilityCounts> edge_classes(const MeshSource& source, const Mesh& mesh) {
    if (source.edge_codes.empty()) return std::nullopt;
    return count_classes(edge_visibility_of_codes(mesh, source.edge_codes));
}

void print_summary(const std::string& model, const Mesh& mesh, const Extent& extent,
                   const ChosenUp& up, const std::optional<EdgeVisibilityCounts>& drawn) {
    const auto size_of = [&](EdgeClass c) { return mesh.edges_of_class(c).size(); };
    std::printf("%s\n", model.c_str());
    std::printf("  vertices    %u used, %u in the file\n", extent.vertices,
                mesh.file_vertex_count());
    std::printf("  faces       %u, %u of them degenerate\n", mesh.face_count(),
                mesh.degenerate_face_count());
    std::printf("  edges       %u: %u border, %u non-manifold, %u inconsistent\n",
                mesh.edge_count(), size_of(EdgeClass::border), size_of(EdgeClass::nonmanifold),
                size_of(EdgeClass::inconsistent));
    if (drawn)
        std::printf("  drawn       %u hard edges, %u silhouette edges; %u are hidden\n",
                    drawn->hard, drawn->silhouette, drawn->hidden);
    std::printf("  components  %u, %s, %s\n", mesh.component_count(),
                mesh.is_closed() ? "closed" : "open",
                mesh.is_oriented() ? "oriented" : "not oriented");
    print_mesh_place(extent);
    const char* const why = up.source == ChosenUp::Source::mesh     ? "along which the model stands"
                            : up.source == ChosenUp::Source::format ? "by the file's format"
                                                                    : "assumed";
    std::printf("  up          %s, %s\n", axis_name(up.up).c_str(), why);
    const UsedMaterials materials(mesh.materials());
    if (materials.count == 0) return;
    std::printf("  materials   %zu%s\n", materials.count,
                mesh.materials().corner_colors.empty() ? ""
                : has_face_colors(mesh.materials())    ? ", and colors of faces"
                                                       : ", and colors of vertices");
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
            "distinct points. A file without faces is a cloud; its JSON has `cloud`, with the "
            "spacing of its points.\n"
            "`center` is the center of their bounding box, `radius` their "
            "greatest distance\n"
            "from it.\n\n"
            "Examples:\n"
            "  rimline info bunny.obj\n"
            "  rimline info shape:torus:50000 --json");
    }

    ExitStatus run(const Context& context) override {
        std::optional<PointSource> points;
        MeshSource source = load(points, context);
        if (!source.materials.textures.empty()) check_pictures(source, context);
        std::optional<CloudFacts> cloud;
        if (points) cloud = cloud_facts(std::move(*points), context);
        const Mesh mesh = make_mesh(model_.model, source, context);
        const Extent extent = cloud ? cloud->extent : extent_of(mesh);
        const std::optional<EdgeVisibilityCounts> drawn = edge_classes(source, mesh);
        // Clouds stand on nothing.
        const ChosenUp up =
            cloud && !mesh.is_up_known() ? ChosenUp{} : choose_up(mesh, std::nullopt, false);
        context.times.end("measuring");
        if (!context.json) {
            if (cloud)
                print_cloud(mesh.file_vertex_count(), extent, *cloud);
            else
                print_summary(model_.model, mesh, extent, up, drawn);
            return ExitStatus::success;
        }
        const auto size_of = [&](EdgeClass c) { return mesh.edges_of_class(c).size(); };
        const UsedMaterials materials(mesh.materials());
        nlohmann::ordered_json cloud_json;
        if (cloud)
            cloud_json = {{"points", extent.vertices},
                          {"duplicates", mesh.file_vertex_count() - extent.vertices},
                          {"has_normals", cloud->has_normals},
                          {"has_colors", cloud->has_colors},
                          {"has_intensities", cloud->has_intensities},
                          {"spacing", nullptr}};
        if (cloud && cloud->spacing) cloud_json["spacing"] = *cloud->spacing;
        nlohmann::ordered_json drawn_json;
        if (drawn)
            drawn_json = {{"hidden", drawn->hidden},
                          {"silhouette", drawn->silhouette},
                          {"hard", drawn->hard}};
        print_json({{"model", model_.model},
                    {"cloud", std::move(cloud_json)},
                    {"vertices", extent.vertices},
                    {"file_vertices", mesh.file_vertex_count()},
                    {"faces", mesh.face_count()},
                    {"edges", mesh.edge_count()},
                    {"border_edges", size_of(EdgeClass::border)},
                    {"nonmanifold_edges", size_of(EdgeClass::nonmanifold)},
                    {"inconsistent_edges", size_of(EdgeClass::inconsistent)},
                    {"edge_visibility", std::move(drawn_json)},
                    {"degenerate_faces", mesh.degenerate_face_count()},
                    {"components", mesh.component_count()},
                    {"closed", mesh.is_closed()},
                    {"oriented", mesh.is_oriented()},
                    {"center", list(extent.center)},
                    {"radius", extent.radius},
                    {"bounds", {list(extent.low), list(extent.high)}},
                    {"up", list(up.up)},
                    {"up_from", up_source_name(up.source)},
                    {"materials", materials.count},
                    {"textures", materials.textures}});
        return ExitStatus::success;
    }

private:
    // `points`: of a model without faces, whose mesh leaves out much of a cloud.
    MeshSource load(std::optional<PointSource>& points, const Context& context) const {
        if (model_.model != k_standard_input) {
            MeshSource source = model_.load(context, FaceRequirement::faces_or_points);
            if (source.triangles.empty())
                points = follow_progress(context, [&](const BeginCall& begin) {
                    return read_point_file(model_.model, BadPoints::refuse,
                                           begin("reading " + model_.model));
                });
            return source;
        }
        MeshSource source = follow_progress(context, [&](const BeginCall& begin) {
            MeshOrCloud either =
                read_either_from_standard_input(model_.format, begin("reading standard input"));
            points = std::move(either.cloud);
            return subdivided(model_.model, std::move(either.mesh), model_.subdivide, begin);
        });
        for (const std::string& warning : source.warnings) print_warning(warning);
        return source;
    }

    // The warnings are of what other commands would draw or copy.
    void check_pictures(MeshSource& source, const Context& context) const {
        const std::size_t printed = source.warnings.size();  // load() has printed these.
        Progress progress(context, "reading the textures of " + model_.model);
        check_textures(source, progress.call());
        for (std::size_t i = printed; i < source.warnings.size(); ++i)
            print_warning(source.warnings[i]);
        context.times.end("reading textures");
    }

    CloudFacts cloud_facts(PointSource points, const Context& context) const {
        Progress progress(context, "measuring the distances of points");
        return about_model(model_.model, [&] {
            const PointCloud cloud(std::move(points));
            return CloudFacts{.extent = extent_of(cloud),
                              .spacing = median_spacing(cloud, progress.call()),
                              .has_normals = !cloud.normals().empty(),
                              .has_colors = !cloud.colors().empty(),
                              .has_intensities = !cloud.intensities().empty()};
        });
    }

    void print_cloud(std::uint32_t file_points, const Extent& extent,
                     const CloudFacts& cloud) const {
        std::printf("%s\n", model_.model.c_str());
        std::printf(
            "  a cloud     of points without faces: rimline points finds its borders and "
            "silhouettes\n");
        std::printf("  points      %u in the file, %u of them repeated\n", file_points,
                    file_points - extent.vertices);
        std::string has;
        for (const auto& [name, is_there] :
             {std::pair("normals", cloud.has_normals), std::pair("colors", cloud.has_colors),
              std::pair("intensities", cloud.has_intensities)})
            if (is_there) has += (has.empty() ? "" : ", ") + std::string(name);
        std::printf("  each has    %s\n", has.empty() ? "a position only" : has.c_str());
        if (cloud.spacing)
            std::printf("  spacing     %.9g, the median distance to the nearest point\n",
                        *cloud.spacing);
        print_cloud_place(extent);
    }

    ModelArgument model_;
};

}  // namespace

std::unique_ptr<Command> make_info_command() { return std::make_unique<InfoCommand>(); }

}  // namespace rimline::tools
