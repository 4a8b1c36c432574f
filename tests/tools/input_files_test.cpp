#include "tools/input_files.h"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>

#include "tests/tools/scratch_folder.h"
#include "tools/command.h"
#include "tools/output/output_file.h"
#include "tools/output/output_folder.h"

using rimline::tests::read_bytes;
using rimline::tests::ScratchFolder;
using rimline::tests::write_bytes;
using rimline::tools::declare_inputs;
using rimline::tools::OutputFile;
using rimline::tools::OutputFolder;
using rimline::tools::UsageError;
namespace fs = std::filesystem;

TEST_CASE("a file that the model refers to is not written, by whatever name") {
    const ScratchFolder folder;
    write_bytes(folder / "wood.png", "wood");
    fs::create_symlink("wood.png", folder / "link.png");
    fs::create_hard_link(folder / "wood.png", folder / "other.png");
    declare_inputs(std::array{folder / "wood.png", folder / "missing.png"});
    for (const char* name : {"wood.png", "link.png", "other.png"}) {
        CAPTURE(name);
        CHECK_THROWS_AS(OutputFile(folder / name), UsageError);
    }
    CHECK_NOTHROW(OutputFile(folder / "new.png"));
    CHECK_NOTHROW(OutputFile(folder / "missing.png"));
    CHECK(read_bytes(folder / "wood.png") == "wood");
}

TEST_CASE("a model that refers to a file that is being written is refused") {
    const ScratchFolder folder;
    write_bytes(folder / "wood.png", "wood");
    write_bytes(folder / "stone.png", "stone");
    {
        const OutputFile other(folder / "picture.png");
        OutputFile file(folder / "wood.png");
        const OutputFile third(folder / "third.png");
        CHECK_THROWS_WITH_AS(declare_inputs(std::array{folder / "stone.png", folder / "wood.png"}),
                             ((folder / "wood.png").string() +
                              ": the model refers to this file; name another file to write")
                                 .c_str(),
                             UsageError);
    }
    // No claim is left.
    CHECK_NOTHROW(declare_inputs(std::array{folder / "wood.png"}));
    CHECK(read_bytes(folder / "wood.png") == "wood");
}

TEST_CASE("numbered pictures are not removed where the model refers to one") {
    const ScratchFolder folder;
    for (const char* name : {"frame_0000.png", "frame_0001.png"})
        write_bytes(folder / name, "texture");
    declare_inputs(std::array{folder / "frame_0001.png"});
    const OutputFolder frames(folder / "", "frames");
    CHECK_THROWS_AS(frames.remove_numbered("frame_", 4), UsageError);
    CHECK(folder.entry_count() == 2);
}
