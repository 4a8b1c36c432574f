// rimline convert: a model, or several as one, as GLB, with the classes of its edges.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/mesh/clear_creases.h"
#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/formats/embed_textures.h"
#include "silhouette/mesh/formats/glb_writer.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/upright.h"
#include "tools/command.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_list.h"
#include "tools/options/option_types.h"
#include "tools/options/up_option.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_file.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

class ConvertCommand final : public Command {
public:
    std::string name() const override { return "convert"; }
    std::string summary() const override {
        return "Write a model as GLB, with edges for viewers that draw them";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app, StandardInput::read, {.painted = "in the file that is written"});
        app.get_option("MODEL")->required();
        add_output(app, "-o,--output", output_, ".glb", "The file to write")->required();
        CLI::Option* edges =
            app.add_flag("--edges", finds_edges_,
                         "Find the classes of edges: hard, silhouette or hidden (default: those "
                         "of a glTF file that has them)");
        add_number(app, "--crease", crease_degrees_, 1.0, 180.0,
                   "Edges that bend by at least this angle in degrees are hard (default: those "
                   "that bend by 30 and stand out)")
            ->needs(edges);
        normals_option_ =
            app.add_option(
                   "--normals", normals_,
                   "Normals of silhouette edges, found here or of a glTF file: bytes, as CesiumJS "
                   "needs them, or floats, which are exact")
                ->check(CLI::IsMember({"bytes", "floats"}))
                ->capture_default_str();
        // Directions along an axis may be numbers too.
        add_up(app, up_.up, up_.is_up_auto,
               "Up axis: one of x, y, z, -x, -y, -z, or auto: y, unless the model clearly stands "
               "along another axis (default: as the file format says, else auto)")
            ->type_name("AXIS|auto");
        models_.add_to_up(app);
        app.footer(
            "In the file y is up, as glTF wants it: a model that stands along another axis is "
            "turned.\n"
            "The classes are those of EXT_mesh_primitive_edge_visibility. Hard edges are always "
            "drawn: borders,\n"
            "creases, and edges of three faces or more. Silhouette edges are drawn where one face "
            "is front and\n"
            "the other back. Edges between faces in one plane are hidden. Equal positions become "
            "one vertex.\n"
            "Colors of materials, vertices and faces are written, and textures as the bytes of "
            "their "
            "files.\nTransparency is not.\n\n"
            "Several models, or the models of a scene file, become one mesh. --at, --turn, "
            "--scale, "
            "--paint and --up\n"
            "belong to the MODEL before them: first the model is scaled, then turned, then "
            "moved.\n\n"
            "Examples:\n"
            "  rimline convert bunny.obj -o bunny.glb --edges\n"
            "  rimline convert fandisk.obj -o fandisk.glb --edges --crease 20 --normals floats");
    }

    ExitStatus run(const Context& context) override {
        models_.settle(up_, {.first_camera = false, .picture = false});
        if (up_.up &&
            std::ranges::find(k_axis_directions, glm::dvec3(*up_.up)) == k_axis_directions.end())
            throw UsageError("--up: of a file only an axis can be up: x, y, z, -x, -y or -z");
        check_output(context, output_);
        models_.check_output_is_no_input(output_);
        OutputFile file(output_);
        MeshSource source = models_.load_source(up_, {.for_file = true}, context);
        const std::size_t printed = source.warnings.size();  // load_source() has printed these.
        embed_textures(source, {context.stop, {}});
        for (std::size_t i = printed; i < source.warnings.size(); ++i)
            print_warning(source.warnings[i]);
        const Mesh mesh = make_mesh(models_.name(), source, context);
        const std::vector<std::uint8_t> codes = std::move(source.edge_codes);
        source = {};
        if (normals_option_->count() > 0 && !finds_edges_ && codes.empty())
            throw UsageError("--normals: are those of silhouette edges: --edges finds them");
        std::vector<EdgeVisibility> edges;
        std::string bytes;
        about_model(models_.name(), [&] {
            if (finds_edges_)
                edges = edge_visibility(mesh, crease_flags_of(mesh));
            else if (!codes.empty())
                edges = edge_visibility_of_codes(mesh, codes);
            context.times.end("classes of edges");
            context.checkpoint();
            models_.settle_up(mesh, up_, context);
            bytes = glb_bytes(mesh, {.edges = edges,
                                     .normals = normals_ == "bytes" ? SilhouetteNormals::bytes
                                                                    : SilhouetteNormals::floats,
                                     .up = models_.up().up});
        });
        context.checkpoint();
        file.write(bytes);
        file.commit();
        context.times.end("writing");
        report(context, mesh, edges, bytes.size());
        return ExitStatus::success;
    }

private:
    std::vector<std::uint8_t> crease_flags_of(const Mesh& mesh) const {
        if (crease_degrees_)
            return crease_flags(mesh, static_cast<float>(glm::radians(*crease_degrees_)));
        return clear_crease_flags(
            mesh, static_cast<float>(glm::radians(DrawnLines::k_clear_crease_degrees)));
    }

    void report(const Context& context, const Mesh& mesh, const std::vector<EdgeVisibility>& edges,
                std::size_t bytes) const {
        const EdgeVisibilityCounts counts = count_classes(edges);
        if (context.json) {
            nlohmann::ordered_json classes;
            if (!edges.empty())
                classes = {{"hidden", counts.hidden},
                           {"silhouette", counts.silhouette},
                           {"hard", counts.hard}};
            nlohmann::ordered_json json = models_.json();
            json.update(nlohmann::ordered_json{{"vertices", mesh.vertex_count()},
                                               {"faces", mesh.face_count()},
                                               {"edge_visibility", std::move(classes)},
                                               {"up", json_vector(models_.up().up)},
                                               {"up_from", up_source_name(models_.up().source)},
                                               {"bytes", bytes},
                                               {"output", output_}});
            print_json(context, std::move(json));
            return;
        }

        std::printf("%s: %u vertices, %u faces, %zu bytes\n", output_.c_str(), mesh.vertex_count(),
                    mesh.face_count(), bytes);
        if (!edges.empty())
            std::printf("  edges       %u hidden, %u silhouette, %u hard\n", counts.hidden,
                        counts.silhouette, counts.hard);
        print_up(models_.up());
    }

    ModelList models_;
    UpOptions up_;
    std::string output_;
    bool finds_edges_ = false;
    std::optional<double> crease_degrees_;
    const CLI::Option* normals_option_ = nullptr;
    std::string normals_ = "bytes";
};

}  // namespace

std::unique_ptr<Command> make_convert_command() { return std::make_unique<ConvertCommand>(); }

}  // namespace rimline::tools
