#include "tools/options/standard_input.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "tools/command.h"

namespace rimline::tools {

namespace {

constexpr const char* k_input_name = "standard input";

std::string bytes_of_standard_input(const LongCall& call) {
    if (isatty(STDIN_FILENO) == 1)
        throw UsageError("standard input is a terminal; send a file to it");
    constexpr std::size_t k_chunk = std::size_t{1} << 20;
    std::string bytes;
    for (;;) {
        call.checkpoint(0.0);
        const std::size_t had = bytes.size();
        bytes.resize(had + k_chunk);
        const ssize_t got = read(STDIN_FILENO, bytes.data() + had, k_chunk);
        bytes.resize(had + static_cast<std::size_t>(got > 0 ? got : 0));
        if (got < 0 && errno != EINTR)
            throw Error(ErrorCode::io, "standard input: cannot read it: " +
                                           std::generic_category().message(errno));
        if (got == 0) break;
    }
    return bytes;
}

void check_has_format(const std::string& format) {
    if (format.empty())
        throw UsageError("MODEL: standard input needs --format ply, obj, stl, off or glb");
}

}  // namespace

void check_format_is_of_input(const std::string& model, const std::string& format) {
    if (!format.empty() && model != k_standard_input)
        throw UsageError("--format: is for standard input, -; the name of " + model +
                         " tells its format");
}

MeshSource read_standard_input(const std::string& format, FaceRequirement requirement,
                               const LongCall& call) {
    check_has_format(format);
    return read_mesh_bytes(k_input_name, bytes_of_standard_input(call), "." + format, requirement,
                           call);
}

MeshOrCloud read_either_from_standard_input(const std::string& format, const LongCall& call) {
    check_has_format(format);
    std::string bytes = bytes_of_standard_input(call);
    MeshOrCloud either{.mesh = read_mesh_bytes(k_input_name, bytes, "." + format,
                                               FaceRequirement::faces_or_points, call),
                       .cloud = {}};
    if (either.mesh.triangles.empty())
        either.cloud =
            read_point_bytes(k_input_name, std::move(bytes), "." + format, BadPoints::refuse, call);
    return either;
}

PointSource read_cloud_from_standard_input(const std::string& format, BadPoints bad,
                                           const LongCall& call) {
    if (format.empty())
        throw UsageError(
            "CLOUD: standard input needs --format ply, obj, xyz, pts, csv, stl, off or glb");
    return read_point_bytes(k_input_name, bytes_of_standard_input(call), "." + format, bad, call);
}

}  // namespace rimline::tools
