#include "silhouette/mesh/formats/wrapped_content.h"

#include <utility>

#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE("What holds a model in another form is named whatever its name") {
    const std::string zero(1, '\0');
    const std::string utf16 = "v" + zero + " " + zero + "0" + zero;
    const std::vector<std::pair<std::string, std::string>> forms{
        {"\x1f\x8b\x08" + zero, "it is compressed by gzip; unpack it"},
        {"PK\x03\x04" + zero, "it is a ZIP archive, as 3MF and USDZ files are; unpack it"},
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n",
         "it is a pointer of Git LFS; 'git lfs pull' fetches the file"},
        {"\xff\xfe" + utf16, "it is text in UTF-16; save it as UTF-8"},
        {"\xfe\xff" + zero + utf16, "it is text in UTF-16; save it as UTF-8"}};
    for (const auto& [bytes, what] : forms)
        for (const std::string name :
             {"a", "a.obj", "a.obj.gz", "a.ply", "a.stl", "a.off", "a.gltf", "a.glb", "a.xyz"}) {
            CAPTURE(name);
            CHECK(error_of(name, bytes).starts_with(name + ": " + what));
        }
}

TEST_CASE("The header of a binary STL may begin as anything") {
    for (const char* begin : {"\x1f\x8b", "PK\x03\x04", "version https://git-lfs", "\xff\xfe"})
        CHECK(read_text("a.stl", sample_stl_binary(begin)).triangles.size() == 5);
    for (const SampleFile& sample : sample_files()) CHECK(wrapped_content(sample.bytes).empty());
}
