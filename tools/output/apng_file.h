#pragma once

// The pictures of an animation as one animated PNG (APNG, PNG Specification, Third Edition, 2025).
//
//     signature  IHDR  acTL  fcTL IDAT...  fcTL fdAT...  fcTL fdAT...  IEND
//
// Programs without APNG show the first frame. Of each later frame only the rectangle that changed is stored. It
// replaces what was there (blend source, dispose none).

#include <cstdint>
#include <filesystem>
#include <string>

#include "tools/output/frame_sink.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

class ApngFile final : public FrameSink {
public:
    /// As OutputFile. The file is kept in memory until it is complete, because its beginning has the number of frames.
    ApngFile(const std::filesystem::path& path, const FrameSinkOptions& options);
    ~ApngFile() override { wait(); }

private:
    void put(const Picture& picture, std::uint32_t number) override;
    void end() override;

    OutputFile file_;
    std::uint32_t fps_;
    std::uint32_t count_ = 0;
    std::string header_, frames_;  // Up to acTL, and after it.
    Picture last_;
    std::uint32_t sequence_ = 0;  // Of the next fcTL or fdAT.
};

}  // namespace rimline::tools
