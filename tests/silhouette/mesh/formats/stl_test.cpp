#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE(
    "STL: text and binary give facets in order, z up, also a binary one that begins with solid") {
    for (const std::string& bytes : {sample_stl_text(), sample_stl_binary(),
                                     sample_stl_binary("solid"), sample_stl_binary("ply")}) {
        const MeshSource source = read_text("a.stl", bytes);
        CHECK(source.positions == sample_soup());
        CHECK(source.up == UpAxis::z);
        REQUIRE(source.triangles.size() == 5);
        for (std::uint32_t i = 0; i < 5; ++i)
            CHECK(source.triangles[i] == std::array<std::uint32_t, 3>{3 * i, 3 * i + 1, 3 * i + 2});
    }
}

TEST_CASE("STL: several solids, any case, any layout and a normal of NaN are read") {
    const std::string facet =
        "FACET NORMAL nan -nan(ind) inf OUTER LOOP VERTEX 0 0 0 vertex 1 0 0\nvertex 0\n1 0 "
        "endloop "
        "endfacet\n";
    const MeshSource source = read_text(
        "a.stl", "solid\n" + facet + "endsolid\nSolid b c d\n" + facet + facet + "EndSolid b c d");
    CHECK(source.triangles.size() == 3);
    CHECK(source.positions[2] == glm::vec3(0, 1, 0));
}

TEST_CASE("STL: what is wrong is named with its line or byte") {
    const auto error = [](const std::string& bytes) { return error_of("a.stl", bytes); };
    const auto facet = [](const std::string& third) {
        return "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n" + third +
               "\nendloop\nendfacet\nendsolid x\n";
    };
    CHECK(error(facet("vertex 0 1 0")).empty());
    CHECK(has(error(facet("vertex 0 one 0")), "a.stl:6: 'one' is not a number"));
    CHECK(has(error(facet("vertex 0 inf 0")), "a.stl:6: a vertex's coordinate is 'inf'"));
    CHECK(has(error(facet("vertex 0 1 0\nvertex 0 0 1")), "a.stl:7: 'vertex' where 'endloop'"));
    CHECK(has(error(facet("")), "a.stl:7: 'endloop' where 'vertex'"));
    CHECK(has(error("solid x\nfacet normal 0 0"), "a.stl:2: the line ends"));
    CHECK(has(error("solid x\n"), "a.stl:1: the file ends before 'endsolid'"));
    CHECK(has(error("solid x\nendsolid\ntrailing\n"), "a.stl:3: 'trailing' where 'solid'"));

    std::string bytes = sample_stl_binary();
    CHECK(has(error(bytes + "x"),
              "a.stl: byte 334: 5 facets are declared, and too many bytes follow them: 1;"));
    CHECK(has(error(bytes.substr(0, 333)),
              "a.stl: byte 80: 5 facets are declared, which take 334 bytes; the file has 333"));
    CHECK(has(error(sample_stl_binary("solid").substr(0, 300)), "a.stl: byte 80: 5 facets"));
    bytes.replace(84 + 12, 4, std::string("\0\0\xc0\x7f", 4));
    CHECK(has(error(bytes), "a.stl: byte 96: a vertex's coordinate is not a finite number"));
    bytes.replace(80, 4, "\xff\xff\xff\xff");
    CHECK(has(error(bytes), "a.stl: byte 80: 4294967295 facets are declared"));
}

TEST_CASE("STL: normals that an old Microsoft library wrote are not looked into") {
    const auto with = [](const std::string& normal, const std::string& x) {
        return "solid\nfacet normal " + normal + "\nouter loop\nvertex 0 0 0\nvertex " + x +
               " 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    };
    for (const char* normal : {"-1.#IND -1.#IND -1.#IND", "1.#QNAN 1.#QNAN0 -1.#IND00",
                               "1.#INF -1.#INF000 0", "nan(ind) -nan(ind) nan"}) {
        CAPTURE(normal);
        CHECK(error_of("a.stl", with(normal, "1")).empty());
    }
    CHECK(has(error_of("a.stl", with("1.#ODD 0 0", "1")), "a.stl:2: '1.#ODD' is not a number"));
    CHECK(has(error_of("a.stl", with("1.# 0 0", "1")), "a.stl:2: '1.#' is not a number"));
    CHECK(has(error_of("a.stl", with("0 0 1", "1.#INF")), "a.stl:5: '1.#INF' is not a number"));
}
