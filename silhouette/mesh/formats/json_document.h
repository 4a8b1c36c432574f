#pragma once

// A JSON document as a flat list of values, in the order of the text. A container knows where its contents end:
//
//     {"a": [1, 2], "b": 3}     object "a" array 1 2 "b" 3
//                               |          |_________^      contents of the array
//                               |____________________^      contents of the object
//
// nlohmann's tree is not used: its destructor allocates, so a lack of memory ends the program, and it takes many
// times the size of the text. Its parser, which reports values one by one and does not recurse, fills this list.
// A value takes 16 bytes, and 32 more if it is a string or a key.

#include <bit>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "silhouette/error.h"

namespace rimline {

enum class JsonType : std::uint8_t { null, boolean, natural, number, string, array, object };

/// A value of a document, which must outlive it. Cheap to copy.
class JsonValue;

class JsonDocument {
public:
    /// Parses `text`, which begins at byte `first_byte` of the file `name`. Reports progress in [0, 1] and checks
    /// for cancellation within long strings too. Throws Error{bad_input}, with the byte, if this is not JSON or
    /// nests more than 64 levels deep, Error{too_large} beyond 4 GiB, Error{cancelled}, and std::bad_alloc.
    /// Cost: O(text); at most 17 times the text in memory.
    JsonDocument(const std::string& name, std::string_view text, std::size_t first_byte,
                 const LongCall& call);

    JsonValue root() const;
    /// Moves out the strings. Views of them stay valid; the values must not be used any more.
    std::deque<std::string> take_strings() { return std::move(strings_); }

private:
    friend class JsonValue;
    friend struct JsonListFiller;
    struct Value {
        JsonType type;
        // A boolean, an integer, a double's bits, a string's number, or the number of the first value after a
        // container's contents.
        std::uint64_t bits;
    };
    // Deques do not hold their contents twice while they grow.
    std::deque<Value> values_;
    std::deque<std::string> strings_;
};

class JsonValue {
public:
    JsonType type() const noexcept { return value().type; }
    bool is(JsonType type) const noexcept { return value().type == type; }
    bool is_number() const noexcept { return is(JsonType::natural) || is(JsonType::number); }

    // Each of these requires a value of its type.
    bool boolean() const noexcept { return value().bits != 0; }
    /// Of an integer that is not negative and is written without point and exponent.
    std::uint64_t natural() const noexcept { return value().bits; }
    double number() const noexcept {
        return is(JsonType::natural) ? static_cast<double>(value().bits)
                                     : std::bit_cast<double>(value().bits);
    }
    std::string_view string() const noexcept { return document_->strings_[value().bits]; }

    /// The member of an object. The last one if several have this key. Nothing if this is no object.
    /// O(members).
    std::optional<JsonValue> find(std::string_view key) const noexcept;

    /// Goes through the elements of an array: for (auto e = array.first(); e != array.end(); e = e.next()).
    JsonValue first() const noexcept { return JsonValue(*document_, at_ + 1); }
    JsonValue end() const noexcept { return JsonValue(*document_, value().bits); }
    JsonValue next() const noexcept {
        const bool is_container = is(JsonType::array) || is(JsonType::object);
        return JsonValue(*document_, is_container ? value().bits : at_ + 1);
    }
    bool operator==(const JsonValue&) const = default;

private:
    friend class JsonDocument;
    JsonValue(const JsonDocument& document, std::uint64_t at) noexcept
        : document_(&document), at_(at) {}
    const JsonDocument::Value& value() const noexcept { return document_->values_[at_]; }

    const JsonDocument* document_;
    std::uint64_t at_;
};

inline JsonValue JsonDocument::root() const { return JsonValue(*this, 0); }

}  // namespace rimline
