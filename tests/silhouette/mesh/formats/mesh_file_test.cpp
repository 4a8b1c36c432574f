#include "silhouette/mesh/formats/mesh_file.h"

#include <sys/stat.h>

#include "silhouette/mesh/formats/readers.h"
#include "tests/silhouette/mesh/formats/sample_files.h"
#include "tests/skip.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE("What a file is, its content says before its name") {
    for (const SampleFile& sample : sample_files()) {
        for (const char* name : {"model", "model.obj", "model.stl", "model.xyz"}) {
            CAPTURE(sample.name);
            CAPTURE(name);
            // A binary STL that begins with nothing known is known by its size.
            CHECK(error_of(name, sample.bytes) == "");
            CHECK(read_text(name, sample.bytes).triangles.size() == 5);
        }
    }
}

TEST_CASE("Bytes are read as a file of the format that is said, and refused as another") {
    for (const SampleFile& sample : sample_files()) {
        CAPTURE(sample.name);
        const std::string own = std::filesystem::path(sample.name).extension().string();
        for (const char* extension : {".ply", ".obj", ".stl", ".off", ".glb", ".gltf"}) {
            CAPTURE(extension);
            if (extension == own) {
                const MeshSource source = read_mesh_bytes("a pipe", sample.bytes, extension);
                CHECK(source.triangles.size() == 5);
                continue;
            }
            std::string message;
            try {
                read_mesh_bytes("a pipe", sample.bytes, extension);
            } catch (const Error& e) {
                message = e.what();
            }
            CHECK(message.starts_with("a pipe: its content is " + own.substr(1) + ", not "));
        }
    }
    CHECK_THROWS_AS(read_mesh_bytes("a pipe", "", ".obj"), Error);
    CHECK_THROWS_AS(read_mesh_bytes("a pipe", "v 0 0 0\n", ".obj"), Error);
}

TEST_CASE("A byte order mark before text does not matter") {
    CHECK(read_text("a.obj", "\xef\xbb\xbf" + sample_obj()).triangles.size() == 5);
    CHECK(read_text("a.gltf", "\xef\xbb\xbf" + sample_gltf_embedded()).triangles.size() == 5);
}

TEST_CASE(
    "A byte order mark may begin a binary STL's header, and does not shift the places of errors") {
    const std::string mark = "\xef\xbb\xbf";
    const std::string stl = sample_stl_binary(mark + "made by a test");
    CHECK(read_text("a.stl", stl).positions == sample_soup());
    CHECK(has(error_of("a.stl", stl.substr(0, 300)), "a.stl: byte 80: 5 facets are declared"));
    CHECK(has(error_of("a.glb", mark + sample_glb()), "begins with 'glTF'"));
    CHECK(has(error_of("a.ply", mark), "the file is empty"));
    for (const SampleFile& sample : sample_files()) {
        if (sample.name.ends_with(".glb") || sample.name == "binary.stl" ||
            sample.name == "solid.stl")
            continue;
        CAPTURE(sample.name);
        CHECK(read_text(sample.name, mark + sample.bytes).triangles.size() == 5);
    }
    CHECK(has(error_of("a.gltf", mark + "{\"asset\": !}"), "a.gltf: byte 14: "));
    CHECK(has(error_of("a.gltf", "{\"asset\": !}"), "a.gltf: byte 11: "));
    const std::string ply =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float "
        "x\nproperty float y\nproperty float z\nend_header\n";
    Bytes values;
    values.add(0.0f).add(NAN).add(0.0f);
    CHECK(has(error_of("a.ply", mark + ply + values.str()),
              "byte " + std::to_string(3 + ply.size() + 4) + ": y is not a finite number"));
    CHECK(has(error_of("a.obj", mark + "v 1 2 x\n"), "a.obj:1: 'x' is not a number"));
}

TEST_CASE("Files that are missing, folders, pipes, empty or unknown are refused with the reason") {
    const ScratchFolder folder;
    const auto error = [](const std::filesystem::path& path) {
        try {
            read_mesh_file(path);
        } catch (const Error& e) {
            CHECK(std::string(e.what()).starts_with(path.string() + ":"));
            return std::pair{e.code(), std::string(e.what())};
        }
        return std::pair{ErrorCode::cancelled, std::string()};
    };
    const auto missing = error(folder.path() / "none.obj");
    CHECK(missing.first == ErrorCode::io);
    CHECK(has(missing.second, "No such file"));
    CHECK(has(error(folder.path()).second, "is a directory"));
    const std::filesystem::path pipe = folder.path() / "pipe.obj";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(has(error(pipe).second, "is not a regular file"));
    const auto empty = error(folder.write("empty.ply", ""));
    CHECK(empty.first == ErrorCode::bad_input);
    CHECK(has(empty.second, "the file is empty"));
    CHECK(has(error(folder.write("a.png", "\x89PNG\r\n")).second, "the format is not known"));
    CHECK(has(error(folder.write("noname", "hello world\n")).second, "the format is not known"));
    CHECK(has(error(folder.write("a.ply", "hello world\n")).second, "begins with a line 'ply'"));
    CHECK(has(error(folder.write("a.glb", "hello world\n")).second, "begins with 'glTF'"));
    CHECK(has(error(folder.write("a.obj", "hello world\n")).second, ":1: 'hello' is no OBJ"));
    CHECK(has(error(folder.write("a.obj", "# nothing\n")).second, "no faces: it holds nothing"));
    CHECK(has(error_of("a.obj", "# nothing\n"), "no points"));
}

