#pragma once

// The pictures of an animation, as frame_0000.png, frame_0001.png, ... in a folder.
//
// Each is encoded and written on a thread of its own while the next is drawn, and appears whole or not
// at all (output_file.h): whatever ends the program, the frames that are there are finished ones.

#include <cstdint>
#include <filesystem>
#include <future>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/picture.h"
#include "tools/options/animation.h"
#include "tools/options/option_types.h"
#include "tools/output/output_folder.h"

namespace rimline::tools {

class FrameSequence {
public:
    /// Makes the folder where it is missing; the folder it lies in must be there. Numbers have four digits,
    /// or as many as the last of `frame_count` needs. Throws Error{io} naming the folder.
    FrameSequence(std::filesystem::path folder, std::uint32_t frame_count);
    /// Waits for what is being written. A folder that was made and is still empty goes again.
    ~FrameSequence();
    FrameSequence(const FrameSequence&) = delete;
    FrameSequence& operator=(const FrameSequence&) = delete;

    /// Begins to write the next frame, when the one before is written. Throws Error{io} naming the file
    /// that could not be written: this or the one before.
    void write(Picture picture);
    /// Waits for the last frame. Throws likewise.
    void finish();

    const std::filesystem::path& folder() const noexcept { return folder_.path(); }
    /// An earlier frame's file is replaced; those of a longer sequence stay.
    std::filesystem::path file(std::uint32_t frame) const;

private:
    OutputFolder folder_;
    int digits_ = 4;
    std::uint32_t next_ = 0;
    std::future<void> writing_;
};

/// Draws the frames of an animation from its first on, and writes them: one is queued before the one
/// before it is fetched, and written while the next is drawn. Returns what each took.
std::vector<FrameReport> draw_frames(Animation& animation, std::uint32_t frame_count,
                                     Renderer& renderer, ImageSize size, FrameSequence& sequence,
                                     const LongCall& call);

}  // namespace rimline::tools
