#include "tools/output/output_folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

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

TEST_CASE("a folder is made where its parent is, by links too, and else the parent is named") {
    const tests::ScratchFolder scratch;
    std::filesystem::create_directories(scratch / "there/deep");
    std::filesystem::create_directory_symlink("there/deep", scratch / "link");
    for (const char* name : {"a", "b/", "link/../c", "link/../d/"})
        CHECK_NOTHROW(OutputFolder(scratch / name, "frames"));
    for (const char* name : {"no/a", "no/b/"}) {
        CAPTURE(name);
        std::string message;
        try {
            OutputFolder(scratch / name, "frames");
        } catch (const Error& error) {
            message = error.what();
        }
        CHECK(message.ends_with("there is no folder " + (scratch / "no").string() +
                                "; create it first"));
    }
}

}  // namespace
}  // namespace rimline::tools
