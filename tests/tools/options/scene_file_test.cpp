#include "tools/options/scene_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "silhouette/error.h"
#include "tests/tools/scratch_folder.h"

namespace rimline::tools {
namespace {

// Of a scene file with this text.
std::string message_of(std::string_view text) {
    const tests::ScratchFolder folder;
    const std::string path = folder / "scene.json";
    tests::write_bytes(path, std::string(text));
    try {
        (void)find_camera(read_scene_file(path), "left\x1b");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST_CASE("messages show the control characters of a scene file as numbers") {
    for (const std::string_view text :
         {"{\"rimline\x7f\"turn: 1}", "{\"rimline_scene\": 1, \"mod\\u0007els\": []}",
          "{\"a\x7f\": 1, \"a\x7f\": 2}", "{\"rimline_scene\": \"\x7f\"}",
          "{\"rimline_scene\": 1, \"models\": [{\"model\": \"shape:box\"}], "
          "\"cameras\": {\"\x7f\": {\"fov\": 30}}}"}) {
        CAPTURE(text);
        const std::string message = message_of(text);
        CHECK(message.find("\\x") != std::string::npos);
        CHECK(std::ranges::none_of(
            message, [](char c) { return (static_cast<unsigned char>(c) < 0x20) || c == 0x7f; }));
    }
}

TEST_CASE("a scene file that nests without end is refused") {
    constexpr std::size_t k_levels = 500'000;
    for (const std::string_view open : {"[", "{\"a\": "}) {
        std::string text = "{\"rimline_scene\": ";
        for (std::size_t level = 0; level < k_levels; ++level) text += open;
        CHECK(message_of(text).ends_with(
            "it nests more than 64 levels deep, which no scene file does"));
    }
    CHECK(message_of("{\"rimline_scene\": " + std::string(60, '[') + std::string(60, ']') + "}")
              .find("expected") != std::string::npos);
}

}  // namespace
}  // namespace rimline::tools
