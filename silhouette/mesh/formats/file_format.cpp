#include "silhouette/mesh/formats/file_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/formats/wrapped_content.h"

namespace rimline {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

// Whether the facet count at byte 80 gives exactly this file size. It cannot for text, because four letters
// read as a count are over half a billion facets.
bool is_sized_as_binary_stl(const std::string& bytes) {
    if (bytes.size() < 84) return false;
    const double count = load_scalar(bytes.data() + 80, ScalarType::uint32, std::endian::little);
    return 84.0 + 50.0 * count == static_cast<double>(bytes.size());
}

bool begins_as_ply(std::string_view bytes) {
    return bytes.starts_with("ply") &&
           (bytes.size() == 3 || bytes.find_first_of("\r\n \t", 3) == 3);
}

bool is_off_word(std::string_view word) {
    for (const std::string_view prefix : {"ST", "NC", "C", "N", "ST", "4", "n"})
        if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
    // The vertex count may follow without a space.
    return word.starts_with("OFF") && (word.size() == 3 || parse_integer(word.substr(3)));
}

bool is_point_text_name(std::string_view extension) {
    return extension == ".xyz" || extension == ".pts" || extension == ".csv";
}

// Decides by content, then by name. The name is needed for a truncated binary STL, an OFF that begins with
// its counts, which looks like a point, and an OBJ that begins with an unusual statement. Binary STL is
// tested first, because its 80 header bytes may look like any format or a byte order mark.
FileFormat format_of(const SourceFile& file, const std::string& extension) {
    if (is_sized_as_binary_stl(file.bytes)) return FileFormat::stl_binary;
    if (file.bytes.starts_with("glTF")) return FileFormat::glb;
    if (const std::string_view what = wrapped_content(file.bytes); !what.empty())
        bad_file(file.name, std::string(what));
    const std::string_view bytes = file.text();
    if (begins_as_ply(bytes)) return FileFormat::ply;

    TextScanner scanner(file.name, bytes, {.comment = '#'});
    const std::string_view word = scanner.word();
    if (word.starts_with('{')) return FileFormat::gltf;
    if (is_off_word(word)) return FileFormat::off;
    constexpr std::array<std::string_view, 9> k_obj_words{"v", "vn", "vt",     "f",     "o",
                                                          "g", "s",  "mtllib", "usemtl"};
    if (std::find(k_obj_words.begin(), k_obj_words.end(), word) != k_obj_words.end())
        return FileFormat::obj;
    const bool is_text = bytes.substr(0, 1024).find('\0') == std::string_view::npos;
    const bool is_solid =
        word.size() == 5 && (word == "solid" || word == "SOLID" || word == "Solid");
    if (is_solid && is_text) return FileFormat::stl_text;
    if (extension == ".stl")
        return is_solid || !is_text ? FileFormat::stl_binary : FileFormat::stl_text;
    if (extension == ".obj") return FileFormat::obj;
    if (extension == ".off") return FileFormat::off;
    if (extension == ".gltf") return FileFormat::gltf;
    if (extension == ".ply") bad_byte(file.name, 0, "a PLY file begins with a line 'ply'");
    if (extension == ".glb") bad_byte(file.name, 0, "a GLB file begins with 'glTF'");
    if (is_point_text_name(extension) ||
        (is_text && parse_double(word.substr(0, word.find_first_of(",;")))))
        return FileFormat::point_text;
    bad_byte(
        file.name, 0,
        "the format is not known; it should be OBJ, PLY, STL, OFF, glTF, GLB, XYZ, PTS or CSV");
}

std::string_view extension_of(FileFormat format) {
    switch (format) {
        case FileFormat::ply: return ".ply";
        case FileFormat::stl_text:
        case FileFormat::stl_binary: return ".stl";
        case FileFormat::off: return ".off";
        case FileFormat::obj: return ".obj";
        case FileFormat::gltf: return ".gltf";
        case FileFormat::glb: return ".glb";
        case FileFormat::point_text: break;
    }
    return ".xyz";
}

SourceFile with_text(SourceFile file) {
    // The byte order mark that some editors write before UTF-8 text.
    if (file.bytes.starts_with("\xef\xbb\xbf")) file.text_begin = 3;
    if (file.text().empty()) bad_file(file.name, "the file is empty");
    return file;
}

}  // namespace

KnownFile::KnownFile(const std::filesystem::path& path, const LongCall& call)
    : KnownFile(read_source_file(path, call), lower_extension(path)) {}

KnownFile::KnownFile(SourceFile source, const std::string& extension)
    : file(with_text(std::move(source))), format(format_of(file, extension)) {}

KnownFile known_bytes(const std::string& name, std::string bytes, const std::string& extension) {
    KnownFile known(SourceFile{name, std::move(bytes), {}, 0}, extension);
    const std::string_view found = extension_of(known.format);
    if (!extension.empty() && found != (is_point_text_name(extension) ? ".xyz" : extension))
        bad_file(name,
                 "its content is " + std::string(found.substr(1)) + ", not " + extension.substr(1));
    return known;
}

}  // namespace rimline
