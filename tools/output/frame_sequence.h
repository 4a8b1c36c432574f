#pragma once

// The pictures of an animation as frame_0000.png, frame_0001.png, ... in a folder.
//
// A file appears complete or not at all (output_file.h): if the program is interrupted, the folder holds only
// complete frames. Those of an older run are removed when the first frame is written.

#include <cstdint>
#include <filesystem>

#include "tools/output/frame_sink.h"
#include "tools/output/output_folder.h"

namespace rimline::tools {

class FrameSequence final : public FrameSink {
public:
    /// Creates the folder if it is missing; its parent folder must exist. File numbers have four digits, or
    /// as many as the last of `frame_count` needs. `finish` is applied to each frame. Throws Error{io} naming the
    /// folder.
    FrameSequence(std::filesystem::path folder, std::uint32_t frame_count,
                  const PictureFinish& finish = {});
    /// Waits for the last write. Removes the folder if it was created here and is empty.
    ~FrameSequence() override;

    const std::filesystem::path& folder() const noexcept { return folder_.path(); }
    /// The file of a frame.
    std::filesystem::path file(std::uint32_t frame) const;

private:
    void put(const Picture& picture, std::uint32_t number) override;

    OutputFolder folder_;
    int digits_ = 4;
};

}  // namespace rimline::tools
