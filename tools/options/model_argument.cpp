#include "tools/options/model_argument.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <glm/common.hpp>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/shapes/loop_subdivision.h"
#include "tools/input_files.h"
#include "tools/nearest_name.h"
#include "tools/options/double_faces.h"
#include "tools/options/option_types.h"
#include "tools/options/scene_mark.h"
#include "tools/options/standard_input.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr std::string_view k_shape_prefix = "shape:";
constexpr std::uint32_t k_max_shape_faces = 1u << 28;
// Components of viewpoints below 2^-60 count as zero (homogeneous_point.h).
constexpr double k_min_radius = 0x1p-50;
constexpr const char* k_advice_too_large = "; take fewer faces or fewer steps of --subdivide";

std::string shape_names() {
    std::string names;
    for (const std::string_view name : k_built_in_shapes)
        names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

std::string nearest_shape(std::string_view name) {
    return did_you_mean(
        name, std::vector<std::string>(k_built_in_shapes.begin(), k_built_in_shapes.end()));
}

struct ShapeName {
    std::string_view name;
    std::uint32_t faces;  // 0: the default of the shape.
};

// Nothing if `text` is a file name.
std::optional<ShapeName> parse_shape(std::string_view text, const char* argument = "MODEL") {
    if (!text.starts_with(k_shape_prefix)) return std::nullopt;
    const std::string_view rest = text.substr(k_shape_prefix.size());
    const std::size_t colon = rest.find(':');
    ShapeName shape{rest.substr(0, colon), 0};
    if (std::find(k_built_in_shapes.begin(), k_built_in_shapes.end(), shape.name) ==
        k_built_in_shapes.end())
        throw CLI::ValidationError(argument, "no built-in shape is called '" +
                                                 std::string(shape.name) + "'; there are " +
                                                 shape_names() + nearest_shape(shape.name));
    if (colon == std::string_view::npos) return shape;
    const std::string_view faces = rest.substr(colon + 1);
    const char* end = faces.data() + faces.size();
    const auto parsed = std::from_chars(faces.data(), end, shape.faces);
    if (parsed.ec != std::errc() || parsed.ptr != end || shape.faces < 1 ||
        shape.faces > k_max_shape_faces)
        throw CLI::ValidationError(
            argument, "expected a number of faces from 1 to 2^28 in '" + std::string(text) + "'");
    return shape;
}

// Of a file or standard input.
MeshSource read_model(const std::string& model, const std::string& format,
                      FaceRequirement requirement, const BeginCall& begin) {
    // The points of a cloud are read, so that the message names what takes them.
    constexpr FaceRequirement k_any = FaceRequirement::faces_or_points;
    MeshSource source = model == k_standard_input
                            ? read_standard_input(format, k_any, begin("reading standard input"))
                            : about_scene_files(model, [&] {
                                  return read_mesh_file(model, k_any, begin("reading " + model));
                              });
    if (requirement == FaceRequirement::faces && source.triangles.empty())
        throw Error(ErrorCode::bad_input,
                    model + ": no faces: it is a cloud of " +
                        std::to_string(source.positions.size()) +
                        " points; rimline points draws clouds, and rimline view shows one alone");
    return source;
}

}  // namespace

std::string model_description(StandardInput input) {
    return std::string("File (OBJ, PLY, STL, OFF, glTF, GLB), ") +
           (input == StandardInput::read ? "- for standard input, " : "") +
           "or shape:NAME[:FACES] with NAME one of " + shape_names();
}

bool is_built_in_shape(const std::string& model) { return model.starts_with(k_shape_prefix); }

bool is_model_file_name(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 9> k_endings{".obj", ".ply", ".stl", ".off", ".gltf",
                                                        ".glb", ".xyz", ".pts", ".csv"};
    const std::string ending = path.extension().string();
    return std::ranges::any_of(
        k_endings, [&](std::string_view known) { return equals_ignoring_case(ending, known); });
}

void check_model_name(const std::string& text, const char* argument) {
    if (text.empty())
        throw CLI::ValidationError(argument, "expected a file or shape:NAME[:FACES], not ''");
    parse_shape(text, argument);
}

MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const BeginCall& begin, TexturePictures textures,
                      const std::string& format) {
    check_format_is_of_input(model, format);
    MeshSource source;
    if (const std::optional<ShapeName> shape = parse_shape(model)) {
        begin("making " + model).checkpoint(0.0);
        source = about_model(model, [&] { return make_built_in_shape(shape->name, shape->faces); });
    } else {
        source = read_model(model, format, requirement, begin);
    }
    declare_inputs(source.files);
    if (textures == TexturePictures::read && !source.materials.textures.empty())
        read_textures(source, begin("reading the textures of " + model));
    return subdivided(model, std::move(source), subdivide, begin);
}

MeshSource subdivided(const std::string& model, MeshSource source, std::uint32_t steps,
                      const BeginCall& begin) {
    if (steps == 0) return source;
    if (source.triangles.empty())
        throw Error(ErrorCode::bad_input, model + ": --subdivide: it has no faces");
    const LongCall call = begin("subdividing " + model);
    return about_model(model, [&] { return subdivide_loop(source, steps, call); });
}

MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const Context& context, TexturePictures textures,
                      const std::string& format) {
    MeshSource source = follow_progress(context, [&](const BeginCall& begin) {
        return load_model(model, subdivide, requirement, begin, textures, format);
    });
    for (const std::string& warning : source.warnings) print_warning(warning);
    context.times.end("reading");
    return source;
}

MeshSource load_drawn_model(const std::string& model, std::uint32_t subdivide,
                            const BeginCall& begin, TexturePictures textures,
                            const std::string& format) {
    MeshSource source =
        load_model(model, subdivide, FaceRequirement::faces, begin, textures, format);
    begin("comparing the faces of " + model).checkpoint(0.0);
    draw_double_faces_once(model, source);
    return source;
}

MeshSource load_drawn_model(const std::string& model, std::uint32_t subdivide,
                            const Context& context, TexturePictures textures,
                            const std::string& format) {
    MeshSource source = follow_progress(context, [&](const BeginCall& begin) {
        return load_drawn_model(model, subdivide, begin, textures, format);
    });
    for (const std::string& warning : source.warnings) print_warning(warning);
    context.times.end("reading");
    return source;
}

Mesh load_mesh(const std::string& model, std::uint32_t subdivide, const Context& context,
               TexturePictures textures) {
    return make_mesh(model, load_model(model, subdivide, FaceRequirement::faces, context, textures),
                     context);
}

Mesh make_mesh(const std::string& model, const MeshSource& source, const Context& context) {
    Progress progress(context, "joining the faces of " + model);
    return about_model(model, [&] {
        Mesh mesh(source, Welding::equal_positions, progress.call());
        if (mesh.radius() > 0.0 && mesh.radius() < k_min_radius)
            throw Error(ErrorCode::bad_input, "too small, less than 2^-50 in size: scale it up");
        context.times.end("joining faces");
        return mesh;
    });
}

void check_viewing_range(const std::string& model, const Mesh& mesh) {
    const glm::dvec3 reach = glm::abs(mesh.center()) + 3.0 * mesh.radius();
    if (std::max({reach.x, reach.y, reach.z}) > double{k_max_coordinate})
        throw Error(ErrorCode::too_large, model +
                                              ": too large to be seen from around: scale it "
                                              "down, coordinates end at 2^60");
}

void check_has_extent(const std::string& model, const Mesh& mesh) {
    if (mesh.face_count() == 0) throw Error(ErrorCode::bad_input, model + ": it has no faces");
    check_viewing_range(model, mesh);
    check_is_no_point(model, mesh);
}

void check_has_planes(const std::string& model, const Mesh& mesh) {
    if (std::ranges::none_of(mesh.planes(), &Plane::has_normal))
        throw Error(
            ErrorCode::bad_input,
            model + ": no face has a plane: take a model with faces that are not degenerate");
}

void check_is_no_point(const std::string& model, const Mesh& mesh) {
    if (mesh.radius() == 0.0)
        throw Error(ErrorCode::bad_input,
                    model + ": its radius is 0: take a model whose vertices are not all one point");
}

void throw_about_scene_file(const std::string& path) {
    if (!is_scene_file(path) || !holds_scene(path)) throw;
    throw Error(ErrorCode::bad_input, path +
                                          ": is a scene file, which only render, animate, view, "
                                          "draw and convert take; give a model "
                                          "instead");
}

void throw_about_model(const std::string& model) {
    try {
        throw;
    } catch (const Error& e) {
        const std::string message = e.what();
        // An error of input or output names its own path.
        if (e.code() == ErrorCode::cancelled || e.code() == ErrorCode::io ||
            message.starts_with(model + ":"))
            throw;
        const char* advice = e.code() == ErrorCode::too_large ? k_advice_too_large : "";
        throw Error(e.code(), model + ": " + message + advice);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large,
                    model + ": there is not enough memory for it" + k_advice_too_large);
    }
}

void ModelArgument::add_to(CLI::App& app, Presence presence) {
    CLI::Option* option = app.add_option_function<std::string>(
                                 "MODEL",
                                 [this](const std::string& text) {
                                     check_model_name(text);
                                     model = text;
                                 },
                                 model_description())
                              ->type_name("");
    if (presence == Presence::required) option->required();
    add_subdivide(app, subdivide)->group("Model");
    add_input_format(app, format);
}

void add_input_format(CLI::App& app, std::string& format) {
    app.add_option("--format", format, "Format of a MODEL from standard input")
        ->check(CLI::IsMember({"ply", "obj", "stl", "off", "glb", "xyz", "pts", "csv"}))
        ->group("Model");
}

CLI::Option* add_subdivide(CLI::App& app, std::uint32_t& steps) {
    return add_count(app, "--subdivide", steps, 0, k_max_subdivisions,
                     "Number of Loop subdivisions of the model; each makes four faces of one");
}

}  // namespace rimline::tools
