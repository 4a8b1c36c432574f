// rimline silhouette: the silhouette from one point or along one direction.

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/edge_convexity.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/printable_text.h"
#include "tools/absent_part.h"
#include "tools/command.h"
#include "tools/commands/method_choice.h"
#include "tools/nearest_name.h"
#include "tools/options/exact_text.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/output/line_output.h"
#include "tools/output/output_file.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

struct Extraction {
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    std::vector<NamedCount> own_counts;
    double ms = 0.0;               // Without the construction of the method.
    std::optional<double> recall;  // The share of the silhouette, for methods that are not exact.
};

Extraction extract_by(const SilhouetteMethodInfo& info, const Mesh& mesh,
                      const HomogeneousPoint& point, const SilhouetteMethodOptions& options) {
    const std::unique_ptr<SilhouetteMethod> method = make_method(info, mesh, options);
    Extraction result;
    const Stopwatch watch;
    method->extract(point, result.edges, result.counters);
    result.ms = watch.ms();
    result.own_counts = method->own_counts();
    if (!info.exact) {
        const std::size_t all = brute_force_silhouette(mesh, point).size();
        result.recall =
            all == 0 ? 1.0 : static_cast<double>(result.edges.size()) / static_cast<double>(all);
    }
    return result;
}

// "a, b or c": the methods for which `belongs` holds.
template <typename Belongs>
std::string method_names(Belongs&& belongs) {
    std::vector<std::string> names;
    for (const SilhouetteMethodInfo& info : silhouette_methods())
        if (belongs(info)) names.emplace_back(info.name);
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) list += i + 1 < names.size() ? ", " : " or ";
        list += names[i];
    }
    return list;
}

std::string method_table() {
    std::string table;
    std::string absent;
    for (const SilhouetteMethodInfo& info : silhouette_methods()) {
        std::string name(info.name);
        if (!is_in_build(info)) {
            absent += " " + name;
            continue;
        }
        name.resize(std::max<std::size_t>(name.size() + 1, 14), ' ');
        table += "  " + name + std::string(info.summary) + "\n";
    }
    if (!absent.empty()) table += "Not in this build:" + absent + "\n";
    return table;
}

// An edge with its vertices as the file numbers them, the lesser first.
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
               "How to find it; the methods are listed below")
            ->type_name("NAME")
            ->default_str(std::string(method_->name))
            ->group("Method");
        origin_option_ =
            add_points(app, "--origin", origins_,
                       "Origin of Hough or dual space (default: the model's center); give it "
                       "several times for several octrees, each of the faces it suits")
                ->group("Method");
        seed_option_ =
            add_count(app, "--seed", seed_, 0, 0xffffffffu, "Of a method's random numbers")
                ->group("Method");
        output_option_ =
            app.add_option(
                   "-o,--output", output_,
                   "Write the lines with their faces: FILE.obj, .ply or .svg; - is standard output")
                ->type_name("FILE")
                ->group("Output");
        as_option_ =
            app.add_option("--as", standard_format_, "Format of lines that go to standard output")
                ->check(CLI::IsMember({"obj", "ply", "svg"}))
                ->capture_default_str()
                ->group("Output");
        app.add_flag("--borders", with_borders_, "With -o, write border edges too, marked as such")
            ->group("Output");
        app.add_flag("--no-concave", without_concave_,
                     "Leave out strictly concave edges, which are never visible on a closed solid "
                     "seen from outside")
            ->group("Output");
        app.add_flag("--no-edges", without_edges_, "Leave the list of edges out of the JSON")
            ->group("Output");
        app.footer(
            "Exactly one of --from and --direction is needed. Edges are pairs of vertex numbers of "
            "the file, from 0,\n"
            "with --subdivide of the refined mesh. In an SVG hidden lines are drawn too: it is a "
            "picture of the data.\n"
            "rimline draw draws lines as they are seen.\n\n"
            "Methods:\n" +
            method_table() +
            "\n"
            "Examples:\n"
            "  rimline silhouette bunny.obj --from 0.3,0.4,0.5 --json\n"
            "  rimline silhouette shape:knot --direction 1,0.5,1 -o knot.svg");
    }

    ExitStatus run(const Context& context) override {
        const HomogeneousPoint point = point_from_options();
        check_method_options();
        if (as_option_->count() > 0 && output_ != k_standard_output)
            throw UsageError("--as: needs -o -, which is standard output");
        if (with_borders_ && output_option_->count() == 0)
            throw UsageError(
                "--borders: needs -o; the JSON has the number of border edges, not the edges");
        if (!is_in_build(*method_))
            require_methods("silhouette --method " + std::string(method_->name));
        std::optional<OutputFile> file;
        LineFormat format{};
        if (output_option_->count() > 0) {
            check_output(context, output_);
            format =
                line_format_of(output_ == k_standard_output ? "." + standard_format_ : output_);
            file.emplace(output_, model_.model);
        }

        const Mesh mesh = model_.load_mesh(context);
        Extraction extraction = about_model(model_.model, [&] {
            Progress progress(context, "building the method's structure");
            return extract_by(*method_, mesh, point,
                              {.origins = {origins_.begin(), origins_.end()},
                               .seed = seed_,
                               .call = progress.call()});
        });
        if (without_concave_) {
            if (!mesh.is_closed() || !mesh.is_oriented())
                throw Error(ErrorCode::bad_input,
                            model_.model +
                                ": --no-concave: the mesh is open or its faces disagree "
                                "on the outside, where concave edges can be visible; "
                                "leave the option out");
            remove_concave_edges(concave_edge_bits(mesh), extraction.edges);
        }
        context.checkpoint();
        context.times.end("finding edges");

        const std::vector<FileEdge> edges = in_file_order(mesh, extraction.edges);
        if (file) {
            file->write(format_lines(mesh, point, edges, format));
            file->commit();
        }
        context.times.end("writing");
        if (context.json)
            print_result(context, mesh, extraction, edges);
        else
            print_summary(mesh, extraction);
        return ExitStatus::success;
    }

