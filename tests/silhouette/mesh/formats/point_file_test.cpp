#include "silhouette/mesh/formats/point_file.h"

#include <limits>
#include <random>

#include "tests/rounds.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

PointSource read_points(const std::string& name, std::string_view bytes,
                        BadPoints bad = BadPoints::refuse) {
    const ScratchFolder folder;
    return read_point_file(folder.write(name, bytes), bad);
}

// The message of the error it gives, without the folder; empty if it gives none.
std::string point_error(const std::string& name, std::string_view bytes,
                        BadPoints bad = BadPoints::refuse) {
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write(name, bytes);
    try {
        read_point_file(path, bad);
    } catch (const Error& e) {
        const std::string message = e.what();
        REQUIRE(message.starts_with(path.string() + ":"));
        return message.substr(folder.path().string().size() + 1);
    }
    return {};
}

std::vector<glm::dvec3> doubles(const std::vector<glm::vec3>& positions) {
    return {positions.begin(), positions.end()};
}

std::string ply_header(const std::string& format, const std::string& properties, int count) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(count) + "\n" +
           properties + "end_header\n";
}

const std::string k_xyz = "property double x\nproperty double y\nproperty double z\n";

std::string sample_xyz() {
    std::string text = "# made by a test\n";
    for (const glm::vec3& p : sample_positions()) text += text_of(p) + "\n";
    return text;
}

std::string sample_pts() {
    std::string text = std::to_string(sample_positions().size()).append("\n");
    for (const glm::vec3& p : sample_positions()) text += text_of(p) + " -1023 17 255 0\n";
    return text;
}

std::string sample_cloud_ply(std::endian order) {
    Bytes bytes(order);
    bytes.add_text(ply_header(
        order == std::endian::little ? "binary_little_endian" : "binary_big_endian",
        k_xyz + "property float nx\nproperty float ny\nproperty float nz\nproperty list uchar "
                "short extra\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n",
        static_cast<int>(sample_positions().size())));
    for (const glm::vec3& p : sample_positions()) {
        bytes.add<double>(p.x).add<double>(p.y).add<double>(p.z);
        bytes.add(0.0f).add(0.6f).add(-0.8f).add<std::uint8_t>(1).add<std::int16_t>(5);
        bytes.add<std::uint8_t>(17).add<std::uint8_t>(255).add<std::uint8_t>(0);
    }
    return bytes.str();
}

std::vector<SampleFile> sample_clouds() {
    std::vector<SampleFile> files = sample_files();
    files.push_back({"cloud.xyz", sample_xyz()});
    files.push_back({"cloud.pts", sample_pts()});
    files.push_back({"little_cloud.ply", sample_cloud_ply(std::endian::little)});
    files.push_back({"big_cloud.ply", sample_cloud_ply(std::endian::big)});
    return files;
}

// What every PointSource promises.
bool is_sound(const PointSource& source, bool finite) {
    for (const glm::dvec3& p : source.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (std::isfinite(p[axis]) ? std::abs(p[axis]) > 0x1p60 : finite) return false;
    const std::size_t count = source.positions.size();
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= count) return false;
    return (source.normals.empty() || source.normals.size() == count) &&
           (source.colors.empty() || source.colors.size() == count);
}

}  // namespace

TEST_CASE(
    "Points of every format are those the mesh reader finds, and so are the faces kept aside") {
    for (const SampleFile& sample : sample_files()) {
        CAPTURE(sample.name);
        const MeshSource mesh = read_text(sample.name, sample.bytes);
        const PointSource points = read_points(sample.name, sample.bytes);
        CHECK(points.positions == doubles(mesh.positions));
        CHECK(points.triangles == mesh.triangles);
        CHECK(points.up == mesh.up);
    }
    for (const SampleFile& sample : sample_clouds()) {
        CAPTURE(sample.name);
        const PointSource points = read_points(sample.name, sample.bytes);
        const MeshSource mesh =
            read_text(sample.name, sample.bytes, FaceRequirement::faces_or_points);
        CHECK(points.positions == doubles(mesh.positions));
        CHECK(is_sound(points, true));
    }
}

