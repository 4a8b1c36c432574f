#include "silhouette/mesh/formats/json_document.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

using namespace rimline;

namespace {

std::string json_error(const std::string& text, const LongCall& call = {}) {
    try {
        const JsonDocument document("a", text, 100, call);
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

// Recursion is no danger: nlohmann's tree is as deep as this document.
nlohmann::json tree(const JsonValue& value) {
    using nlohmann::json;
    switch (value.type()) {
        case JsonType::null: return nullptr;
        case JsonType::boolean: return value.boolean();
        case JsonType::natural: return value.natural();
        case JsonType::number: return value.number();
        case JsonType::string: return std::string(value.string());
        case JsonType::array: {
            json array = json::array();
            for (JsonValue e = value.first(); e != value.end(); e = e.next())
                array.push_back(tree(e));
            return array;
        }
        case JsonType::object: break;
    }
    json object = json::object();
    for (JsonValue key = value.first(); key != value.end(); key = key.next().next())
        object[std::string(key.string())] = tree(key.next());
    return object;
}

}  // namespace

TEST_CASE("JSON: the values of a document are those of nlohmann's tree") {
    for (
        const char* text :
        {"0", "[]", "{}", "null", "\"\"", R"({"a": [1, 2, {"b": []}], "c": {"d": "e"}, "f": null})",
         R"([true, false, -1, 0.1, 1e300, 18446744073709551615, 18446744073709551616, -0, 5e-324])",
         R"(["\u00e9\ud83d\ude00\n\\", "Größe", {"": {"": {}}}, [[[]], []]])",
         R"({"a": 1, "b": 2, "a": [3]})"}) {
        CAPTURE(text);
        const JsonDocument document("a", text, 0, {});
        CHECK(tree(document.root()) == nlohmann::json::parse(text));
    }
}

TEST_CASE("JSON: members are found by key, the last one if there are several") {
    const std::string text = R"({"a": {"b": 1}, "b": [2, 3], "a": {"b": 4}, "c": "b"})";
    JsonDocument document("a", text, 0, {});
    const JsonValue root = document.root();
    REQUIRE(root.find("a"));
    REQUIRE(root.find("a")->find("b"));
    CHECK(root.find("a")->find("b")->natural() == 4);
    CHECK(root.find("b")->first().next().natural() == 3);
    CHECK(!root.find("d"));
    CHECK(!root.find("b")->find("a"));
    CHECK(!root.find("c")->find("a"));
    const std::string_view c = root.find("c")->string();
    const std::deque<std::string> strings = document.take_strings();
    CHECK(c.data() == strings.back().data());
}

TEST_CASE("JSON: errors name the byte, and depth is limited") {
    CHECK(json_error(R"({"a": 1})").empty());
    CHECK(json_error(R"({"a": 1)") ==
          "a: byte 107: this is not JSON; the file is truncated or damaged");
    CHECK(json_error("") == "a: byte 100: this is not JSON; the file is truncated or damaged");
    CHECK(json_error("[1, 2] 3").starts_with("a: byte 108: this is not JSON"));
    CHECK(json_error("[\"\xff\"]").starts_with("a: byte 103: this is not JSON"));
    CHECK(json_error("[1e999]") == "a: byte 106: the number '1e999' is too large");
    const auto nested = [](std::size_t depth) {
        return std::string(depth, '[') + std::string(depth, ']');
    };
    CHECK(json_error(nested(64)).empty());
    CHECK(json_error(nested(65)) ==
          "a: the document nests more than 64 levels deep, which no glTF does");
    CHECK(json_error(std::string(1000000, '[')) == json_error(nested(65)));
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += R"({"a":)";
    CHECK(json_error(objects) == json_error(nested(65)));
}

TEST_CASE("JSON: a stop is seen within a long string") {
    const std::string text = "[\"" + std::string(1 << 24, 'x') + "\"]";
    std::stop_source stop;
    int reports = 0;
    double last = 0.0;
    const LongCall call{stop.get_token(), [&](double done) {
                            CHECK(done >= last);
                            last = done;
                            if (++reports == 3) stop.request_stop();
                        }};
    CHECK(json_error(text, call) == "cancelled");
    CHECK(reports == 3);
    CHECK(last < 0.1);
}