private:
    void set_method(const std::string& text) {
        method_ = find_silhouette_method(text);
        if (method_ != nullptr) return;
        std::vector<std::string> names;
        for (const SilhouetteMethodInfo& info : silhouette_methods()) names.emplace_back(info.name);
        throw CLI::ValidationError(
            "--method", "expected " + method_names([](const auto&) { return true; }) + ", not '" +
                            text + "'" + did_you_mean(text, names));
    }

    HomogeneousPoint point_from_options() const {
        if (from_.has_value() == direction_.has_value())
            throw UsageError("exactly one of --from and --direction is needed");
        if (from_ && method_->directions_only)
            throw UsageError("--method " + std::string(method_->name) +
                             ": takes directions only; give --direction, not --from");
        return from_ ? HomogeneousPoint::viewpoint(*from_)
                     : HomogeneousPoint::direction(*direction_);
    }

    void check_method_options() const {
        if (origin_option_->count() > 0 && method_->max_origins == 0)
            throw UsageError("--origin: belongs to --method " +
                             method_names([](const auto& info) { return info.max_origins > 0; }));
        if (seed_option_->count() > 0 && !method_->has_seed)
            throw UsageError("--seed: belongs to --method " +
                             method_names([](const auto& info) { return info.has_seed; }));
        if (origins_.size() > method_->max_origins && method_->max_origins > 0)
            throw UsageError("--origin: --method " + std::string(method_->name) +
                             " takes one; several belong to --method octree");
    }

    std::string format_lines(const Mesh& mesh, const HomogeneousPoint& point,
                             const std::vector<FileEdge>& edges, LineFormat format) const {
        std::vector<EdgeId> silhouette;
        for (const FileEdge& e : edges) silhouette.push_back(e.edge);
        std::vector<EdgeId> borders;
        const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::border);
        if (with_borders_)
            for (std::uint32_t e = range.first; e < range.last; ++e) borders.push_back(EdgeId{e});
        const std::string title = printable_text("Silhouette of " + model_.model +
                                                 (point.is_direction() ? " along " : " from ") +
                                                 vector_text(point.xyz()));
        return tools::format_lines({mesh, point, silhouette, borders, title}, format);
    }

    void print_result(const Context& context, const Mesh& mesh, const Extraction& extraction,
                      const std::vector<FileEdge>& edges) const {
        nlohmann::ordered_json counters{{"box_checks", extraction.counters.box_checks},
                                        {"face_checks", extraction.counters.face_checks},
                                        {"edge_checks", extraction.counters.edge_checks}};
        for (const NamedCount& own : extraction.own_counts)
            counters[std::string(own.name)] = own.count;
        nlohmann::ordered_json result{{"model", model_.model},
                                      {"method", method_->name},
                                      {"vertices", mesh.vertex_count()},
                                      {"faces", mesh.face_count()},
                                      {"count", edges.size()},
                                      {"borders", mesh.edges_of_class(EdgeClass::border).size()},
                                      {"counters", std::move(counters)},
                                      {"ms", extraction.ms}};
        if (extraction.recall) result["recall"] = *extraction.recall;
        if (!output_.empty()) result["output"] = output_;
        if (!without_edges_) {
            nlohmann::ordered_json& list = result["edges"] = nlohmann::ordered_json::array();
            for (const FileEdge& e : edges) list.push_back(e.vertices);
        }
        print_json(context, std::move(result));
    }

    void print_summary(const Mesh& mesh, const Extraction& extraction) const {
        std::printf("%zu silhouette edges of %u, and %u borders\n", extraction.edges.size(),
                    mesh.edge_count(), mesh.edges_of_class(EdgeClass::border).size());
        std::printf("  %s: %.3f ms, %llu box, %llu face and %llu edge checks\n",
                    std::string(method_->name).c_str(), extraction.ms,
                    static_cast<unsigned long long>(extraction.counters.box_checks),
                    static_cast<unsigned long long>(extraction.counters.face_checks),
                    static_cast<unsigned long long>(extraction.counters.edge_checks));
        for (const NamedCount& own : extraction.own_counts)
            std::printf("  %s: %llu\n", std::string(own.name).c_str(),
                        static_cast<unsigned long long>(own.count));
        if (extraction.recall)
            std::printf("  recall %.4f: this method is not exact\n", *extraction.recall);
        if (!output_.empty()) std::printf("  written to %s\n", output_.c_str());
    }

    ModelArgument model_;
    std::optional<glm::vec3> from_;
    std::optional<glm::vec3> direction_;
    const SilhouetteMethodInfo* method_ = find_silhouette_method("octree");
    std::vector<glm::vec3> origins_;
    const CLI::Option* origin_option_ = nullptr;
    std::uint32_t seed_ = 1;
    const CLI::Option* seed_option_ = nullptr;
    std::string output_, standard_format_ = "svg";
    const CLI::Option *output_option_ = nullptr, *as_option_ = nullptr;
    bool with_borders_ = false;
    bool without_concave_ = false;
    bool without_edges_ = false;
};

}  // namespace

std::unique_ptr<Command> make_silhouette_command() { return std::make_unique<SilhouetteCommand>(); }

}  // namespace rimline::tools
