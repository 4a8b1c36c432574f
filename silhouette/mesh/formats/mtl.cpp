#include "silhouette/mesh/formats/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/srgb.h"

namespace rimline {

namespace {

class LibraryReader {
public:
    LibraryReader(const SourceFile& obj, const LongCall& call, std::vector<std::string>& warnings)
        : obj_(obj), call_(call), warnings_(warnings) {}

    // A statement names one library whose name may hold spaces, or several.
    void read_named(const NamedLine& statement) {
        if (statement.text.empty()) {
            libraries_.is_complete = false;
            return;
        }
        const auto whole = path_of(statement.text);
        std::error_code ignored;
        if (statement.text.find_first_of(" \t") == std::string::npos ||
            (whole && std::filesystem::exists(obj_.folder / *whole, ignored))) {
            read_library(statement.text, whole, statement.line);
            return;
        }
        TextScanner names(obj_.name, statement.text);
        for (std::string_view name = names.word(); !name.empty(); name = names.word())
            read_library(name, path_of(name), statement.line);
    }

    MaterialLibraries take() { return std::move(libraries_); }

private:
    // The path below the folder of the OBJ, or nothing. Windows writes '\' between folders.
    static std::optional<std::filesystem::path> path_of(std::string_view name) {
        constexpr std::size_t k_longest = 4096;
        if (name.size() > k_longest || std::ranges::any_of(name, [](char c) {
                return static_cast<unsigned char>(c) < 0x20 || c == ':';
            }))
            return std::nullopt;
        std::string slashed(name);
        std::ranges::replace(slashed, '\\', '/');
        const std::filesystem::path path(slashed);
        if (path.is_absolute() || std::ranges::find(path, "..") != path.end()) return std::nullopt;
        return path.lexically_normal();
    }

    void read_library(std::string_view name, const std::optional<std::filesystem::path>& path,
                      std::uint64_t line) {
        const std::string place = obj_.name + ":" + std::to_string(line) + ": ";
        if (!path) {
            libraries_.is_complete = false;
            add_warning(warnings_,
                        place + "mtllib " + excerpt(name) +
                            " does not name a file beside this one; its colors are missing");
            return;
        }
        if (!known_.insert(*path).second) return;
        libraries_.files.push_back(obj_.folder / *path);
        try {
            SourceFile library = read_source_file(obj_.folder / *path, {call_.stop, {}});
            if (library.bytes.starts_with("\xef\xbb\xbf")) library.text_begin = 3;
            read_text(library);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::cancelled) throw;
            libraries_.is_complete = false;
            add_warning(warnings_, place + "the material library " + e.what());
        }
    }

    void read_text(const SourceFile& library) {
        TextScanner scanner(library.name, library.text(), {.comment = '#'});
        // The current one. Null before the first one, and for a second one of the same name.
        LibraryMaterial* material = nullptr;
        for (std::uint64_t i = 1; scanner.next_line(); ++i) {
            if (i % k_checkpoint_interval == 0 && call_.stop.stop_requested())
                throw Error(ErrorCode::cancelled, "cancelled");
            const std::string_view keyword = scanner.token();
            if (equals_ignoring_case(keyword, "newmtl")) {
                const auto [entry, is_new] =
                    libraries_.materials.try_emplace(std::string(scanner.free_text()));
                material = is_new ? &entry->second : nullptr;
                continue;
            }
            if (!material) continue;
            try {
                if (equals_ignoring_case(keyword, "kd")) material->color = read_color(scanner);
                if (equals_ignoring_case(keyword, "d")) check_is_opaque(scanner);
                if (equals_ignoring_case(keyword, "map_kd")) {
                    material->map = read_map(library, scanner);
                    libraries_.files.push_back(material->map->texture.path);
                }
            } catch (const Error& e) {
                add_warning(warnings_, e.what());
            }
        }
    }

    // d [-halo] opacity. `Tr` is its opposite in some programs' files and the same in others'.
    static void check_is_opaque(TextScanner& scanner) {
        std::string_view word = scanner.token();
        if (word == "-halo") word = scanner.token();
        const std::optional<float> opacity = parse_float(word);
        if (opacity && *opacity < 1.0f)
            scanner.fail("d " + excerpt(word) +
                         ": the material is translucent; it is taken as opaque");
    }

