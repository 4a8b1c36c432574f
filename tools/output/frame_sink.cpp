#include "tools/output/frame_sink.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

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

}  // namespace

void FrameSink::write(Picture picture) {
    if (writing_.valid()) writing_.get();
    writing_ = std::async(std::launch::async,
                          [this, number = next_, picture = std::move(picture)]() mutable {
                              finish_.apply(picture);
                              put(picture, number);
                          });
    ++next_;
}

void FrameSink::finish() {
    if (writing_.valid()) writing_.get();
    end();
}

void FrameSink::wait() noexcept {
    if (writing_.valid()) writing_.wait();
}

std::unique_ptr<FrameSink> make_frame_sink(const fs::path& output,
                                           const FrameSinkOptions& options) {
    const std::string ending = lower_ending(output);
    std::error_code ignored;
    const bool is_folder = fs::is_directory(output, ignored);
    if (!is_folder && ending == ".apng") return std::make_unique<ApngFile>(output, options);
    if (!is_folder && is_film_ending(ending))
        return std::make_unique<FilmFile>(output, ending, options);
    if (!is_folder && (output == k_standard_output ||
                       std::ranges::find(k_other_files, ending) != k_other_files.end()))
        throw UsageError(
            "-o: expected a folder, or a name that ends in .apng, .mp4, .gif or "
            ".webm, not '" +
            output.string() + "'");
    return std::make_unique<FrameSequence>(output, options.frame_count, options.finish);
}

std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     Renderer& renderer, ImageSize size, FrameSink& sink,
                                     const LongCall& call) {
    std::vector<FrameReport> reports;
    reports.reserve(frame_count);
    // The renderer's own times overlap: it begins a frame before the one before is done.
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    const auto finish_one = [&] {
        sink.write(renderer.finish());
        reports.push_back(renderer.report());
        const Clock::time_point now = Clock::now();
        reports.back().frame_ms = std::chrono::duration<double, std::milli>(now - last).count();
        last = now;
    };
    for (std::uint32_t frame = 0; frame < frame_count; ++frame) {
        call.checkpoint(double(frame) / frame_count);
        renderer.submit(animation.at(frame), size.width, size.height);
        if (frame > 0) finish_one();
    }
    if (frame_count > 0) finish_one();
    sink.finish();
    return reports;
}

}  // namespace rimline::tools
