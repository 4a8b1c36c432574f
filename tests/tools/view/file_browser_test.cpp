#include "tools/view/file_browser.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/scratch_folder.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("recent files are kept for the next time, newest first, each once") {
    const tests::ScratchFolder folder;
    const std::filesystem::path kept = folder / "state/rimline/recent";
    {
        RecentFiles recent(kept);
        CHECK(recent.names().empty());
        for (int i = 0; i < 14; ++i) {
            const std::string name = (folder / (std::to_string(i) + ".ply")).string();
            tests::write_bytes(name, "ply\n");
            recent.add(name);
        }
        recent.add("shape:knot");                       // No file.
        recent.add((folder / "missing.obj").string());  // Neither.
        recent.add((folder / "9.ply").string());
        REQUIRE(recent.names().size() == RecentFiles::k_most);
        CHECK(recent.names()[0] == (folder / "9.ply").string());
        CHECK(recent.names()[1] == (folder / "13.ply").string());
    }
    const RecentFiles again(kept);
    REQUIRE(again.names().size() == RecentFiles::k_most);
    CHECK(again.names()[0] == (folder / "9.ply").string());
    CHECK(again.names()[2] == (folder / "12.ply").string());
    // A place that cannot be written is no error.
    RecentFiles nowhere("/proc/rimline/recent");
    nowhere.add((folder / "1.ply").string());
    CHECK(nowhere.names().size() == 1);
}

TEST_CASE("a folder is listed with its folders and what may be models") {
    const tests::ScratchFolder folder;
    for (const char* name : {"b.OBJ", "a.ply", "notes.md", ".hidden.ply", "cloud.xyz"})
        tests::write_bytes((folder / name).string(), "x");
    std::filesystem::create_directory(folder / "models");
    std::filesystem::create_directory(folder / ".git");
    const FolderListing listing = list_folder(folder / "");
    CHECK(listing.folders == std::vector<std::string>{"models"});
    CHECK(listing.files == std::vector<std::string>{"a.ply", "b.OBJ", "cloud.xyz"});
    const FolderListing missing = list_folder(folder / "missing");
    CHECK(missing.folders.empty());
    CHECK(missing.files.empty());
}