TEST_CASE("Text clouds are known by their content or by their name, and are no meshes") {
    for (const char* name : {"cloud", "cloud.xyz", "cloud.txt", "cloud.asc", "cloud.pts"}) {
        CHECK(read_points(name, sample_xyz()).positions == doubles(sample_positions()));
        CHECK(read_points(name, sample_pts()).positions == doubles(sample_positions()));
        CHECK(
            read_points(name, std::string("\xef\xbb\xbf").append(sample_xyz())).positions.size() ==
            13);
    }
    CHECK(has(error_of("a.xyz", sample_xyz(), FaceRequirement::faces), "13 points only"));
    CHECK(has(point_error("a.xyz", "hello world\n"), "a.xyz:1: 'hello' is not a number"));
    CHECK(has(point_error("a.txt", "hello world\n"), "the format is not known"));
    // Counts without the word OFF begin as a point does: there the name decides.
    const std::string off = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(read_points("a.off", off).triangles.size() == 1);
    CHECK(has(point_error("a.xyz", off), "a.xyz:5: a point with 4 numbers"));
}

TEST_CASE("Positions are doubles: a surveyor's coordinates keep their micrometres") {
    const glm::dvec3 far(1234567.890123, -7654321.000001, 1e6 + 1e-9);
    const std::string text = "1234567.890123 -7654321.000001 1000000.000000001";
    CHECK(read_points("a.xyz", text).positions == std::vector{far});
    CHECK(read_points("a.obj", "v " + text).positions == std::vector{far});
    CHECK(read_points("a.ply", ply_header("ascii", k_xyz, 1) + text).positions == std::vector{far});
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        Bytes bytes(order);
        bytes.add_text(ply_header(
            order == std::endian::little ? "binary_little_endian" : "binary_big_endian", k_xyz, 1));
        bytes.add(far.x).add(far.y).add(far.z);
        CHECK(read_points("a.ply", bytes.str()).positions == std::vector{far});
    }
}

TEST_CASE("PLY: normals and colors are kept where all three parts are there") {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const PointSource source = read_points("a.ply", sample_cloud_ply(order));
        CHECK(source.normals == std::vector(13, glm::vec3(0.0f, 0.6f, -0.8f)));
        CHECK(source.colors == std::vector(13, PointColor{17, 255, 0}));
    }
    const auto with = [](const std::string& properties, const std::string& values) {
        return read_points("a.ply", ply_header("ascii", k_xyz + properties, 1) + "1 2 3 " + values);
    };
    const std::string floats = "property float blue\nproperty float red\nproperty float green\n";
    CHECK(with(floats, "0.5 1 7").colors == std::vector{PointColor{255, 255, 128}});
    const std::string shorts = "property ushort red\nproperty ushort green\nproperty ushort blue\n";
    CHECK(with(shorts, "65535 257 0").colors == std::vector{PointColor{255, 1, 0}});
    const std::string ints = "property int red\nproperty int green\nproperty int blue\n";
    CHECK(with(ints, "-5 254 256").colors == std::vector{PointColor{0, 254, 255}});
    CHECK(with(floats, "nan 1 -1").colors == std::vector{PointColor{255, 0, 0}});
    const PointSource partial =
        with("property float nx\nproperty float ny\nproperty uchar red\n", "0 1 9");
    CHECK(partial.normals.empty());
    CHECK(partial.colors.empty());
    const std::string list = "property float nx\nproperty float ny\nproperty list uchar int nz\n";
    CHECK(with(list, "0 1 2 5 5").normals.empty());
}

TEST_CASE("OBJ: colors are shares of one, or of 255 where one is above") {
    CHECK(read_points("a.obj", "v 0 0 0 1 0.5 0\nv 1 0 0\nv 2 0 0 0 0 0.2 1\n").colors ==
          std::vector<PointColor>{{255, 128, 0}, {0, 0, 0}, {0, 0, 51}});
    CHECK(read_points("a.obj", "v 0 0 0 1 200 0\nv 1 0 0\n").colors ==
          std::vector<PointColor>{{1, 200, 0}, {0, 0, 0}});
    CHECK(read_points("a.obj", "v 0 0 0 1\nv 1 0 0\nvn 0 0 1\nvn 0 0 1\n").colors.empty());
    const auto normals = [](const char* text) { return read_points("a.obj", text).normals; };
    const std::vector<glm::vec3> two{{0, 0, 1}, {0, 1, 0}};
    CHECK(normals("v 0 0 0 1\nv 1 0 0\nvn 0 0 1\nvn 0 1 0\n") == two);
    CHECK(normals("v 0 0 0\nvn 0 0 1\nv 1 0 0\nvn 0 1 0\n") == two);
    CHECK(normals("v 0 0 0\nv 1 0 0\nvn 0 0 1\n").empty());
    // Corners' own: another than the vertex's number anywhere.
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf ";
    CHECK(normals((triangle + "1//1 2//2 3//3").c_str()).size() == 3);
    CHECK(normals((triangle + "-3//1 2//-2 3").c_str()).size() == 3);
    CHECK(normals((triangle + "1//2 2//1 3//3").c_str()).empty());
    CHECK(has(point_error("a.obj", "v 0 0 0 1 2\n"), "a.obj:1: a vertex with 5 numbers"));
}

