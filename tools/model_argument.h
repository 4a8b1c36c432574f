#pragma once

// The MODEL argument of every subcommand: a file, or shape:NAME[:FACES], refined by --subdivide.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/mesh_source.h"
#include "tools/command.h"

namespace rimline::tools {

/// How a help text names what MODEL may be.
std::string model_description();

/// Throws CLI::ValidationError when `text` begins with "shape:" and is no built-in shape. Whether a file
/// is there shows when it is loaded.
void check_model_name(const std::string& text);

/// Reads or makes a model, with progress. Throws Error.
MeshSource load_model(const std::string& model, std::uint32_t subdivide,
                      FaceRequirement requirement, const Context& context);

struct ModelArgument {
    std::string model;  ///< Empty when it was optional and not given.
    std::uint32_t subdivide = 0;

    enum class Presence { required, optional };
    void add_to(CLI::App& app, Presence presence = Presence::required);

    MeshSource load(const Context& context,
                    FaceRequirement requirement = FaceRequirement::faces) const {
        return load_model(model, subdivide, requirement, context);
    }
};

/// --subdivide alone, for commands that take several models.
CLI::Option* add_subdivide(CLI::App& app, std::uint32_t& steps);

}  // namespace rimline::tools
