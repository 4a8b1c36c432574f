#include "tools/output/output_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "silhouette/error.h"
#include "tests/skip.h"
#include "tests/tools/scratch_folder.h"
#include "tools/command.h"

using rimline::Error;
using rimline::ErrorCode;
using rimline::tests::read_bytes;
using rimline::tests::ScratchFolder;
using rimline::tests::write_bytes;
using rimline::tools::OutputFile;
using rimline::tools::UsageError;
namespace fs = std::filesystem;

namespace {

// The message of the Error{io} that opening `path` throws; empty when it opens.
std::string refusal(const fs::path& path) {
    try {
        OutputFile file(path);
    } catch (const Error& e) {
        CHECK(e.code() == ErrorCode::io);
        return e.what();
    }
    return {};
}

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    REQUIRE(stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

}  // namespace

TEST_CASE("a file appears with all its bytes when it is committed, and not before") {
    const ScratchFolder folder;
    std::string bytes;
    for (std::uint32_t i = 0; i < 200'000; ++i) bytes += static_cast<char>(i * i >> 3);
    OutputFile file(folder / "a.bin");
    file.write(bytes);
    file.write("tail\n");
    CHECK_FALSE(fs::exists(folder / "a.bin"));
    file.commit();
    CHECK(read_bytes(folder / "a.bin") == bytes + "tail\n");
    CHECK(folder.entry_count() == 1);
}

TEST_CASE("a file that is not committed leaves the old one and nothing else") {
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "old");
    try {
        OutputFile file(folder / "a.txt");
        file.write("half of the ne");
        throw Error(ErrorCode::cancelled, "cancelled");
    } catch (const Error&) {
    }
    CHECK(read_bytes(folder / "a.txt") == "old");
    CHECK(folder.entry_count() == 1);
}

TEST_CASE("a committed file replaces the old one and keeps its permissions") {
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "a longer old text");
    fs::permissions(folder / "a.txt", fs::perms(0640));
    OutputFile file(folder / "a.txt");
    file.write("new");
    file.commit();
    CHECK(read_bytes(folder / "a.txt") == "new");
    CHECK(mode_of(folder / "a.txt") == 0640);
}

TEST_CASE("a new file has the permissions that the user's mask leaves") {
    const ScratchFolder folder;
    const mode_t mask = umask(027);
    OutputFile file(folder / "a.txt");
    umask(mask);
    file.commit();
    CHECK(mode_of(folder / "a.txt") == 0640);
}

TEST_CASE("a link is followed, so that it stays one") {
    const ScratchFolder folder;
    write_bytes(folder / "target.txt", "old");
    fs::create_symlink("target.txt", folder / "link.txt");
    OutputFile file(folder / "link.txt");
    file.write("new");
    file.commit();
    CHECK(fs::is_symlink(folder / "link.txt"));
    CHECK(read_bytes(folder / "target.txt") == "new");
}

TEST_CASE("links are followed to where nothing is yet, and not around in circles") {
    const ScratchFolder folder;
    fs::create_directory(folder / "sub");
    fs::create_symlink("sub/second.txt", folder / "first.txt");
    fs::create_symlink("../target.txt", folder / "sub/second.txt");
    OutputFile file(folder / "first.txt");
    file.write("new");
    file.commit();
    CHECK(fs::is_symlink(folder / "first.txt"));
    CHECK(fs::is_symlink(folder / "sub/second.txt"));
    CHECK(read_bytes(folder / "target.txt") == "new");
    fs::create_symlink("b.txt", folder / "a.txt");
    fs::create_symlink("a.txt", folder / "b.txt");
    CHECK(refusal(folder / "a.txt").find("cannot follow the link") != std::string::npos);
    fs::create_symlink("no/such/c.txt", folder / "c.txt");
    CHECK(refusal(folder / "c.txt").find("no folder") != std::string::npos);
}

