#pragma once

// A model from standard input: the name `-`, and --format, because there is no name that tells the format.

#include <optional>
#include <string>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/formats/point_file.h"

namespace rimline::tools {

/// The MODEL that stands for standard input.
constexpr const char* k_standard_input = "-";

/// Throws UsageError if a format is given and `model` is not standard input.
void check_format_is_of_input(const std::string& model, const std::string& format);

/// Reads standard input to its end, for a cloud.
PointSource read_cloud_from_standard_input(const std::string& format, BadPoints bad,
                                           const LongCall& call);

/// Reads standard input to its end. Throws UsageError without a format, or if standard input is a terminal, and
/// Error as read_mesh_bytes(). `format` is ply, obj, stl, off, glb, or of clouds xyz, pts or csv.
MeshSource read_standard_input(const std::string& format, FaceRequirement requirement,
                               const LongCall& call);

/// Both, for a command that takes either: the cloud only where there are no faces.
struct MeshOrCloud {
    MeshSource mesh;
    std::optional<PointSource> cloud;
};
MeshOrCloud read_either_from_standard_input(const std::string& format, const LongCall& call);

}  // namespace rimline::tools
