#pragma once

// The MODEL argument of every subcommand: a file, or shape:NAME[:FACES], refined by --subdivide.

#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"
#include "tools/command.h"

namespace rimline::tools {

/// How a help text names what MODEL may be.
std::string model_description();

/// Whether it is no file's name.
bool is_built_in_shape(const std::string& model);

/// Throws CLI::ValidationError when `text` is empty, or begins with "shape:" and is no built-in shape.
/// Whether a file is there shows when it is loaded.
void check_model_name(const std::string& text);

/// Reads or makes a model, with progress. Throws Error.
MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const Context& context);

/// The same for a caller who shows progress in another way: before each part of the work, `begin` is
/// told what it is ("reading bunny.obj") and returns how to follow and stop it.
using BeginCall = std::function<LongCall(const std::string& doing)>;
MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const BeginCall& begin);

/// The same, of faces, as a mesh.
Mesh load_mesh(const std::string& model, std::uint32_t subdivide, const Context& context);
/// The mesh of what load_model() gave. Throws Error: also where it is smaller than 2^-50.
Mesh make_mesh(const std::string& model, const MeshSource& source, const Context& context);

/// Throws Error{too_large} where three radii around its center the mesh leaves the coordinates that it may be
/// seen from.
void check_room_around(const std::string& model, const Mesh& mesh);
/// The same, and Error{bad_input} where all vertices are one point: no camera stands around it.
void check_has_extent(const std::string& model, const Mesh& mesh);

/// Within a catch block: throws on what was caught, an Error that does not begin with the model's name,
/// or memory that ran out, as an Error that does.
[[noreturn]] void throw_about_model(const std::string& model);

/// What `work` returns. Its errors name the model, which the library's own calls do not know.
template <typename Work>
auto about_model(const std::string& model, Work&& work) {
    try {
        return work();
    } catch (...) {
        throw_about_model(model);
    }
}

struct ModelArgument {
    std::string model;  ///< Empty when it was optional and not given.
    std::uint32_t subdivide = 0;

    enum class Presence { required, optional };
    void add_to(CLI::App& app, Presence presence = Presence::required);

    MeshSource load(const Context& context,
                    FaceRequirement requirement = FaceRequirement::faces) const {
        return load_model(model, subdivide, requirement, context);
    }
    Mesh load_mesh(const Context& context) const {
        return tools::load_mesh(model, subdivide, context);
    }
};

/// --subdivide alone, for commands that take several models.
CLI::Option* add_subdivide(CLI::App& app, std::uint32_t& steps);

}  // namespace rimline::tools