TEST_CASE("Text: columns are positions, intensities, normals and colors as their values say") {
    const auto columns = [](const std::string& rest) {
        std::string text;
        for (const char* position : {"1 2 3 ", "4 5 6 ", "7 8 9 "})
            text.append(position).append(rest).append("\n");
        const PointSource source = read_points("a.xyz", text);
        CHECK(source.positions == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
        return source;
    };
    const std::vector<glm::vec3> normals(3, glm::vec3(0.0f, 0.6f, -0.8f));
    const std::vector<PointColor> colors(3, PointColor{10, 20, 255});
    const std::string n = "0 0.6 -0.8";
    const std::string c = "10 20 255";
    struct Case {
        std::string rest;
        bool has_normals, has_colors;
    };
    for (const Case& test :
         {Case{"", false, false}, Case{"-1023", false, false}, Case{n, true, false},
          Case{c, false, true}, Case{"0.5 " + c, false, true}, Case{"0.5 " + n, true, false},
          Case{c + " " + n, true, true}, Case{n + " " + c, true, true},
          Case{"7 " + n + " " + c, true, true}, Case{"7 8", false, false},
          Case{"0.5 0.5 0.5", false, false}, Case{"256 0 0", false, false},
          Case{"7 8 9 10 11", false, false}, Case{"1 2 3 4 5 6 7 8 9", false, false}}) {
        CAPTURE(test.rest);
        const PointSource source = columns(test.rest);
        CHECK(source.normals == (test.has_normals ? normals : std::vector<glm::vec3>{}));
        CHECK(source.colors == (test.has_colors ? colors : std::vector<PointColor>{}));
    }
    for (const auto& [rest, intensity] : {std::pair{std::string("-1023"), -1023.0f},
                                          {"0.5 " + c, 0.5f},
                                          {"7 " + n + " " + c, 7.0f}})
        CHECK(columns(rest).intensities == std::vector(3, intensity));
    for (const std::string& rest : {std::string(), n, c, c + " " + n, std::string("7 8")})
        CHECK(columns(rest).intensities.empty());
    // Lengths of one with whole numbers are normals; all zero is black.
    CHECK(columns("0 0 1").normals == std::vector(3, glm::vec3(0, 0, 1)));
    CHECK(columns("0 0 0").normals.empty());
    CHECK(columns("0 0 0").colors == std::vector(3, PointColor{0, 0, 0}));
}

TEST_CASE("PTS: counts stand before the points they count") {
    CHECK(read_points("a.pts", sample_pts()).colors == std::vector(13, PointColor{17, 255, 0}));
    CHECK(read_points("a.pts", "1\n1 2 3\n2\n4 5 6\n7 8 9\n").positions.size() == 3);
    CHECK(read_points("a.pts", "0\n1\n4 5 6\n").positions.size() == 1);
    CHECK(has(point_error("a.pts", "2\n1.25 2.25 3.25\n"),
              "the file ends where point 2 of 2 should follow"));
    CHECK(has(point_error("a.pts", "9\n1 2 3\n4 5 6\n"), "a.pts:1: 9 points are more than"));
    CHECK(has(point_error("a.pts", "1\n1 2 3\n4 5 6\n"), "a.pts:3: there are more points than"));
    CHECK(has(point_error("a.pts", "1 2 3\n4\n5 6 7\n"), "a.pts:2: a line with one number"));
    CHECK(has(point_error("a.pts", "2\n1 2 3\n1\n5 6 7\n"), "a.pts:3: a line with one number"));
    CHECK(has(point_error("a.pts", "-1\n1 2 3\n"), "-1 points are more than"));
    CHECK(has(point_error("a.pts", "1.5\n1 2 3\n"), "'1.5' is not an integer"));
    CHECK(has(point_error("a.pts", "0\n"), "no points"));
}

TEST_CASE("Text: lines that begin with # or // are comments") {
    const std::string text = "//X Y Z\n# of three\n1 2 3\n#4 5 6\n\n // 7 8 9\n4 5 6\n";
    CHECK(read_points("a.xyz", text).positions == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(has(point_error("a.xyz", "1 2 3 # one\n"), "a.xyz:1: '#' is not a number"));
}

TEST_CASE("Text: lines of another width, words and short lines are errors with their line") {
    CHECK(has(point_error("a.xyz", "1 2 3\n4 5\n"), "a.xyz:2: a point with 2 numbers"));
    CHECK(has(point_error("a.xyz", "1 2 3\n4 5 6 7\n"),
              "a.xyz:2: a point with 4 numbers, where those before it have 3"));
    CHECK(has(point_error("a.xyz", "1 2 3\n\n4 x 6\n"), "a.xyz:3: 'x' is not a number"));
    std::string wide;
    for (int i = 0; i < 65; ++i) wide.append(std::to_string(i)).push_back(' ');
    CHECK(has(point_error("a.xyz", wide), "more than 64 numbers"));
}

TEST_CASE("Text: commas or semicolons separate columns, and the first line may name them") {
    const std::vector<glm::dvec3> expected{{1, 2, 3}, {-4, 0.5, 6}};
    for (const char* text :
         {"1,2,3\n-4,.5,6\n", "1, 2 ,3\r\n -4,0.5, 6 ,\r\n", "1;2;3\n-4;0.5;6",
          "x y z\n1 2 3\n-4 0.5 6\n", "X,Y,Z,Intensity\n1,2,3,0\n-4,0.5,6,1\n",
          "\"x\"; \"y\"; \"z\"\n1;2;3\n-4;0.5;6\n", "# exported\nx\ty\tz\n1\t2\t3\n-4\t0.5\t6\n",
          "2\n1,2,3\n-4,0.5,6\n"}) {
        CAPTURE(text);
        for (const char* name : {"a.xyz", "a.csv"})
            CHECK(read_points(name, text).positions == expected);
    }
    CHECK(read_points("a.txt", "1,2,3\n-4,0.5,6\n").positions == expected);
    const PointSource colored = read_points("a.csv", "x,y,z,r,g,b\n1,2,3,9,8,7\n-4,0.5,6,1,2,3\n");
    REQUIRE(colored.colors.size() == 2);
    CHECK(colored.colors[1] == PointColor{1, 2, 3});
    // Names say where colors begin, as numbers alone could not.
    const PointSource named =
        read_points("a.csv", "x,y,z,R,G,B,Intensity\n1,2,3,9,8,7,5\n-4,0.5,6,1,2,3,5\n");
    REQUIRE(named.colors.size() == 2);
    CHECK(named.colors[1] == PointColor{1, 2, 3});
    CHECK(named.intensities.empty());
    CHECK(read_points("a.csv", "1,2,3,9,8,7,5\n").intensities.size() == 1);
    // Decimals with a comma are not taken for columns.
    CHECK(has(point_error("a.xyz", "0,5 1,2 3,4\n"), "a.xyz:1: '5 1' is not a number"));
    CHECK(has(point_error("a.csv", "0,5;1,2;3,4\n"), "a.csv:1: '0,5' is not a number"));
    CHECK(has(point_error("a.csv", "1,2,3\n1 2 3\n"), "a.csv:2: '1 2 3' is not a number"));
    CHECK(has(point_error("a.csv", "1,,3\n"), "a.csv:1: nothing between two separators"));
    CHECK(has(point_error("a.csv", "1,2,3,,\n"), "a.csv:1: nothing between two separators"));
    CHECK(has(point_error("a.csv", "1,2,3\n4,5\n"), "a.csv:2: a point with 2 numbers"));
    // Other names, and names elsewhere.
    CHECK(has(point_error("a.csv", "id,x,y,z\n1,2,3,4\n"), "a.csv:1: 'id' is not a number"));
    CHECK(has(point_error("a.csv", "1,2,3\nx,y,z\n"), "a.csv:2: 'x' is not a number"));
    CHECK(has(point_error("a.csv", "x,y,z\n"), "a.csv"));
}

TEST_CASE("Points that are not finite are refused with number and place, or keep their numbers") {
    Bytes binary;
    binary.add_text(ply_header("binary_little_endian", k_xyz, 3));
    const std::size_t body = binary.str().size();
    binary.add(1.0).add(2.0).add(3.0).add(1.0).add(static_cast<double>(NAN)).add(3.0);
    binary.add(1.0).add(2.0).add(static_cast<double>(INFINITY));
    struct Case {
        std::string name, bytes, place;
    };
    for (const Case& test :
         {Case{"a.xyz", "1 2 3\n1 nan 3\n1 2 -inf\n", "a.xyz:2"},
          Case{"b.xyz", "1 2 3\n1 -1.#IND 3\n1 2 1e999\n", "b.xyz:2"},
          Case{"a.obj", "v 1 2 3\n# none\nv 1 nan 3\nv 1 2 inf\n", "a.obj:3"},
          Case{"a.ply", ply_header("ascii", k_xyz, 3) + "1 2 3\n1 nan 3\n1 2 inf\n", "a.ply:9"},
          Case{"b.ply", binary.str(), "b.ply: byte " + std::to_string(body + 24)}}) {
        CAPTURE(test.name);
        CHECK(point_error(test.name, test.bytes).starts_with(test.place + ": point 1 is "));
        const PointSource kept = read_points(test.name, test.bytes, BadPoints::keep);
        REQUIRE(kept.positions.size() == 3);
        CHECK(kept.positions[0] == glm::dvec3(1, 2, 3));
        CHECK(std::isnan(kept.positions[1].y));
        CHECK(std::isinf(kept.positions[2].z));
    }
    for (const BadPoints bad : {BadPoints::refuse, BadPoints::keep}) {
        CHECK(has(point_error("a.xyz", "1 2 3\n1 2 -2e18\n", bad),
                  "a.xyz:2: point 1 is 1 2 -2e+18, beyond 2^60"));
        CHECK(point_error("a.xyz", "1 2 3\n1 2 1152921504606846976\n", bad).empty());
    }
    // A mesh with such a point is a cloud all the same, but nothing is true of it.
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\n";
    CHECK(has(point_error("a.obj", mesh), "a.obj:4: point 3"));
    CHECK(read_points("a.obj", mesh, BadPoints::keep).positions.size() == 4);
    CHECK(read_points("a.obj", mesh, BadPoints::keep).triangles.empty());
}

TEST_CASE("Points that are not finite are refused or kept in what is read as a mesh, too") {
    // The first vertex of every sample: its x is NaN, or its z infinite.
    const auto patched = [](std::string bytes, std::size_t offset, float value) {
        std::memcpy(bytes.data() + offset, &value, sizeof value);
        return bytes;
    };
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex X 0 Z\nvertex 1 0 0\n"
        "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    // A square, which must not be cut along a diagonal to nowhere.
    const std::string off = "OFF\n4 1 0\nX 0 Z\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    const auto with = [](std::string text, const char* x, const char* z) {
        text.replace(text.find('X'), 1, x);
        return text.replace(text.find('Z'), 1, z);
    };
    const std::string soup = sample_stl_binary();
    const std::string glb = sample_glb();
    const std::size_t in_soup = 80 + 4 + 12;
    const std::size_t in_glb = glb.size() - 188;  // Positions begin the chunk at its end.
    struct Case {
        std::string name, with_nan, with_infinity, place;
    };
    for (const Case& test :
         {Case{"a.stl", with(stl, "nan", "0"), with(stl, "0", "inf"), "a.stl:4: "},
          Case{"b.stl", patched(soup, in_soup, NAN), patched(soup, in_soup + 8, INFINITY),
               "b.stl: byte "},
          Case{"a.off", with(off, "nan", "0"), with(off, "0", "-inf"), "a.off:3: "},
          Case{"a.glb", patched(glb, in_glb, NAN), patched(glb, in_glb + 8, -INFINITY),
               "a.glb: meshes[0].primitives[0]: vertex 0 is not a finite"}}) {
        CAPTURE(test.name);
        for (const std::string& bytes : {test.with_nan, test.with_infinity}) {
            CHECK(point_error(test.name, bytes).starts_with(test.place));
            CHECK(error_of(test.name, bytes).starts_with(test.place));
            const PointSource kept = read_points(test.name, bytes, BadPoints::keep);
            REQUIRE(kept.positions.size() >= 3);
            CHECK(kept.triangles.empty());
            for (std::size_t p = 1; p < kept.positions.size(); ++p)
                CHECK(std::isfinite(kept.positions[p].x + kept.positions[p].z));
        }
        CHECK(std::isnan(read_points(test.name, test.with_nan, BadPoints::keep).positions[0].x));
        CHECK(
            std::isinf(read_points(test.name, test.with_infinity, BadPoints::keep).positions[0].z));
    }
    // Where all is well the faces are kept aside as ever.
    CHECK(read_points("a.off", with(off, "0", "0"), BadPoints::keep).triangles.size() == 2);
    CHECK(read_points("b.stl", soup, BadPoints::keep).triangles.size() == 5);
}

TEST_CASE("Every prefix of a cloud is an error, or has lost digits of its last number") {
    const ScratchFolder folder;
    for (const SampleFile& sample : sample_clouds()) {
        const bool is_text = sample.name.ends_with(".xyz") || sample.name.ends_with(".pts") ||
                             sample.name.starts_with("text") || sample.name == "sample.off" ||
                             sample.name == "sample.obj";
        for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
            CAPTURE(sample.name);
            CAPTURE(size);
            const std::filesystem::path path =
                folder.write(sample.name, sample.bytes.substr(0, size));
            for (const BadPoints bad : {BadPoints::refuse, BadPoints::keep}) {
                try {
                    const PointSource source = read_point_file(path, bad);
                    REQUIRE(is_sound(source, bad == BadPoints::refuse));
                    CHECK(is_text);
                    // Of counted text all but the last number is there.
                    if (sample.name == "cloud.pts")
                        CHECK(source.positions == doubles(sample_positions()));
                } catch (const Error& e) {
                    REQUIRE(std::string(e.what()).starts_with(path.string() + ":"));
                }
            }
        }
    }
}

