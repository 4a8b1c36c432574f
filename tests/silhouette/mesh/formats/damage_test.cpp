// Files that are cut short or altered: an error that names the file, or exactly what the bytes say.

#include <algorithm>
#include <cstdlib>
#include <random>
#include <sstream>

#include "tests/rounds.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// What a file says, or nothing when it is refused. Fails the test for anything else.
std::optional<MeshSource> outcome(const std::filesystem::path& path) {
    try {
        MeshSource source = read_mesh_file(path, FaceRequirement::faces_or_points);
        REQUIRE(is_sound(source));
        return source;
    } catch (const Error& e) {
        REQUIRE(std::string(e.what()).starts_with(path.string() + ":"));
        return std::nullopt;
    }
}

// A second reader of plain OBJ, a line at a time with the standard library.
std::optional<MeshSource> plain_obj(const std::string& text) {
    MeshSource source;
    const std::vector<std::string> known{"#", "mtllib", "o", "vn", "vt", "g", "s", "usemtl"};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        if (!(words >> keyword)) continue;
        std::vector<std::string> rest;
        for (std::string word; words >> word;) rest.push_back(word);
        if (keyword == "v" || keyword == "vn") {
            if (rest.size() != 3) return std::nullopt;
            glm::vec3 p;
            for (int i = 0; i < 3; ++i) {
                char* end = nullptr;
                p[i] = std::strtof(rest[i].c_str(), &end);
                if (*end != '\0' || end == rest[i].c_str()) return std::nullopt;
            }
            if (keyword == "v") source.positions.push_back(p);
        } else if (keyword == "f") {
            if (rest.size() != 3) return std::nullopt;
            std::array<std::uint32_t, 3> t{};
            for (int i = 0; i < 3; ++i) {
                const int v = std::atoi(rest[i].c_str());
                if (v < 1 || v > 13) return std::nullopt;
                t[i] = static_cast<std::uint32_t>(v - 1);
            }
            source.triangles.push_back(t);
        } else if (keyword == "vt") {
            if (rest.empty() || rest[0] == "." || rest.back() == "-") return std::nullopt;
        } else if (std::find(known.begin(), known.end(), keyword) == known.end() &&
                   keyword[0] != '#') {
            return std::nullopt;
        }
    }
    if (source.positions.empty()) return std::nullopt;
    return source;
}

bool same(const MeshSource& a, const MeshSource& b) {
    return a.positions == b.positions && a.triangles == b.triangles;
}

}  // namespace

TEST_CASE("Every prefix of a binary file, and of a JSON one, is an error") {
    const ScratchFolder folder;
    for (const SampleFile& sample : sample_files()) {
        if (sample.name.starts_with("text") || sample.name == "sample.off" ||
            sample.name == "sample.obj")
            continue;
        REQUIRE(outcome(folder.write(sample.name, sample.bytes)));
        for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
            CAPTURE(sample.name);
            CAPTURE(size);
            CHECK(!outcome(folder.write(sample.name, sample.bytes.substr(0, size))));
        }
    }
}

TEST_CASE("A prefix of a counted text file is an error, or has lost digits of its last number") {
    const ScratchFolder folder;
    for (const SampleFile& sample :
         {SampleFile{"text.ply", sample_ply_text()}, SampleFile{"sample.off", sample_off()}}) {
        const std::size_t last = sample.bytes.rfind(' ') + 1;
        REQUIRE(sample.bytes.substr(last) == "12\n");
        for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
            CAPTURE(sample.name);
            CAPTURE(size);
            const auto result = outcome(folder.write(sample.name, sample.bytes.substr(0, size)));
            REQUIRE(result.has_value() == (size > last));
            if (!result) continue;
            Triangles expected = sample_triangles();
            expected.back()[2] = size == last + 1 ? 1 : 12;
            CHECK(result->positions == sample_positions());
            CHECK(result->triangles == expected);
        }
    }
}

TEST_CASE("A prefix of a text STL is an error until its endsolid") {
    const ScratchFolder folder;
    const std::string bytes = sample_stl_text();
    const std::size_t whole = bytes.rfind("endsolid") + 8;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        CAPTURE(size);
        const auto result = outcome(folder.write("text.stl", bytes.substr(0, size)));
        REQUIRE(result.has_value() == (size >= whole));
        if (result) CHECK(result->positions == sample_soup());
    }
}

TEST_CASE("A prefix of an OBJ is what a second reader makes of its lines") {
    const ScratchFolder folder;
    const std::string bytes = sample_obj();
    int accepted = 0;
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        const std::string prefix = bytes.substr(0, size);
        CAPTURE(prefix);
        const auto result = outcome(folder.write("sample.obj", prefix));
        const auto expected = plain_obj(prefix);
        REQUIRE(result.has_value() == expected.has_value());
        if (result) CHECK(same(*result, *expected));
        accepted += result.has_value();
    }
    CHECK(accepted > 50);
}

TEST_CASE("Random damage gives an error or a sound model, never a crash") {
    const ScratchFolder folder;
    const std::uint32_t seed = 20260;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    const std::string_view telling = "0123456789-+.eE \n\r\t/\\#{}[],:\"naif\0\xff\x7f\x80";
    int refused = 0;
    for (const SampleFile& sample : sample_files()) {
        for (int round = 0; round < tests::rounds(2000); ++round) {
            std::string bytes = sample.bytes;
            for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
                const std::size_t at = below(bytes.size());
                switch (below(5)) {
                    case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
                    case 1: bytes[at] = telling[below(telling.size())]; break;
                    case 2: bytes.erase(at, 1 + below(8)); break;
                    case 3: bytes.insert(at, 1, telling[below(telling.size())]); break;
                    default: bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(40)));
                }
            }
            CAPTURE(sample.name);
            CAPTURE(round);
            refused += !outcome(folder.write(sample.name, bytes));
        }
    }
    CHECK(refused > tests::rounds(6000));
}

TEST_CASE("Every byte set to telling values in turn is survived") {
    const ScratchFolder folder;
    const std::string_view values(
        "\0\x7f\x80\xff"
        "9-",
        6);
    for (const SampleFile& sample : sample_files()) {
        for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
            std::string bytes = sample.bytes;
            bytes[at] = values[at % values.size()];
            CAPTURE(sample.name);
            CAPTURE(at);
            outcome(folder.write(sample.name, bytes));
        }
    }
}
