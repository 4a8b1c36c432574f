#include "tools/options/standard_input.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "tools/command.h"

namespace rimline::tools {

MeshSource read_standard_input(const std::string& format, FaceRequirement requirement,
                               const LongCall& call) {
    if (format.empty())
        throw UsageError("MODEL: standard input needs --format ply, obj, stl, off or glb");
    if (isatty(STDIN_FILENO) == 1)
        throw UsageError("MODEL: standard input is a terminal; send a file to it");
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
    return read_mesh_bytes("standard input", std::move(bytes), "." + format, requirement, call);
}

}  // namespace rimline::tools
