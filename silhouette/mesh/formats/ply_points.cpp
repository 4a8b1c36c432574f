// The points of a PLY. Reads x, y, z in double, nx, ny, nz, a color (PlyElement::find_color()) and intensity of the
// element `vertex`.

#include <array>

#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/mesh/formats/ply_body.h"
#include "silhouette/mesh/formats/readers.h"

namespace rimline {

namespace {

// The properties that are read, in the order of a record.
constexpr std::array<const char*, 10> k_names{"x",  "y",   "z",     "nx",   "ny",
                                              "nz", "red", "green", "blue", "intensity"};
constexpr std::size_t k_first_normal = 3;
constexpr std::size_t k_first_color = 6;
constexpr std::size_t k_intensity = 9;

template <typename Body>
class PlyPointReader {
public:
    PlyPointReader(const SourceFile& file, const PlyHeader& header, BadPoints bad,
                   const LongCall& call)
        : file_(file), header_(header), bad_(bad), elements_(file, header, call) {}

    PointRecords read() {
        header_.vertices(file_);
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
                continue;
            }
            if (element.name == "face" || element.name == "tristrips")
                records_.has_faces = records_.has_faces || element.count > 0;
            elements_.skip_elements(element);
        }
        elements_.body.expect_end();
        return std::move(records_);
    }

private:
    // For each property, the index of its value in a record, or -1 if it is skipped. A normal or
    // color is used only if all three properties exist.
    std::vector<int> slots_of(const PlyElement& element) const {
        std::vector<int> slots(element.properties.size(), -1);
        for (std::size_t i = 0; i < k_first_normal; ++i)
            slots[element.require_value(file_, k_names[i])] = static_cast<int>(i);
        std::array<std::size_t, 3> normal{};
        std::size_t count = 0;
        for (std::size_t i = k_first_normal; i < k_first_color; ++i)
            if (const auto p = element.find(k_names[i]); p && !element.properties[*p].is_list())
                normal[count++] = *p;
        if (count == 3)
            for (std::size_t i = 0; i < 3; ++i)
                slots[normal[i]] = static_cast<int>(k_first_normal + i);
        if (const auto color = element.find_color())
            for (std::size_t i = 0; i < 3; ++i)
                slots[(*color)[i]] = static_cast<int>(k_first_color + i);
        if (const auto p = element.find(k_names[k_intensity]);
            p && !element.properties[*p].is_list())
            slots[*p] = static_cast<int>(k_intensity);
        return slots;
    }

    void read_vertices(const PlyElement& element) {
        const std::vector<int> slots = slots_of(element);
        std::array<float, 3> color_scales{};
        bool has_normals = false;
        bool has_colors = false;
        bool has_intensities = false;
        for (std::size_t p = 0; p < slots.size(); ++p) {
            if (slots[p] < static_cast<int>(k_first_normal)) continue;
            if (slots[p] < static_cast<int>(k_first_color)) {
                has_normals = true;
                continue;
            }
            if (slots[p] == static_cast<int>(k_intensity)) {
                has_intensities = true;
                continue;
            }
            has_colors = true;
            color_scales[slots[p] - k_first_color] = color_scale(element.properties[p].type);
        }
        PointSource& source = records_.source;
        source.positions.reserve(element.count);
        if (has_normals) source.normals.reserve(element.count);
        if (has_colors) source.colors.reserve(element.count);
        if (has_intensities) source.intensities.reserve(element.count);
        Body& body = elements_.body;
        std::array<double, k_names.size()> record{};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            elements_.checkpoint(i);
            body.begin_element("another vertex");
            for (std::size_t p = 0; p < slots.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (slots[p] < 0)
                    elements_.skip_property(property);
                else
                    record[slots[p]] = body.number(property.type, k_names[slots[p]]);
            }
            body.end_element("a vertex");
            const glm::dvec3 position(record[0], record[1], record[2]);
            if (const std::string why = refusal(i, position, bad_); !why.empty())
                body.fail_element(why);
            source.positions.push_back(position);
            if (has_normals)
                source.normals.push_back(float_of(glm::dvec3(record[3], record[4], record[5])));
            if (has_intensities) source.intensities.push_back(float_of(record[k_intensity]));
            if (has_colors) {
                PointColor color;
                for (std::size_t c = 0; c < 3; ++c)
                    color[c] = color_byte(float_of(record[k_first_color + c]) * color_scales[c]);
                source.colors.push_back(color);
            }
        }
    }

    const SourceFile& file_;
    const PlyHeader& header_;
    BadPoints bad_;
    PlyElements<Body> elements_;
    PointRecords records_;
};

}  // namespace

PointRecords read_ply_points(const SourceFile& file, BadPoints bad, const LongCall& call) {
    const PlyHeader header = read_ply_header(file, call);
    if (header.encoding == PlyEncoding::ascii)
        return PlyPointReader<PlyTextBody>(file, header, bad, call).read();
    return PlyPointReader<PlyBinaryBody>(file, header, bad, call).read();
}

}  // namespace rimline
