#pragma once

// The kind of output that the name of an animation asks for.

#include <filesystem>
#include <memory>

#include "tools/cli_classes.h"
#include "tools/output/frame_sink.h"

namespace rimline::tools {

/// By the ending of the name: .apng, or .mp4, .gif or .webm, which need ffmpeg; else a folder. Create it before the
/// work, so that a bad name is reported at once. Throws UsageError for the ending of another kind of file, and for
/// transparent pictures in .mp4; Error{io} if the output cannot be written, or if ffmpeg is not installed.
std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& output,
                                           const FrameSinkOptions& options);

/// Throws UsageError if the option --fps was given and make_frame_sink() would make no film, but pictures in a folder.
void check_fps(const CLI::Option& fps, const std::filesystem::path& output);

}  // namespace rimline::tools
