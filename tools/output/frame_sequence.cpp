#include "tools/output/frame_sequence.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "tools/output/picture_file.h"

namespace rimline::tools {

namespace fs = std::filesystem;

FrameSequence::FrameSequence(fs::path folder, std::uint32_t frame_count,
                             const PictureFinish& finish)
    : folder_(std::move(folder), "frames"), finish_(finish) {
    const std::size_t needed = std::to_string(frame_count > 0 ? frame_count - 1 : 0).size();
    digits_ = std::max(digits_, static_cast<int>(needed));
}

FrameSequence::~FrameSequence() {
    if (writing_.valid()) writing_.wait();
}

fs::path FrameSequence::file(std::uint32_t frame) const {
    std::string number = std::to_string(frame);
    const std::size_t digits =
        std::max<std::size_t>(static_cast<std::size_t>(digits_), number.size());
    number.insert(0, digits - number.size(), '0');
    return folder_.path() / ("frame_" + number + ".png");
}

void FrameSequence::write(Picture picture) {
    finish();
    writing_ = std::async(std::launch::async, [path = file(next_), finish = finish_,
                                               picture = std::move(picture)]() mutable {
        finish.apply(picture);
        OutputFile output(path);
        write_png(output, picture);
    });
    ++next_;
}

void FrameSequence::finish() {
    if (writing_.valid()) writing_.get();
}

std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     Renderer& renderer, ImageSize size, FrameSequence& sequence,
                                     const LongCall& call) {
    std::vector<FrameReport> reports;
    reports.reserve(frame_count);
    // The renderer's own times overlap: it begins a frame before the one before is done.
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    const auto finish_one = [&] {
        sequence.write(renderer.finish());
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
    sequence.finish();
    return reports;
}

}  // namespace rimline::tools
