#include "tools/frame_sequence.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "silhouette/error.h"
#include "tools/output_file.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

void write_png(const fs::path& path, const Picture& picture) {
    OutputFile output(path);
    const std::vector<std::byte> png = encode_png(picture);
    output.write({reinterpret_cast<const char*>(png.data()), png.size()});
    output.commit();
}

}  // namespace

FrameSequence::FrameSequence(fs::path folder, std::uint32_t frame_count)
    : folder_(std::move(folder)) {
    if (folder_.empty()) throw Error(ErrorCode::io, "the output folder's name is empty");
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorCode::io, folder_.string() + ": cannot write frames: " + what);
    };
    std::error_code error;
    is_own_ = fs::create_directory(folder_, error);
    if (!fs::is_directory(folder_))
        fail(fs::exists(folder_) ? "it is not a folder" : error.message());
    if (access(folder_.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
    const std::size_t needed = std::to_string(frame_count > 0 ? frame_count - 1 : 0).size();
    digits_ = std::max(digits_, static_cast<int>(needed));
}

FrameSequence::~FrameSequence() {
    if (writing_.valid()) writing_.wait();
    std::error_code ignored;
    if (is_own_) fs::remove(folder_, ignored);  // Does nothing where there are frames.
}

fs::path FrameSequence::file(std::uint32_t frame) const {
    std::string number = std::to_string(frame);
    const std::size_t digits =
        std::max<std::size_t>(static_cast<std::size_t>(digits_), number.size());
    number.insert(0, digits - number.size(), '0');
    return folder_ / ("frame_" + number + ".png");
}

void FrameSequence::write(Picture picture) {
    finish();
    writing_ = std::async(std::launch::async, [path = file(next_), picture = std::move(picture)] {
        write_png(path, picture);
    });
    ++next_;
}

void FrameSequence::finish() {
    if (writing_.valid()) writing_.get();
}

}  // namespace rimline::tools
