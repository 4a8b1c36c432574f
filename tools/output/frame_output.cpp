#include "tools/output/frame_output.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <system_error>

#include "tools/command.h"
#include "tools/output/apng_file.h"
#include "tools/output/film_file.h"
#include "tools/output/frame_sequence.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

// Endings that nobody gives a folder.
constexpr std::array<std::string_view, 14> k_other_files{".png",  ".jpg", ".jpeg", ".mov",  ".avi",
                                                         ".mkv",  ".mpg", ".ogv",  ".webp", ".tif",
                                                         ".tiff", ".bmp", ".svg",  ".pdf"};

std::string lower_ending(const fs::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return ending;
}

bool is_film(const fs::path& output) {
    const std::string ending = lower_ending(output);
    std::error_code ignored;
    return (ending == ".apng" || is_film_ending(ending)) && !fs::is_directory(output, ignored);
}

bool is_other_file(const fs::path& output) {
    std::error_code ignored;
    return !fs::is_directory(output, ignored) &&
           (output == k_standard_output ||
            std::ranges::find(k_other_files, lower_ending(output)) != k_other_files.end());
}

}  // namespace

std::unique_ptr<FrameSink> make_frame_sink(const fs::path& output,
                                           const FrameSinkOptions& options) {
    const std::string ending = lower_ending(output);
    if (is_film(output)) {
        if (ending == ".apng") return std::make_unique<ApngFile>(output, options);
        return std::make_unique<FilmFile>(output, ending, options);
    }
    if (is_other_file(output))
        throw UsageError(
            "-o: expected a folder, or a name that ends in .apng, .mp4, .gif or "
            ".webm, not '" +
            output.string() + "'");
    return std::make_unique<FrameSequence>(output, options.frame_count, options.finish);
}

void check_fps(const CLI::Option& fps, const fs::path& output) {
    if (fps.count() > 0 && !is_film(output) && !is_other_file(output))
        throw UsageError("--fps: belongs to a film; a folder has pictures alone");
}

}  // namespace rimline::tools
