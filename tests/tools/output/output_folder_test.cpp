#include "tools/output/output_folder.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "tests/tools/scratch_folder.h"

namespace rimline::tools {
namespace {

TEST_CASE("pictures of an older run are removed, and nothing else") {
    const tests::ScratchFolder scratch;
    const std::filesystem::path path = scratch / "frames";
    const OutputFolder folder(path, "frames");
    for (const char* name : {"frame_0000.png", "frame_0001.png", "frame_12345.png"})
        tests::write_bytes(path / name, "old");
    std::filesystem::create_directory(path / "frame_7.png");
    const char* const kept[] = {"frame_.png",      "frame_1a.png", "frame_1.jpg",
                                "frame_1.png.txt", "Frame_1.png",  "frames_1.png",
                                "view_1.png",      "frame_-1.png", "frame_123.png"};
    for (const char* name : kept) tests::write_bytes(path / name, "kept");
    folder.remove_numbered("frame_", 4);
    for (const char* name : kept) {
        CAPTURE(name);
        CHECK(std::filesystem::exists(path / name));
    }
    CHECK(std::filesystem::is_directory(path / "frame_7.png"));
    for (const char* name : {"frame_0000.png", "frame_0001.png", "frame_12345.png"}) {
        CAPTURE(name);
        CHECK_FALSE(std::filesystem::exists(path / name));
    }
}

}  // namespace
}  // namespace rimline::tools
