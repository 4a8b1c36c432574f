#pragma once

// The kind of output that the name of an animation asks for.

#include <filesystem>
#include <memory>

#include "tools/output/frame_sink.h"

namespace rimline::tools {

/// By the ending of the name: .apng, or .mp4, .gif or .webm, which need ffmpeg; else a folder. Create it before the
/// work, so that a bad name is reported at once. Throws UsageError for the ending of another kind of file, and for
/// transparent pictures in .mp4; Error{io} if the output cannot be written, or if ffmpeg is not installed.
std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& output,
                                           const FrameSinkOptions& options);

}  // namespace rimline::tools
