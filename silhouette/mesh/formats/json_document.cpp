#include "silhouette/mesh/formats/json_document.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

namespace {

// The text for the parser. It checks for cancellation itself, because one string can be as long as the file.
class WatchedText {
public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    WatchedText(std::string_view text, std::size_t at, const LongCall& call)
        : text_(text), at_(at), call_(&call) {}

    reference operator*() const noexcept { return text_[at_]; }
    WatchedText& operator++() {
        if (++at_ % k_checkpoint_interval == 0)
            call_->checkpoint(static_cast<double>(at_) / static_cast<double>(text_.size()));
        return *this;
    }
    WatchedText operator++(int) {
        WatchedText old = *this;
        ++*this;
        return old;
    }
    bool operator==(const WatchedText& other) const noexcept { return at_ == other.at_; }

private:
    std::string_view text_;
    std::size_t at_;
    const LongCall* call_;
};

// Deeper than any glTF.
constexpr std::size_t k_max_depth = 64;

}  // namespace

// What nlohmann's parser calls.
struct JsonListFiller {
    JsonDocument& document;
    const std::string& name;
    std::size_t first_byte;
    std::size_t text_size;
    std::vector<std::size_t> open;  // The containers around the next value.

    bool add(JsonType type, std::uint64_t bits) {
        document.values_.push_back({type, bits});
        return true;
    }
    bool begin(JsonType type) {
        if (open.size() >= k_max_depth)
            bad_file(name, "the document nests more than 64 levels deep, which no glTF does");
        open.push_back(document.values_.size());
        return add(type, 0);
    }
    bool end() {
        document.values_[open.back()].bits = document.values_.size();
        open.pop_back();
        return true;
    }

    bool null() { return add(JsonType::null, 0); }
    bool boolean(bool value) { return add(JsonType::boolean, value); }
    bool number_integer(std::int64_t value) {
        return add(JsonType::number, std::bit_cast<std::uint64_t>(static_cast<double>(value)));
    }
    bool number_unsigned(std::uint64_t value) { return add(JsonType::natural, value); }
    bool number_float(double value, const std::string& /*text*/) {
        return add(JsonType::number, std::bit_cast<std::uint64_t>(value));
    }
    bool string(std::string& value) {
        document.strings_.push_back(std::move(value));
        return add(JsonType::string, document.strings_.size() - 1);
    }
    bool key(std::string& value) { return string(value); }
    bool binary(nlohmann::json::binary_t& /*value*/) { return false; }  // Not in text.
    bool start_object(std::size_t /*size*/) { return begin(JsonType::object); }
    bool end_object() { return end(); }
    bool start_array(std::size_t /*size*/) { return begin(JsonType::array); }
    bool end_array() { return end(); }

    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::json::exception& e) {
        constexpr int k_number_overflow = 406;
        bad_byte(name, first_byte + std::min(position, text_size),
                 e.id == k_number_overflow ? "the number " + excerpt(token) + " is too large"
                                           : "this is not JSON; the file is truncated or damaged");
    }
};

JsonDocument::JsonDocument(const std::string& name, std::string_view text, std::size_t first_byte,
                           const LongCall& call) {
    if (text.size() > 0xffffffffu)
        throw Error(ErrorCode::too_large, name + ": its JSON is larger than 4 GiB");
    JsonListFiller filler{*this, name, first_byte, text.size(), {}};
    nlohmann::json::sax_parse(WatchedText(text, 0, call), WatchedText(text, text.size(), call),
                              &filler);
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const noexcept {
    std::optional<JsonValue> found;
    if (!is(JsonType::object)) return found;
    for (JsonValue name = first(); name != end();) {
        const JsonValue member = name.next();
        if (name.string() == key) found.emplace(member);
        name = member.next();
    }
    return found;
}

}  // namespace rimline
