#pragma once

// The pictures of an animation as a film that ffmpeg makes: .mp4 (H.264), .webm (VP9) or .gif.
//
// ffmpeg runs beside this program and reads raw pictures from it. It writes the temporary file of an OutputFile, so
// a film appears complete or not at all.

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "tools/output/frame_sink.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

/// `ending` is in lower case, with its point.
bool is_film_ending(std::string_view ending) noexcept;

class FilmFile final : public FrameSink {
public:
    /// Starts ffmpeg. Throws as make_frame_sink() (frame_output.h) says.
    FilmFile(const std::filesystem::path& path, const std::string& ending,
             const FrameSinkOptions& options);
    /// Ends ffmpeg, if it still runs.
    ~FilmFile() override;

private:
    void put(const Picture& picture, std::uint32_t number) override;
    void end() override;
    void start(const std::string& ending, const FrameSinkOptions& options);
    [[noreturn]] void fail();
    int wait_for_end();

    OutputFile file_;
    std::FILE* messages_ = nullptr;  // A temporary file: standard error of ffmpeg.
    pid_t id_ = -1;
    int input_ =
        -1;  // Our end of a socket: a pipe to a program that has ended would end this one too.
};

}  // namespace rimline::tools