TEST_CASE("A prefix of an XYZ file is its first lines, or an error at its last") {
    const std::string bytes = sample_xyz();
    const std::vector<glm::dvec3> all = doubles(sample_positions());
    std::size_t lines = 0;
    for (std::size_t size = 1; size <= bytes.size(); ++size) {
        const std::string prefix = bytes.substr(0, size);
        CAPTURE(prefix);
        const std::size_t ended = std::ranges::count(prefix, '\n') - (prefix.size() > 16 ? 1 : 0);
        if (prefix.back() == '\n' && ended > 0) {
            CHECK(read_points("a.xyz", prefix).positions ==
                  std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(ended)));
            lines = std::max(lines, ended);
        }
    }
    CHECK(lines == 13);
}

TEST_CASE("Random damage to clouds gives an error or sound points, never a crash") {
    const ScratchFolder folder;
    const std::uint32_t seed = 61;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    const std::string_view telling = "0123456789-+.eE \n\r\t#\"naif\0\xff\x7f\x80";
    int refused = 0;
    int taken = 0;
    for (const SampleFile& sample : sample_clouds()) {
        for (int round = 0; round < tests::rounds(600); ++round) {
            std::string bytes = sample.bytes;
            for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
                const std::size_t at = below(bytes.size());
                switch (below(4)) {
                    case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
                    case 1: bytes[at] = telling[below(telling.size())]; break;
                    case 2: bytes.erase(at, 1 + below(8)); break;
                    default: bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(40)));
                }
                if (bytes.empty()) bytes.push_back(telling[0]);
            }
            CAPTURE(sample.name);
            CAPTURE(round);
            const BadPoints bad = round % 2 == 0 ? BadPoints::refuse : BadPoints::keep;
            const std::filesystem::path path = folder.write(sample.name, bytes);
            try {
                const PointSource source = read_point_file(path, bad);
                REQUIRE(is_sound(source, bad == BadPoints::refuse));
                ++taken;
            } catch (const Error& e) {
                REQUIRE(std::string(e.what()).starts_with(path.string() + ":"));
                ++refused;
            }
        }
    }
    CHECK(refused > tests::rounds(1500));
    CHECK(taken > tests::rounds(800));
}

TEST_CASE("Reading points reports progress that never falls and can be stopped") {
    std::string bytes;
    for (int i = 0; i < 300000; ++i) bytes += "0 0 1\n";
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("a.xyz", bytes);
    double last = 0.0;
    int calls = 0;
    LongCall call;
    call.progress = [&](double done) {
        CHECK(done >= last);
        last = done;
        ++calls;
    };
    CHECK(read_point_file(path, BadPoints::refuse, call).positions.size() == 300000);
    CHECK(last == 1.0);
    CHECK(calls >= 5);
    std::stop_source stop;
    call.stop = stop.get_token();
    call.progress = [&](double done) {
        if (done > 0.5) stop.request_stop();
    };
    try {
        read_point_file(path, BadPoints::refuse, call);
        FAIL("it was not stopped");
    } catch (const Error& e) {
        CHECK(e.code() == ErrorCode::cancelled);
    }
}
