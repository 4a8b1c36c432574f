#include "tools/output/frame_sequence.h"

#include <algorithm>
#include <string>
#include <utility>

#include "tools/output/picture_file.h"

namespace rimline::tools {

namespace fs = std::filesystem;

FrameSequence::FrameSequence(fs::path folder, std::uint32_t frame_count,
                             const PictureFinish& finish)
    : FrameSink(finish), folder_(std::move(folder), "frames") {
    const std::size_t needed = std::to_string(frame_count > 0 ? frame_count - 1 : 0).size();
    digits_ = std::max(digits_, static_cast<int>(needed));
}

FrameSequence::~FrameSequence() { wait(); }

fs::path FrameSequence::file(std::uint32_t frame) const {
    std::string number = std::to_string(frame);
    const std::size_t digits =
        std::max<std::size_t>(static_cast<std::size_t>(digits_), number.size());
    number.insert(0, digits - number.size(), '0');
    return folder_.path() / ("frame_" + number + ".png");
}

void FrameSequence::put(const Picture& picture, std::uint32_t number) {
    if (number == 0) folder_.remove_numbered("frame_", 4);
    OutputFile output(file(number));
    write_png(output, picture);
}

}  // namespace rimline::tools
