// rimline silhouette: the silhouette from one point or along one direction.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "silhouette/hough/baselines/brute_force.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"
#include "tools/line_output.h"
#include "tools/model_argument.h"
#include "tools/option_types.h"
#include "tools/output_file.h"

namespace rimline::tools {

namespace {

constexpr std::array<std::string_view, 2> k_methods{"octree", "brute"};

struct Extraction {
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    double ms = 0.0;  // Without building the octree.
};

template <typename Extract>
void time_extraction(Extraction& result, Extract&& extract) {
    const auto start = std::chrono::steady_clock::now();
    extract();
    result.ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Extraction extract_by_brute_force(const Mesh& mesh, const HomogeneousPoint& point) {
    Extraction result;
    time_extraction(result, [&] { result.edges = brute_force_silhouette(mesh, point); });
    result.counters.face_checks = mesh.face_count();
    result.counters.edge_checks = mesh.edge_count();
    return result;
}

Extraction extract_by_octree(const Mesh& mesh, const HomogeneousPoint& point,
                             const std::optional<glm::vec3>& origin) {
    HoughOctreeOptions options;
    if (origin) options.origins.push_back(glm::dvec3(*origin));
    const HoughOctree octree(mesh, options);
    Extraction result;
    time_extraction(result, [&] { octree.extract(point, result.edges, result.counters); });
    return result;
}

// An edge as the file numbers its vertices, the lesser first.
struct FileEdge {
    std::array<std::uint32_t, 2> vertices;
    EdgeId edge;
};

std::vector<FileEdge> in_file_order(const Mesh& mesh, std::span<const EdgeId> edges) {
    std::vector<FileEdge> ordered;
    ordered.reserve(edges.size());
    for (const EdgeId edge : edges) {
        const std::uint32_t a = mesh.file_vertex(mesh.edge(edge).vertices[0]);
        const std::uint32_t b = mesh.file_vertex(mesh.edge(edge).vertices[1]);
        ordered.push_back({{std::min(a, b), std::max(a, b)}, edge});
    }
    std::sort(ordered.begin(), ordered.end(),
              [](const FileEdge& a, const FileEdge& b) { return a.vertices < b.vertices; });
    return ordered;
}

class SilhouetteCommand final : public Command {
public:
    std::string name() const override { return "silhouette"; }
    std::string summary() const override { return "Find the silhouette from a point or direction"; }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        add_point(app, "--from", from_, "Seen from this point")->group("View");
        add_direction(app, "--direction", direction_,
                      "Seen from infinitely far this way, from the model towards the viewer")
            ->group("View");
        app.add_option_function<std::string>(
               "--method", [this](const std::string& text) { set_method(text); },
               "octree (built, then asked) or brute (every face and edge)")
            ->type_name("NAME")
            ->default_str(method_)
            ->group("Method");
        add_points(app, "--origin", origins_,
                   "Hough origin of the octree (default: the model's center)")
            ->group("Method");
        app.add_option("-o,--output", output_,
                       "Write the lines with their faces: FILE.obj, .ply or .svg")
            ->type_name("FILE")
            ->group("Output");
        app.add_flag("--borders", with_borders_, "Write border edges too, marked as such")
            ->group("Output");
        app.add_flag("--no-edges", without_edges_, "Leave the list of edges out of the JSON")
            ->group("Output");
        app.footer(
            "Exactly one of --from and --direction is needed. Edges are pairs of vertex numbers of "
            "the\n"
            "file, from 0. In an SVG hidden lines are drawn too.\n\n"
            "Examples:\n"
            "  rimline silhouette bunny.obj --from 0.3,0.4,0.5 --json\n"
            "  rimline silhouette shape:knot --direction 1,0.5,1 -o knot.svg");
    }

    ExitStatus run(const Context& context) override {
        const HomogeneousPoint point = point_from_options();
        std::optional<OutputFile> file;
        LineFormat format{};
        if (!output_.empty()) {
            format = line_format_of(output_);
            file.emplace(output_);
        }

        const Mesh mesh = model_.load_mesh(context);
        const std::optional<glm::vec3> origin =
            origins_.empty() ? std::nullopt : std::optional(origins_[0]);
        const Extraction found = about_model(model_.model, [&] {
            return method_ == "brute" ? extract_by_brute_force(mesh, point)
                                      : extract_by_octree(mesh, point, origin);
        });
        context.checkpoint();

        const std::vector<FileEdge> edges = in_file_order(mesh, found.edges);
        if (file) {
            file->write(format_lines(mesh, point, edges, format));
            file->commit();
        }
        if (context.json)
            print_result(mesh, found, edges);
        else
            print_summary(mesh, found);
        return ExitStatus::success;
    }

private:
    void set_method(const std::string& text) {
        if (std::find(k_methods.begin(), k_methods.end(), text) == k_methods.end())
            throw CLI::ValidationError("--method", "expected octree or brute, not '" + text + "'");
        method_ = text;
    }

    HomogeneousPoint point_from_options() const {
        if (from_.has_value() == direction_.has_value())
            throw UsageError("exactly one of --from and --direction is needed");
        if (origins_.size() > 1)
            throw UsageError("--origin: octrees of several origins are not built; give one");
        return from_ ? HomogeneousPoint::viewpoint(*from_)
                     : HomogeneousPoint::direction(*direction_);
    }

    std::string format_lines(const Mesh& mesh, const HomogeneousPoint& point,
                             const std::vector<FileEdge>& edges, LineFormat format) const {
        std::vector<EdgeId> silhouette;
        for (const FileEdge& e : edges) silhouette.push_back(e.edge);
        std::vector<EdgeId> borders;
        const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::border);
        if (with_borders_)
            for (std::uint32_t e = range.first; e < range.last; ++e) borders.push_back(EdgeId{e});
        std::array<char, 128> seen{};
        std::snprintf(seen.data(), seen.size(), " %s %.9g,%.9g,%.9g",
                      point.is_direction() ? "along" : "from", double{point.x}, double{point.y},
                      double{point.z});
        std::string title = "Silhouette of " + model_.model + seen.data();
        std::replace_if(
            title.begin(), title.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        return tools::format_lines({mesh, point, silhouette, borders, title}, format);
    }

    void print_result(const Mesh& mesh, const Extraction& found,
                      const std::vector<FileEdge>& edges) const {
        nlohmann::ordered_json result{{"model", model_.model},
                                      {"method", method_},
                                      {"vertices", mesh.vertex_count()},
                                      {"faces", mesh.face_count()},
                                      {"count", edges.size()},
                                      {"borders", mesh.edges_of_class(EdgeClass::border).size()},
                                      {"counters",
                                       {{"box_checks", found.counters.box_checks},
                                        {"face_checks", found.counters.face_checks},
                                        {"edge_checks", found.counters.edge_checks}}},
                                      {"ms", found.ms}};
        if (!output_.empty()) result["output"] = output_;
        if (!without_edges_) {
            nlohmann::ordered_json& list = result["edges"] = nlohmann::ordered_json::array();
            for (const FileEdge& e : edges) list.push_back(e.vertices);
        }
        print_json(result);
    }

    void print_summary(const Mesh& mesh, const Extraction& found) const {
        std::printf("%zu silhouette edges of %u, and %u borders\n", found.edges.size(),
                    mesh.edge_count(), mesh.edges_of_class(EdgeClass::border).size());
        std::printf("  %s: %.3f ms, %llu box, %llu face and %llu edge checks\n", method_.c_str(),
                    found.ms, static_cast<unsigned long long>(found.counters.box_checks),
                    static_cast<unsigned long long>(found.counters.face_checks),
                    static_cast<unsigned long long>(found.counters.edge_checks));
        if (!output_.empty()) std::printf("  written to %s\n", output_.c_str());
    }

    ModelArgument model_;
    std::optional<glm::vec3> from_;
    std::optional<glm::vec3> direction_;
    std::string method_ = "octree";
    std::vector<glm::vec3> origins_;
    std::string output_;
    bool with_borders_ = false;
    bool without_edges_ = false;
};

}  // namespace

std::unique_ptr<Command> make_silhouette_command() { return std::make_unique<SilhouetteCommand>(); }

}  // namespace rimline::tools
