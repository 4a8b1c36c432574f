#pragma once

// The MODEL argument of every subcommand: a file, or shape:NAME[:FACES], refined by --subdivide.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"
#include "tools/cli_classes.h"
#include "tools/command.h"
#include "tools/progress.h"

namespace rimline::tools {

/// Whether MODEL may be `-`.
enum class StandardInput { read, not_read };

/// The help text of MODEL.
std::string model_description(StandardInput input = StandardInput::read);

/// Whether `model` begins with "shape:".
bool is_built_in_shape(const std::string& model);
/// Whether the name ends as those of meshes and point clouds do, in upper or lower case.
bool is_model_file_name(const std::filesystem::path& path);

/// Throws CLI::ValidationError if `text` is empty, or if it begins with "shape:" and names no built-in
/// shape. Does not check whether a file exists.
void check_model_name(const std::string& text, const char* argument = "MODEL");

/// Whether the pictures of textures are read. Only drawing needs them.
enum class TexturePictures { skip, read };

/// Reads a file or makes a built-in shape, shows progress, and prints the warnings. Throws Error. Throws
/// UsageError if the model refers to a file that is to be written (input_files.h).
/// `format` is of standard input (standard_input.h).
MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const Context& context,
                      TexturePictures textures = TexturePictures::skip,
                      const std::string& format = {});

/// The same with progress of another kind: `begin` is called before each part of the work. Prints no warnings.
MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const BeginCall& begin,
                      TexturePictures textures = TexturePictures::skip,
                      const std::string& format = {});

/// The part of load_model() after reading. Throws Error{bad_input} for a cloud that is to be subdivided.
MeshSource subdivided(const std::string& model, MeshSource source, std::uint32_t steps,
                      const BeginCall& begin);

/// For drawing: the same without double faces (double_faces.h); a warning says how many there were. The model must have
/// faces.
MeshSource load_drawn_model(const std::string& model, std::uint32_t subdivide,
                            const BeginCall& begin, TexturePictures textures,
                            const std::string& format = {});
MeshSource load_drawn_model(const std::string& model, std::uint32_t subdivide,
                            const Context& context, TexturePictures textures,
                            const std::string& format = {});

/// load_model() and make_mesh(). The model must have faces.
Mesh load_mesh(const std::string& model, std::uint32_t subdivide, const Context& context,
               TexturePictures textures = TexturePictures::skip);
/// The mesh of a source that load_model() returned. Throws Error, also for a mesh smaller than 2^-50.
Mesh make_mesh(const std::string& model, const MeshSource& source, const Context& context);

/// Throws Error{too_large} if viewpoints at three radii from the mesh's center exceed the range of
/// coordinates.
void check_viewing_range(const std::string& model, const Mesh& mesh);
/// Throws Error{bad_input} if all vertices are one point.
void check_is_no_point(const std::string& model, const Mesh& mesh);
/// Both. Throws Error{bad_input} for a mesh without faces.
void check_has_extent(const std::string& model, const Mesh& mesh);
/// Throws Error{bad_input} for a mesh whose faces are all degenerate.
void check_has_planes(const std::string& model, const Mesh& mesh);

/// To be called in a catch block: rethrows the exception, or if the file is a scene file (scene_mark.h) an
/// Error{bad_input} that says so.
[[noreturn]] void throw_about_scene_file(const std::string& path);

/// Returns read(), which reads the file.
template <typename Read>
auto about_scene_files(const std::string& path, Read&& read) {
    try {
        return read();
    } catch (const Error&) {
        throw_about_scene_file(path);
    }
}

/// To be called in a catch block: rethrows the exception. An Error without the model's name, but for one of
/// input or output, and a failed allocation become an Error that begins with the name.
[[noreturn]] void throw_about_model(const std::string& model);

/// Returns work(). Its errors name the model, which the calls of the library do not know.
template <typename Work>
auto about_model(const std::string& model, Work&& work) {
    try {
        return work();
    } catch (...) {
        throw_about_model(model);
    }
}

struct ModelArgument {
    std::string model;  ///< Empty if it is optional and not given.
    std::uint32_t subdivide = 0;
    std::string format;  ///< Of standard input.

    enum class Presence { required, optional };
    void add_to(CLI::App& app, Presence presence = Presence::required);

    MeshSource load(const Context& context,
                    FaceRequirement requirement = FaceRequirement::faces) const {
        return load_model(model, subdivide, requirement, context, TexturePictures::skip, format);
    }
    Mesh load_drawn_mesh(const Context& context, TexturePictures textures) const {
        return make_mesh(model, load_drawn_model(model, subdivide, context, textures, format),
                         context);
    }
    Mesh load_mesh(const Context& context, TexturePictures textures = TexturePictures::skip) const {
        return make_mesh(
            model, load_model(model, subdivide, FaceRequirement::faces, context, textures, format),
            context);
    }
};

constexpr std::uint32_t k_max_subdivisions = 14;
/// Adds --format.
void add_input_format(CLI::App& app, std::string& format);
/// Adds only --subdivide, for commands that take several models.
CLI::Option* add_subdivide(CLI::App& app, std::uint32_t& steps);

}  // namespace rimline::tools
