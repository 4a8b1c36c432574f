#include "tools/output/frame_sink.h"

#include <chrono>
#include <utility>

namespace rimline::tools {

void FrameSink::write(Picture picture) {
    if (writing_.valid()) writing_.get();
    // Deferred where the system starts no more threads: then get() does it.
    writing_ = std::async(std::launch::async | std::launch::deferred,
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

std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     FrameLines* lines, Renderer& renderer, ImageSize size,
                                     FrameSink& sink, const LongCall& call) {
    std::vector<FrameReport> reports;
    reports.reserve(frame_count);
    std::vector<SilhouetteChanges> changes(frame_count);  // Of `lines`.
    // The renderer's own times overlap: it begins a frame before the one before is done.
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    const auto finish_one = [&] {
        sink.write(renderer.finish());
        reports.push_back(renderer.report());
        reports.back().camera += changes[reports.size() - 1];
        const Clock::time_point now = Clock::now();
        reports.back().frame_ms = std::chrono::duration<double, std::milli>(now - last).count();
        last = now;
    };
    for (std::uint32_t frame = 0; frame < frame_count; ++frame) {
        call.checkpoint(double(frame) / frame_count);
        Scene& scene = animation.at(frame);
        if (lines != nullptr) {
            lines->add_to(scene, {call.stop, {}});
            changes[frame] = lines->changes();
        }
        renderer.submit(scene, size.width, size.height);
        if (frame > 0) finish_one();
    }
    if (frame_count > 0) finish_one();
    sink.finish();
    return reports;
}

}  // namespace rimline::tools
