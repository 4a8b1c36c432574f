#pragma once

// A value of a glTF document with its path ("accessors[3].count"), and the checks of its type. They throw
// Error{bad_input} that begins with the file and the path.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "silhouette/mesh/formats/json_document.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// `file`, the name for messages, and the document must outlive it.
class GltfPlace {
public:
    GltfPlace(const std::string& file, JsonValue value, std::string path = {})
        : file_(file), value_(value), path_(std::move(path)) {}

    const JsonValue& value() const noexcept { return value_; }
    /// What the file's user is told about this value.
    std::string message(const std::string& what) const {
        return file_ + ": " + (path_.empty() ? "the document" : path_) + ": " + what;
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::bad_input, message(what));
    }

    const GltfPlace& object() const {
        if (!value_.is(JsonType::object)) fail("should be an object");
        return *this;
    }
    std::optional<GltfPlace> find(const char* key) const {
        const auto found = value_.find(key);
        if (!found) return std::nullopt;
        return GltfPlace(file_, *found, path_.empty() ? key : path_ + "." + key);
    }
    GltfPlace at(const char* key) const {
        if (auto found = find(key)) return *std::move(found);
        fail(std::string("has no '") + key + "'");
    }
    /// `element` must be element number `i` of this array.
    GltfPlace item(JsonValue element, std::size_t i) const {
        return GltfPlace(file_, element, path_ + "[" + std::to_string(i) + "]");
    }
    /// Calls use(value, i) for each element of this array.
    template <typename Use>
    void each(const Use& use) const {
        if (!value_.is(JsonType::array)) fail("should be an array");
        std::size_t i = 0;
        for (JsonValue e = value_.first(); e != value_.end(); e = e.next()) use(e, i++);
    }
    /// The number of elements of the array `key`, 0 if it is missing. O(elements).
    std::size_t count(const char* key) const {
        std::size_t count = 0;
        if (const auto array = find(key)) array->each([&](JsonValue, std::size_t) { ++count; });
        return count;
    }
    /// Calls use(place) for each object of the array `key`, if there is one.
    template <typename Use>
    void each_object(const char* key, const Use& use) const {
        if (const auto array = find(key))
            array->each([&](JsonValue e, std::size_t i) { use(array->item(e, i).object()); });
    }

    std::string_view string() const {
        if (!value_.is(JsonType::string)) fail("should be a string");
        return value_.string();
    }
    /// Below 2^31, so that sums and products of two fit in 64 bits.
    std::uint32_t integer() const {
        if (!value_.is(JsonType::natural)) fail("should be an integer, 0 or greater");
        if (value_.natural() > 0x7fffffff)
            fail(std::to_string(value_.natural()) + " is too large; it should be below 2^31");
        return static_cast<std::uint32_t>(value_.natural());
    }
    std::optional<std::uint32_t> integer(const char* key) const {
        if (const auto place = find(key)) return place->integer();
        return std::nullopt;
    }
    bool boolean() const {
        if (!value_.is(JsonType::boolean)) fail("should be true or false");
        return value_.boolean();
    }
    double number() const {
        if (!value_.is_number()) fail("should be a number");
        return value_.number();
    }
    template <std::size_t N>
    std::array<double, N> numbers() const {
        std::array<double, N> numbers{};
        std::size_t count = 0;
        each([&](JsonValue e, std::size_t i) {
            if (!e.is_number()) item(e, i).fail("should be a number");
            if (i < N) numbers[i] = e.number();
            ++count;
        });
        if (count != N) fail("should have " + std::to_string(N) + " numbers");
        return numbers;
    }

private:
    const std::string& file_;
    JsonValue value_;
    std::string path_;
};

}  // namespace rimline