TEST_CASE("A model so far away that floats lose its shape is read with a warning") {
    const auto warnings_at = [](const std::string& x) {
        return read_text("a.obj", "v " + x + " 0 0\nv " + x + ".5 0 0\nv " + x + " 1 0\nf 1 2 3\n")
            .warnings;
    };
    CHECK(warnings_at("50000").empty());
    REQUIRE(warnings_at("500000").size() == 1);
    CHECK(has(warnings_at("500000").front(), "single precision"));
}

TEST_CASE("A file that may not be read is refused with the reason") {
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("a.obj", sample_obj());
    std::filesystem::permissions(path, std::filesystem::perms::none);
    if (std::ifstream(path).good()) RIMLINE_SKIP("the superuser may read any file");
    CHECK_THROWS_AS(read_mesh_file(path), Error);
}

TEST_CASE("Progress never falls and ends at one, and a stop request ends the call") {
    std::string bytes = "OFF\n150000 0 0\n";
    for (int i = 0; i < 150000; ++i) bytes += "0 0 1\n";
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("a.off", bytes);
    double last = 0.0;
    int calls = 0;
    LongCall call;
    call.progress = [&](double done) {
        CHECK(done >= last);
        CHECK(done <= 1.0);
        last = done;
        ++calls;
    };
    read_mesh_file(path, FaceRequirement::faces_or_points, call);
    CHECK(last == 1.0);
    CHECK(calls >= 4);

    std::stop_source stop;
    call.stop = stop.get_token();
    call.progress = [&](double done) {
        if (done > 0.5) stop.request_stop();
    };
    bool cancelled = false;
    try {
        read_mesh_file(path, FaceRequirement::faces_or_points, call);
    } catch (const Error& e) {
        cancelled = e.code() == ErrorCode::cancelled;
    }
    CHECK(cancelled);
}

TEST_CASE("A stop request reaches into a file's only polygon") {
    constexpr int k_corners = 20000;
    std::string points;
    std::string obj;
    std::string from_0;
    std::string from_1;
    for (int i = 0; i < k_corners; ++i) {
        const double angle = 2.0 * M_PI * i / k_corners;
        const double r = i % 2 == 0 ? 1.0 : 0.5;
        const std::string point = std::to_string(r * std::cos(angle)) + " " +
                                  std::to_string(r * std::sin(angle)) + " 0\n";
        points.append(point);
        obj.append("v ").append(point);
        from_0.append(" ").append(std::to_string(i));
        from_1.append(" ").append(std::to_string(i + 1));
    }
    const std::string count = std::to_string(k_corners);
    const std::string vertices =
        "element vertex " + count + "\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string face = "element face 1\nproperty list ushort int vertex_index\n";
    const std::string ply = "ply\nformat ascii 1.0\n";
    const SourceFile off{
        "a.off", "OFF\n" + count + " 1 0\n" + points + count + from_0 + "\n", {}, 0};
    const SourceFile faces_last{
        "a.ply", ply + vertices + face + "end_header\n" + points + count + from_0 + "\n", {}, 0};
    const SourceFile faces_first{
        "b.ply", ply + face + vertices + "end_header\n" + count + from_0 + "\n" + points, {}, 0};
    const SourceFile with_face{"a.obj", obj + "f" + from_1 + "\n", {}, 0};
    const auto read = [](const SourceFile& file, const LongCall& call) {
        if (file.name == "a.off") return read_off(file, BadPoints::refuse, call);
        return file.name == "a.obj" ? read_obj(file, call) : read_ply(file, call);
    };
    for (const SourceFile* file : {&off, &faces_last, &faces_first, &with_face}) {
        CAPTURE(file->name);
        int reports = 0;
        CHECK(read(*file, {{}, [&](double) { ++reports; }}).triangles.size() == k_corners - 2);
        // After the last report, if there is any, only the polygon is left to ask.
        std::stop_source stop;
        if (reports == 0) stop.request_stop();
        ErrorCode code{};
        try {
            read(*file, {stop.get_token(), [&](double) {
                             if (--reports == 0) stop.request_stop();
                         }});
        } catch (const Error& e) {
            code = e.code();
        }
        CHECK(code == ErrorCode::cancelled);
    }
}

TEST_CASE("A fine mesh in coordinates of a map is warned of, a coarse one is not") {
    // A bowl of 100 x 100 squares, or of one, 100 wide.
    const auto warnings_of = [](int squares, double at) {
        std::string text;
        for (int y = 0; y <= squares; ++y)
            for (int x = 0; x <= squares; ++x) {
                const double u = 100.0 * x / squares, v = 100.0 * y / squares;
                text += "v " + std::to_string(at + u) + " " + std::to_string(at + v) + " " +
                        std::to_string(0.01 * u * v) + "\n";
            }
        for (int y = 0; y < squares; ++y)
            for (int x = 0; x < squares; ++x) {
                const int first = y * (squares + 1) + x + 1;
                text += "f " + std::to_string(first) + " " + std::to_string(first + 1) + " " +
                        std::to_string(first + squares + 2) + "\n";
            }
        return read_mesh_bytes("a map", text, ".obj").warnings;
    };
    CHECK(warnings_of(1, 450000.25).empty());
    CHECK(warnings_of(100, 4500.25).empty());
    const std::vector<std::string> warnings = warnings_of(100, 5411000.25);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] ==
          "a map: lies so far from the origin that single precision loses its shape; subtract an "
          "offset from its "
          "coordinates");
}
