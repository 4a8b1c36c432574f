// XYZ, PTS and CSV: one point per line. point_file.h describes the columns.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>

#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

namespace {

constexpr std::size_t k_max_columns = 64;
constexpr float k_unit_tolerance = 0.01f;
constexpr std::string_view k_blanks = " \t";

char separator_of(std::string_view line) {
    for (const char separator : {';', ','})
        if (line.find(separator) != std::string_view::npos) return separator;
    return ' ';
}

// Takes the next column off a line. Columns stand between blanks, or between other separators, which may have blanks
// around them; the last one may be followed by a separator.
std::string_view take_column(std::string_view& line, char separator) {
    line.remove_prefix(std::min(line.find_first_not_of(k_blanks), line.size()));
    const std::size_t end = std::min(
        separator == ' ' ? line.find_first_of(k_blanks) : line.find(separator), line.size());
    std::string_view column = line.substr(0, end);
    line.remove_prefix(separator == ' ' ? end : std::min(end + 1, line.size()));
    return column.substr(0, column.find_last_not_of(k_blanks) + 1);
}

// What the first columns of a line are named, if it names them: x, y, z, and maybe a color or a normal next.
enum class Header : std::uint8_t { none, with_position, with_triple };
Header header_of(std::string_view line) {
    const char separator = separator_of(line);
    const auto take_names = [&](std::initializer_list<std::string_view> names) {
        std::string_view rest = line;
        for (const std::string_view name : names) {
            std::string_view column = take_column(rest, separator);
            if (column.size() > 2 && column.front() == '"' && column.back() == '"')
                column = column.substr(1, column.size() - 2);
            if (!equals_ignoring_case(column, name)) return false;
        }
        line = rest;
        return true;
    };
    if (!take_names({"x", "y", "z"})) return Header::none;
    const bool has_triple = take_names({"r", "g", "b"}) || take_names({"red", "green", "blue"}) ||
                            take_names({"nx", "ny", "nz"});
    return has_triple ? Header::with_triple : Header::with_position;
}

bool is_zero(const glm::vec3& v) { return v == glm::vec3(0.0f); }

// A triple of columns, and the meanings that all its values so far allow.
struct Triple {
    std::vector<glm::vec3> values;
    bool are_units = true;  // Unit vectors or zero.
    bool are_bytes = true;
    bool are_zero = true;

    void add(const glm::vec3& v) {
        values.push_back(v);
        are_zero = are_zero && is_zero(v);
        are_units =
            are_units && (is_zero(v) || std::abs(glm::length(v) - 1.0f) <= k_unit_tolerance);
        for (int i = 0; i < 3; ++i)
            are_bytes = are_bytes && v[i] >= 0.0f && v[i] <= 255.0f && v[i] == std::floor(v[i]);
    }
    bool can_be_used() const { return are_units || are_bytes; }
};

class PointTextReader {
public:
    PointTextReader(const SourceFile& file, BadPoints bad, const LongCall& call)
        : file_(file), bad_(bad), call_(call), scanner_(file.name, file.text()) {}

    PointRecords read() {
        std::uint64_t lines = 0;
        while (scanner_.next_line()) {
            if (++lines % k_checkpoint_interval == 0) parse_checkpoint(call_, scanner_.share());
            if (!read_numbers()) continue;
            if (count_ == 1)
                begin_scan();
            else
                take_point();
        }
        if (expected_ && left_ > 0)
            scanner_.fail("the file ends where point " + std::to_string(*expected_ - left_ + 1) +
                          " of " + std::to_string(*expected_) + " should follow");
        keep_triples();
        return std::move(records_);
    }

private:
    // Returns false for a comment, and for the names of columns before the first point. A # within a line does not
    // begin a comment, because old exporters write NaN as -1.#IND.
    bool read_numbers() {
        std::string_view line = scanner_.free_text();
        if (line.starts_with('#') || line.starts_with("//")) return false;
        if (records_.source.positions.empty() && !expected_)
            if (const Header header = header_of(line); header != Header::none) {
                header_ = header;
                return false;
            }
        const char separator = separator_ ? *separator_ : separator_of(line);
        for (count_ = 0; !line.empty();) {
            if (count_ == k_max_columns)
                scanner_.fail("a point with more than " + std::to_string(k_max_columns) +
                              " numbers");
            const std::string_view column = take_column(line, separator);
            if (count_ == 0) first_token_ = column;
            if (column.empty())
                scanner_.fail("nothing between two separators; a point's number should stand here");
            numbers_[count_++] = scanner_.number(column, "a point's number");
        }
        if (count_ > 1) separator_ = separator;
        return true;
    }

