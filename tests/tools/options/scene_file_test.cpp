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

}  // namespace
}  // namespace rimline::tools
