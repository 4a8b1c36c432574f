#include "tools/output/part_name.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/tools/scratch_folder.h"

using rimline::tests::ScratchFolder;
using rimline::tests::write_bytes;
using rimline::tools::lock_part;
using rimline::tools::part_name;
using rimline::tools::remove_dead_parts;
namespace fs = std::filesystem;

namespace {

// The number of a process that has ended. The system gives it to no other before it has counted around.
std::string ended_process() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    return std::to_string(child);
}

}  // namespace

TEST_CASE("a part file is hidden and named after its target and process") {
    const std::string process = std::to_string(getpid());
    CHECK(part_name("a/b/lines.svg", 0) == ".lines.svg." + process + ".0.part");
    CHECK(part_name("lines", 12) == ".lines." + process + ".12.part");
}

TEST_CASE("part files of processes that have ended are removed and nothing else") {
    const ScratchFolder folder;
    const std::string dead = ended_process();
    const std::string living = std::to_string(getpid());
    for (const std::string& name :
         {".a.svg." + dead + ".0.part", ".c.d." + dead + ".3.part", ".b.png." + dead + ".17.part"})
        write_bytes(folder / name, "half");
    const std::string kept[] = {part_name("a.svg", 0),
                                ".a.svg." + living + ".1.part",
                                "a.svg." + dead + ".0.part",
                                ".a.svg." + dead + ".0.parts",
                                ".a.svg." + dead + ".part",
                                ".a.svg." + dead + "x.0.part",
                                "." + dead + ".0.part",
                                ".a.svg.-7.0.part",
                                ".a.svg.0.0.part",
                                ".part",
                                "a.svg"};
    for (const std::string& name : kept) write_bytes(folder / name, "kept");
    fs::create_directory(folder / (".folder." + dead + ".0.part"));
    fs::create_symlink("a.svg", folder / (".link." + dead + ".0.part"));
    remove_dead_parts(folder / "");
    CHECK(folder.entry_count() == std::size(kept) + 2);
    for (const std::string& name : kept) {
        CAPTURE(name);
        CHECK(fs::exists(folder / name));
    }
}

TEST_CASE("a process whose parent has not asked for it has ended") {
    const ScratchFolder folder;
    const pid_t child = fork();
    if (child == 0) _exit(0);
    siginfo_t info{};
    REQUIRE(waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) == 0);
    const fs::path part = folder / (".a.svg." + std::to_string(child) + ".0.part");
    write_bytes(part, "half");
    remove_dead_parts(folder / "");
    CHECK_FALSE(fs::exists(part));
    waitpid(child, nullptr, 0);
}

TEST_CASE("a part file that a program of another machine has locked stays") {
    const ScratchFolder folder;
    const fs::path part = folder / (".a.svg." + ended_process() + ".0.part");
    const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    REQUIRE(descriptor >= 0);
    lock_part(descriptor);
    remove_dead_parts(folder / "");
    CHECK(fs::exists(part));
    close(descriptor);
    // A folder is looked at once.
    remove_dead_parts(folder / "");
    CHECK(fs::exists(part));
    remove_dead_parts(folder / ".");
    CHECK_FALSE(fs::exists(part));
}

TEST_CASE("a folder that is not there is no error for who looks for part files") {
    const ScratchFolder folder;
    CHECK_NOTHROW(remove_dead_parts(folder / "none"));
    CHECK(folder.entry_count() == 0);
}