TEST_CASE("a link to a pipe that has no name is written to") {
    if (!fs::exists("/proc/self/fd")) RIMLINE_SKIP("no /proc/self/fd");
    const ScratchFolder folder;
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    fs::create_symlink("/proc/self/fd/" + std::to_string(ends[1]), folder / "out");
    {
        OutputFile file(folder / "out");
        file.write("bytes");
        file.commit();
    }
    std::array<char, 16> bytes{};
    CHECK(read(ends[0], bytes.data(), bytes.size()) == 5);
    CHECK(std::string(bytes.data()) == "bytes");
    close(ends[0]);
    close(ends[1]);
    CHECK(fs::is_symlink(folder / "out"));
}

TEST_CASE("the model that is read is not written, by whatever name") {
    const ScratchFolder folder;
    write_bytes(folder / "a.obj", "v 0 0 0");
    fs::create_symlink("a.obj", folder / "link.obj");
    fs::create_hard_link(folder / "a.obj", folder / "other.obj");
    for (const char* name : {"a.obj", "./a.obj", "link.obj", "other.obj"}) {
        CAPTURE(name);
        CHECK_THROWS_AS(OutputFile(folder / name, folder / "a.obj"), UsageError);
    }
    CHECK_THROWS_AS(OutputFile(folder / "a.obj", folder / "link.obj"), UsageError);
    CHECK_NOTHROW(OutputFile(folder / "b.obj", folder / "a.obj"));
    CHECK_NOTHROW(OutputFile(folder / "a.obj", "shape:box"));
    CHECK_NOTHROW(OutputFile(folder / "b.obj", folder / "b.obj"));  // Neither is there.
    CHECK(read_bytes(folder / "a.obj") == "v 0 0 0");
    CHECK(folder.entry_count() == 3);
}

TEST_CASE("a file has no name before it is committed") {
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "old");
    OutputFile file(folder / "a.txt");
    if (!file.temporary().string().starts_with("/proc/"))
        RIMLINE_SKIP("the file system of temporary files has no files without names");
    file.write("new");
    CHECK(folder.entry_count() == 1);
    CHECK(read_bytes(folder / "a.txt") == "old");
    file.commit();
    CHECK(read_bytes(folder / "a.txt") == "new");
    CHECK(folder.entry_count() == 1);
}

TEST_CASE("another program can write the file before it is committed") {
    const ScratchFolder folder;
    OutputFile file(folder / "a.txt");
    write_bytes(file.temporary(), "longer than what follows");
    write_bytes(file.temporary(), "written");
    file.commit();
    CHECK(read_bytes(folder / "a.txt") == "written");
    CHECK(folder.entry_count() == 1);
    CHECK(OutputFile("/dev/null").temporary().empty());
}

TEST_CASE("part files of killed programs are removed by the next that writes beside them") {
    const ScratchFolder folder;
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    write_bytes(folder / (".other.svg." + std::to_string(child) + ".0.part"), "half");
    const OutputFile file(folder / "a.txt");
    CHECK_FALSE(fs::exists(folder / (".other.svg." + std::to_string(child) + ".0.part")));
}

TEST_CASE("a missing folder, a folder as target and an empty name are refused by name") {
    const ScratchFolder folder;
    const std::string missing = refusal(folder / "no/such/a.txt");
    CHECK(missing.find((folder / "no/such/a.txt").string()) == 0);
    CHECK(missing.find("no folder") != std::string::npos);
    fs::create_directory(folder / "sub");
    const std::string is_folder = refusal(folder / "sub");
    CHECK(is_folder.find((folder / "sub").string()) == 0);
    CHECK(is_folder.find("it is a folder") != std::string::npos);
    CHECK(refusal("") != "");
    write_bytes(folder / "plain", "x");
    CHECK(refusal(folder / "plain/a.txt") != "");
    CHECK(folder.entry_count() == 2);
}

TEST_CASE("a device is written to and stays a device") {
    OutputFile null("/dev/null");
    null.write("gone");
    null.commit();
    CHECK(fs::is_character_file("/dev/null"));
    if (!fs::is_character_file("/dev/full")) RIMLINE_SKIP("no /dev/full");
    OutputFile full("/dev/full");
    CHECK_THROWS_AS(full.write("no room"), Error);
}
