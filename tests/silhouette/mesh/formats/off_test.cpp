#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE("OFF: the plain kind is read, with or without its word and its edge count") {
    const std::string body = sample_off().substr(sample_off().find("13 5 0") + 6);
    for (const std::string begin : {"OFF\n13 5 0", "OFF 13 5 0", "OFF # x\n\n 13 5", "13 5 0",
                                    "OFF\n13\n5\n0", "OFF13 5 0", "# first\nOFF\n13 5 99"}) {
        CAPTURE(begin);
        const MeshSource source = read_text("a.off", begin + body);
        CHECK(source.positions == sample_positions());
        CHECK(source.triangles == sample_triangles());
    }
}

TEST_CASE("OFF: positions and corners are found beside normals, colors and texture coordinates") {
    struct Kind {
        const char* word;
        const char* extra;
    };
    for (const Kind& kind :
         {Kind{"COFF", " 255 0 0"}, Kind{"COFF", " 1 0.5 0 1"}, Kind{"NOFF", " 0 0 1"},
          Kind{"CNOFF", " 0 0 1 1 0 0 1"}, Kind{"STOFF", " 0.5 0.5"},
          Kind{"STCNOFF", " 0 0 1 1 0 0 1 0.5 0.5"}}) {
        CAPTURE(kind.word);
        const std::string extra = kind.extra;
        const MeshSource source =
            read_text("a.off", std::string(kind.word) + "\n4 2 0\n0 0 0" + extra + "\n1 0 0" +
                                   extra + "\n1 1 0" + extra + "\n0 1 0" + extra +
                                   "\n3 0 1 2 255 0 0 # red\n4 0 1 2 3 0.1 0.2 0.3 1\n");
        CHECK(source.positions[2] == glm::vec3(1, 1, 0));
        CHECK(source.triangles == Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}});
    }
}

TEST_CASE("OFF: what is wrong is named with its line") {
    const auto error = [](const std::string& bytes) { return error_of("a.off", bytes); };
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    CHECK(error("OFF\n3 1 0\n" + points + "3 0 1 2\n").empty());
    CHECK(
        has(error("4OFF\n3 1 0\n" + points + "3 0 1 2\n"), "a.off:1: '4OFF' has other than three"));
    CHECK(has(error("nOFF 3\n3 1 0\n" + points + "3 0 1 2\n"), "a.off:1: 'nOFF'"));
    CHECK(has(error("OFF BINARY\n3 1 0\n"), "a.off:1: binary OFF is not supported"));
    CHECK(has(error("OFFICE\n3 1 0\n"), "a.off:1: 'OFFICE' is no kind of OFF"));
    CHECK(has(error("OFF\n3 1 0\n" + points + "3 0 1 3\n"), "a.off:6: vertex index 3 is out of"));
    CHECK(has(error("OFF\n3 1 0\n" + points + "3 0 1 -2\n"), "a.off:6: vertex index -2 is out of"));
    CHECK(has(error("OFF\n3 1 0\n" + points + "2 0 1    \n"), "a.off:6: a face has 2 corners"));
    CHECK(has(error("OFF\n3 1 0\n" + points + "3 0 1 2 1 1 1 1 1\n"), "a.off:6: '1' after a face"));
    CHECK(has(error("OFF\n3 1 0\n" + points + "3 0 1 2\n3 0 1 2\n"), "a.off:7: there is more"));
    CHECK(has(
        error("OFF\n3 1 0\n0 0 0\n1 0 0 5\n0 1 0\n3 0 1 2\n"),
        "a.off:5: a face has 0 corners; it needs 3 or more (line 4 holds more than one vertex "));
    CHECK(has(error("OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "a.off:4:"));
    CHECK(has(error("OFF\n3 2 0\n" + points + "3 0 1 2          \n"), "a.off:6: the file ends"));
    CHECK(has(error("OFF\n3000000000 1 0\n" + points), "a.off:2: 3000000000 vertices"));
    CHECK(has(error("OFF\n-3 1 0\n" + points), "a.off:2: the vertex count is negative"));
    CHECK(has(error("OFF\n3\n"), "a.off:2: the file ends where the face count"));
    CHECK(has(error("OFF"), "a.off:1: the file ends where the counts"));
}

TEST_CASE("OFF: vertices may share lines and be spread over several") {
    const std::vector<glm::vec3> expected{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const std::string points :
         {"0 0 0 1 0 0\n1 1 0 0 1 0\n", "0\n0\n0\n1 0\n0 1 1 0\n0 1 # half\n\n0\n",
          "0 0 0 1 0 0 1 1 0 0 1 0\n"}) {
        CAPTURE(points);
        const MeshSource source =
            read_text("a.off", "OFF 4 2 0\n" + points + "3 0\n1 2 1 0 0\n4 0 1 2\n3\n");
        CHECK(source.positions == expected);
        CHECK(source.triangles == Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}});
    }
    // Where the line does not say how many numbers a color has, it has Geomview's four.
    CHECK(read_text("a.off", "COFF\n3 1 0\n0 0 0 1 1 1 1 1 0 0\n1 1 1 1 1 1 0 1 1 1 1\n3 0 1 2\n")
              .positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    CHECK(has(error_of("a.off", "OFF\n4 1 0\n0 0 0 1 0 0\n1 1 0 0 1            \n"),
              "a.off:4: the file ends where"));
}
