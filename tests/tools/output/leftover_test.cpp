#include "tools/output/leftover.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>

#include "tests/tools/scratch_folder.h"

using rimline::tests::read_bytes;
using rimline::tests::ScratchFolder;
using rimline::tests::write_bytes;
using rimline::tools::Leftover;
using rimline::tools::remove_leftovers;
namespace fs = std::filesystem;

namespace {

int make_file(const fs::path& path) {
    write_bytes(path, "new");
    return 0;
}

int make_folder(const fs::path& path) { return mkdir(path.c_str(), 0777) == 0 ? 0 : errno; }

}  // namespace

TEST_CASE("what is left over is removed with its object") {
    const ScratchFolder folder;
    {
        Leftover sub, file;
        CHECK(sub.make(folder / "sub", make_folder) == 0);
        CHECK(file.make(folder / "sub/a.txt", make_file) == 0);
        CHECK(file.path() == folder / "sub/a.txt");
        CHECK(fs::exists(folder / "sub/a.txt"));
    }
    CHECK(folder.entry_count() == 0);
}

TEST_CASE("what could not be made is not removed") {
    const ScratchFolder folder;
    fs::create_directory(folder / "old");
    {
        Leftover sub;
        CHECK(sub.make(folder / "old", make_folder) == EEXIST);
        CHECK(sub.path().empty());
    }
    remove_leftovers();
    CHECK(fs::exists(folder / "old"));
}

TEST_CASE("a leftover that has its name is left over no more") {
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "old");
    {
        Leftover file;
        REQUIRE(file.make(folder / "part", make_file) == 0);
        CHECK(file.rename_to(folder / "no/such/a.txt") == ENOENT);
        CHECK(file.rename_to(folder / "a.txt") == 0);
        CHECK(file.path().empty());
        remove_leftovers();
    }
    CHECK(read_bytes(folder / "a.txt") == "new");
    CHECK(folder.entry_count() == 1);
}

TEST_CASE("a program that ends at once leaves no leftovers but folders in use") {
    const ScratchFolder folder;
    Leftover sub, used, file, gone;
    REQUIRE(sub.make(folder / "sub", make_folder) == 0);
    REQUIRE(used.make(folder / "used", make_folder) == 0);
    REQUIRE(file.make(folder / "sub/a.txt", make_file) == 0);
    {
        Leftover other;
        REQUIRE(other.make(folder / "other", make_file) == 0);
    }
    write_bytes(folder / "used/frame.png", "picture");
    remove_leftovers();
    CHECK_FALSE(fs::exists(folder / "sub"));
    CHECK(read_bytes(folder / "used/frame.png") == "picture");
    CHECK(file.rename_to(folder / "a.txt") == ENOENT);
    CHECK(folder.entry_count() == 1);
}