    // A line with one number is the count of the points that follow.
    void begin_scan() {
        if (left_ > 0 || (!expected_ && !records_.source.positions.empty()))
            scanner_.fail("a line with one number where a point should stand; it has 3 or more");
        const std::int64_t count = scanner_.integer(first_token_, "the number of points");
        // A point takes at least "0 0 0" and a line end, which the last line may lack.
        if (count < 0 || static_cast<std::uint64_t>(count) > (scanner_.remaining() + 1) / 6)
            scanner_.fail(std::to_string(count) +
                          " points are more than the rest of the file can hold; it is truncated or "
                          "the count is wrong");
        expected_ = static_cast<std::uint64_t>(count);
        left_ = *expected_;
    }

    void take_point() {
        std::vector<glm::dvec3>& positions = records_.source.positions;
        if (count_ < 3) scanner_.fail("a point with 2 numbers; it has 3 or more");
        if (positions.empty())
            begin_columns();
        else if (count_ != columns_)
            scanner_.fail("a point with " + std::to_string(count_) +
                          " numbers, where those before it have " + std::to_string(columns_));
        if (expected_ && left_-- == 0)
            scanner_.fail("there are more points than the count of " + std::to_string(*expected_) +
                          " before them");
        const glm::dvec3 position(numbers_[0], numbers_[1], numbers_[2]);
        if (const std::string why = refusal(positions.size(), position, bad_); !why.empty())
            scanner_.fail(why);
        if (positions.size() == k_max_file_vertices)
            throw Error(ErrorCode::too_large, file_.name + ": more than 2^32 points");
        positions.push_back(position);
        if (first_triple_ == 4) records_.source.intensities.push_back(float_of(numbers_[3]));
        for (std::size_t t = 0; t < triples_.size(); ++t) {
            if (!triples_[t].can_be_used()) continue;
            const std::size_t c = first_triple_ + 3 * t;
            triples_[t].add(float_of(glm::dvec3(numbers_[c], numbers_[c + 1], numbers_[c + 2])));
        }
    }

    void begin_columns() {
        columns_ = count_;
        const bool has_triple = header_ == Header::with_triple;
        first_triple_ = !has_triple && columns_ % 3 == 1 && columns_ <= 10 ? 4 : 3;
        if (has_triple || (columns_ % 3 != 2 && columns_ <= 10))
            triples_.resize((columns_ - first_triple_) / 3);
    }

    void keep_triples() {
        PointSource& source = records_.source;
        for (Triple& triple : triples_) {
            if (triple.are_units && !triple.are_zero && source.normals.empty())
                source.normals = std::move(triple.values);
            else if (triple.are_bytes && source.colors.empty())
                for (const glm::vec3& v : triple.values)
                    source.colors.push_back({static_cast<std::uint8_t>(v.x),
                                             static_cast<std::uint8_t>(v.y),
                                             static_cast<std::uint8_t>(v.z)});
        }
    }

    const SourceFile& file_;
    BadPoints bad_;
    const LongCall& call_;
    TextScanner scanner_;
    PointRecords records_;
    std::array<double, k_max_columns> numbers_{};
    std::size_t count_ = 0;  // Numbers in the current line.
    Header header_ = Header::none;
    std::optional<char> separator_;  // Of the first line with several.
    std::string_view first_token_;
    std::size_t columns_ = 0;  // Numbers per point.
    std::size_t first_triple_ = 0;
    std::vector<Triple> triples_;
    std::optional<std::uint64_t> expected_;  // Points of the current scan.
    std::uint64_t left_ = 0;
};

}  // namespace

PointRecords read_point_text(const SourceFile& file, BadPoints bad, const LongCall& call) {
    return PointTextReader(file, bad, call).read();
}

MeshSource read_point_text_as_mesh(const SourceFile& file, const LongCall& call) {
    const PointSource points = read_point_text(file, BadPoints::refuse, call).source;
    MeshSource source;
    source.positions.assign(points.positions.begin(), points.positions.end());
    return source;
}

}  // namespace rimline
