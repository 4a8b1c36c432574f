#pragma once

// Where the pictures of an animation go: a folder of PNGs, an animated PNG, or a film that ffmpeg makes.
//
// Each picture is encoded and written on another thread while the next one is drawn.

#include <cstdint>
#include <future>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/picture.h"
#include "tools/options/animation.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_finish.h"
#include "tools/output/frame_lines.h"

namespace rimline::tools {

class FrameSink {
public:
    virtual ~FrameSink() = default;
    FrameSink(const FrameSink&) = delete;
    FrameSink& operator=(const FrameSink&) = delete;

    /// Waits for the write before, then starts to write the next frame. Throws Error{io}, which may be about the
    /// frame before.
    void write(Picture picture);
    /// Waits for the last write, and completes the output. Throws as write().
    void finish();

protected:
    explicit FrameSink(const PictureFinish& finish) : finish_(finish) {}
    /// For destructors: waits for the last write, which may use members.
    void wait() noexcept;

private:
    /// Writes a finished frame. Called on another thread, once for each frame, in their order.
    virtual void put(const Picture& picture, std::uint32_t number) = 0;
    /// Called after the last frame.
    virtual void end() {}

    PictureFinish finish_;
    std::uint32_t next_ = 0;
    std::future<void> writing_;
};

struct FrameSinkOptions {
    std::uint32_t frame_count;
    std::uint32_t fps;  ///< Of films: frames a second.
    ImageSize size;
    PictureFinish finish{};
};

/// Draws and writes all frames of an animation, with these lines unless null: else the engine draws its own. Each frame is submitted before the frame before it is read
/// back, and written while the next one is drawn. Returns one report per frame, whose `frame_ms` is the time by the
/// clock from the end of the frame before: together, they are the time of the call.
std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     FrameLines* lines, Renderer& renderer, ImageSize size,
                                     FrameSink& sink, const LongCall& call);

}  // namespace rimline::tools