    // map_Kd [options] file. The name may hold spaces.
    static ColorMap read_map(const SourceFile& library, TextScanner& scanner) {
        ColorMap map;
        map.texture.place = library.name + ":" + std::to_string(scanner.line()) + ": map_Kd";
        std::string_view name = scanner.free_text();
        for (std::string_view rest = name; read_option(scanner, rest, map); name = rest) {
        }
        if (name.empty()) scanner.fail("map_Kd names no file");
        const auto path = path_of(name);
        if (!path)
            scanner.fail("map_Kd " + excerpt(name) + " does not name a file beside this one");
        map.texture.path = library.folder / *path;
        return map;
    }

    // Moves `rest` behind an option and its values. Returns false if it does not begin with an option: then it
    // is the name of the file.
    static bool read_option(const TextScanner& scanner, std::string_view& rest, ColorMap& map) {
        const std::string_view option = take_word(rest);
        const auto is_option = [&](std::string_view name) {
            return equals_ignoring_case(option, name);
        };
        // u, then v and w, which may be missing.
        const auto read_numbers = [&](glm::vec2* pair) {
            for (int i = 0; i < 3; ++i) {
                std::string_view after = rest;
                const std::string_view word = take_word(after);
                const std::optional<float> number = parse_float(word);
                if (i > 0 && !number) break;
                if (!number || !std::isfinite(*number))
                    scanner.fail(excerpt(word) + " is not a number; map_Kd " + excerpt(option) +
                                 " needs one");
                if (pair && i < 2) (*pair)[i] = *number;
                rest = after;
            }
            return true;
        };
        if (is_option("-s")) return read_numbers(&map.scale);
        if (is_option("-o")) return read_numbers(&map.offset);
        if (is_option("-t") || is_option("-mm")) return read_numbers(nullptr);
        constexpr std::array<std::string_view, 10> k_of_one_word{
            "-blendu", "-blendv", "-cc",      "-clamp", "-texres",
            "-bm",     "-boost",  "-imfchan", "-type",  "-colorspace"};
        if (std::ranges::none_of(k_of_one_word, is_option)) return false;
        if (equals_ignoring_case(take_word(rest), "on") && is_option("-clamp"))
            map.texture.wrap_u = map.texture.wrap_v = TextureWrap::clamp;
        return true;
    }

    // The first word of `rest`, which then begins with the next one.
    static std::string_view take_word(std::string_view& rest) {
        constexpr std::string_view k_spaces = " \t";
        const std::string_view word = rest.substr(0, rest.find_first_of(k_spaces));
        rest.remove_prefix(word.size());
        rest.remove_prefix(std::min(rest.find_first_not_of(k_spaces), rest.size()));
        return word;
    }

    // Kd r g b, or Kd r for a gray.
    static glm::vec3 read_color(TextScanner& scanner) {
        constexpr const char* k_what = "a channel of Kd";
        const std::string_view first = scanner.token();
        if (first == "spectral" || first == "xyz")
            scanner.fail("Kd " + std::string(first) + " is not supported; write Kd r g b");
        glm::vec3 color(float_of(scanner.number(first, k_what)));
        if (const std::string_view second = scanner.token(); !second.empty()) {
            color.y = float_of(scanner.number(second, k_what));
            color.z = float_of(scanner.number(k_what));
            scanner.expect_end_of_line("Kd r g b");
        }
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(color[i])) scanner.fail("a channel of Kd is not a finite number");
        return linear_from_srgb(clamped_color(color));
    }

    const SourceFile& obj_;
    const LongCall& call_;
    std::vector<std::string>& warnings_;
    std::set<std::filesystem::path> known_;
    MaterialLibraries libraries_;
};

}  // namespace

const LibraryMaterial* MaterialLibraries::find(std::string_view name) const {
    auto found = materials.find(name);
    if (found == materials.end()) {
        const std::size_t comment = name.find('#');
        if (comment == std::string_view::npos) return nullptr;
        name = name.substr(0, comment);
        name = name.substr(0, name.find_last_not_of(" \t") + 1);
        found = materials.find(name);
        if (found == materials.end()) return nullptr;
    }
    return &found->second;
}

MaterialLibraries read_material_libraries(const SourceFile& obj,
                                          std::span<const NamedLine> statements,
                                          const LongCall& call,
                                          std::vector<std::string>& warnings) {
    LibraryReader reader(obj, call, warnings);
    for (const NamedLine& statement : statements) reader.read_named(statement);
    return reader.take();
}

}  // namespace rimline
