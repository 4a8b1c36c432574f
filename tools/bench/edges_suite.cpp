// rimline bench edges: the classes of edges that `rimline convert --edges` writes.

#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/mesh/clear_creases.h"
#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/formats/glb_writer.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "tools/bench/edge_normals.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/option_types.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

// The least time of all rounds.
struct WritingTimes {
    double classes_ms = 0.0, bytes_ms = 0.0;
};

struct EdgesResult {
    std::string model;
    std::uint32_t faces = 0;
    EdgeVisibilityCounts classes = {};
    std::size_t bytes = 0;
    WritingTimes times = {};
    EdgeNormalsResult normals = {};
    bool is_read_again = false;  // Every edge in the same class.
};

double ms_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

EdgesResult measure_edges(const std::string& model, const Mesh& mesh, std::uint32_t views,
                          std::uint32_t rounds, const Context& context) {
    EdgesResult result{.model = model, .faces = mesh.face_count()};
    std::vector<EdgeVisibility> edges;
    std::string glb;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        context.checkpoint();
        const double classes_ms = ms_of([&] {
            edges = edge_visibility(
                mesh,
                clear_crease_flags(mesh, float(glm::radians(DrawnLines::k_clear_crease_degrees))));
        });
        const double bytes_ms = ms_of([&] { glb = glb_bytes(mesh, {edges}); });
        if (round == 0 || classes_ms < result.times.classes_ms)
            result.times.classes_ms = classes_ms;
        if (round == 0 || bytes_ms < result.times.bytes_ms) result.times.bytes_ms = bytes_ms;
    }
    result.classes = count_classes(edges);
    result.bytes = glb.size();
    Progress progress(context, "judging edges from " + std::to_string(views) + " points");
    const MeshSource source = read_mesh_bytes("the written file", std::move(glb), ".glb");
    const Mesh read(source);
    // Edges are numbered by their vertices, also where the file has the faces in another order.
    result.is_read_again = edge_visibility_of_codes(read, source.edge_codes) == edges;
    result.normals = judge_edges(mesh, edges, views, progress.call());
    return result;
}

Json to_json(const EdgesResult& result, std::uint32_t views) {
    Json normals = Json::array();
    for (std::size_t s = 0; s < k_stored_normals; ++s)
        normals.push_back({{"normals", k_stored_normal_names[s]},
                           {"missed", result.normals.misjudged[s].missed},
                           {"extra", result.normals.misjudged[s].extra}});
    return {{"model", result.model},
            {"faces", result.faces},
            {"hidden", result.classes.hidden},
            {"silhouette", result.classes.silhouette},
            {"hard", result.classes.hard},
            {"bytes", result.bytes},
            {"classes_ms", result.times.classes_ms},
            {"bytes_ms", result.times.bytes_ms},
            {"read_again", result.is_read_again},
            {"views", views},
            {"silhouette_edges", result.normals.silhouette},
            {"hidden_silhouette_edges", result.normals.hidden},
            {"misjudged", std::move(normals)}};
}

class EdgesSuite final : public Command {
public:
    std::string name() const override { return "edges"; }
    std::string summary() const override {
        return "Classes of edges as files have them, and how viewers judge silhouettes by them";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, or "
                       "built-in shapes");
        add_count(app, "--views", views_, 1, 1'000'000, "Points around the model")->group("Amount");
        add_count(app, "--rounds", rounds_, 1, 1000, "Rounds; the least time counts")
            ->group("Amount");
        app.footer(
            "First each file is read again: every edge must have its class. The second table has "
            "the silhouette\n"
            "edges that viewers miss, and edges that they draw though they are on no silhouette, "
            "in percent of\n"
            "the silhouette edges of all views. Viewers decide by two normals of an edge, stored "
            "as three signed\n"
            "bytes, the same as CesiumJS decodes them, in 16 bits as the first draft of the "
            "extension did, or\n"
            "as floats. Here the bits of the faces decide.\n\n"
            "Examples:\n"
            "  rimline bench edges bunny.obj igea.ply\n"
            "  rimline bench edges shape:knot:1000000 --views 100 --json");
    }

    ExitStatus run(const Context& context) override {
        MachineHeading heading;
        std::vector<EdgesResult> results;
        for (const std::string& name : models_.named().empty() ? usual_models() : models_.named())
            results.push_back(
                measure_edges(name, load_suite_mesh(name, models_.subdivide(), heading, context),
                              views_, rounds_, context));
        std::string difference;
        for (const EdgesResult& result : results)
            if (!result.is_read_again)
                difference += (difference.empty() ? "" : ", ") + result.model;
        if (context.json) {
            Json list = Json::array();
            for (const EdgesResult& result : results) list.push_back(to_json(result, views_));
            print_json({{"machine", tools::to_json(heading.machine())}, {"models", list}});
        } else {
            print(results);
        }
        return report_check(
            difference.empty() ? "" : difference + ": edges have other classes when read again");
    }

private:
    void print(const std::vector<EdgesResult>& results) const {
        std::printf("\n%-24s %9s %9s %10s %9s %12s %11s %9s\n", "writing", "faces", "hidden",
                    "silhouette", "hard", "bytes", "classes ms", "bytes ms");
        for (const EdgesResult& r : results)
            std::printf("%-24s %9u %9u %10u %9u %12zu %11.1f %9.1f\n", short_name(r).c_str(),
                        r.faces, r.classes.hidden, r.classes.silhouette, r.classes.hard, r.bytes,
                        r.times.classes_ms, r.times.bytes_ms);
        std::printf("\n%-24s %10s %8s", "missed + extra, %", "edges/view", "hidden");
        for (const char* stored : k_stored_normal_names) std::printf(" %16s", stored);
        std::printf("\n");
        for (const EdgesResult& r : results) {
            const double all = double(r.normals.silhouette + r.normals.hidden);
            const auto percent = [&](std::uint64_t n) {
                return all > 0.0 ? 100.0 * double(n) / all : 0.0;
            };
            std::printf("%-24s %10.1f %8.4f", short_name(r).c_str(), all / views_,
                        percent(r.normals.hidden));
            for (const auto& [missed, extra] : r.normals.misjudged)
                std::printf("  %6.4f + %6.4f", percent(missed), percent(extra));
            std::printf("\n");
        }
    }

    static std::string short_name(const EdgesResult& result) {
        return std::filesystem::path(result.model).filename().string();
    }

    SuiteModels models_;
    std::uint32_t views_ = 1000;
    std::uint32_t rounds_ = 5;
};

}  // namespace

std::unique_ptr<Command> make_edges_suite() { return std::make_unique<EdgesSuite>(); }

}  // namespace rimline::tools
