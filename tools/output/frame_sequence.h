#pragma once

// The pictures of an animation as frame_0000.png, frame_0001.png, ... in a folder.
//
// Each is encoded and written on another thread while the next one is drawn. A file appears complete or not
// at all (output_file.h): if the program is interrupted, the folder holds only complete frames.

#include <cstdint>
#include <filesystem>
#include <future>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/picture.h"
#include "tools/options/animation.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_finish.h"
#include "tools/output/output_folder.h"

namespace rimline::tools {

class FrameSequence {
public:
    /// Creates the folder if it is missing; its parent folder must exist. File numbers have four digits, or
    /// as many as the last of `frame_count` needs. `finish` is applied to each frame. Throws Error{io} naming the folder.
    FrameSequence(std::filesystem::path folder, std::uint32_t frame_count,
                  const PictureFinish& finish = {});
    /// Waits for the last write. Removes the folder if it was created here and is empty.
    ~FrameSequence();
    FrameSequence(const FrameSequence&) = delete;
    FrameSequence& operator=(const FrameSequence&) = delete;

    /// Waits for the write before, then starts to write the next frame. Throws Error{io} naming the file
    /// that could not be written; that may be the frame before.
    void write(Picture picture);
    /// Waits for the last write. Throws as write().
    void finish();

    const std::filesystem::path& folder() const noexcept { return folder_.path(); }
    /// The file of a frame. An existing file is replaced; further files of a longer sequence stay.
    std::filesystem::path file(std::uint32_t frame) const;

private:
    OutputFolder folder_;
    PictureFinish finish_;
    int digits_ = 4;
    std::uint32_t next_ = 0;
    std::future<void> writing_;
};

/// Draws and writes all frames of an animation. Each frame is submitted before the frame before it is read
/// back, and written while the next one is drawn. Returns one report per frame, whose
/// `frame_ms` is the time by the clock from the end of the frame before: together, they are the time of the call.
std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     Renderer& renderer, ImageSize size, FrameSequence& sequence,
                                     const LongCall& call);

}  // namespace rimline::tools
