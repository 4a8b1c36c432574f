// rimline field: a tangential distance field at points, or as a picture of a slice.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/field/tangential_field.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/output/canvas.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_file.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr Color k_white{255, 255, 255};
constexpr Color k_black{30, 30, 30};
constexpr Color k_outside{225, 225, 225};

struct Slice {
    int axis;      // 0, 1 or 2.
    double value;  // Of that coordinate, in unit coordinates.
};

Slice parse_slice(const std::string& option, const std::string& text) {
    const auto wrong = [&] {
        return CLI::ValidationError(option,
                                    "expected x=NUMBER, y=NUMBER or z=NUMBER, not '" + text + "'");
    };
    if (text.size() < 3 || text[1] != '=' || text[0] < 'x' || text[0] > 'z') throw wrong();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= 1e6))
        throw wrong();
    return {text[0] - 'x', value};
}

// The points of a slice. The two other axes point right and up.
struct SliceGrid {
    int side;
    double extent;
    std::vector<glm::dvec3> points;  // Row by row from the top.
    std::vector<bool> is_inside;     // Inside the domain of the function.
};

SliceGrid make_grid(const Slice& slice, const NamedFunction& function, int side) {
    SliceGrid grid{side, function.max_radius, {}, {}};
    const int right = slice.axis == 0 ? 1 : 0;
    const int up = slice.axis == 2 ? 1 : 2;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            glm::dvec3 p(0.0);
            p[slice.axis] = slice.value;
            p[right] = grid.extent * (2.0 * (column + 0.5) / side - 1.0);
            p[up] = grid.extent * (1.0 - 2.0 * (row + 0.5) / side);
            const double radius = glm::length(p);
            grid.points.push_back(p);
            grid.is_inside.push_back(radius >= function.min_radius &&
                                     radius <= function.max_radius);
        }
    return grid;
}

// The slice, and beside it the color scale from the minimum to the maximum in the domain.
Canvas draw(const SliceGrid& grid, const std::vector<double>& values, double minimum,
            double maximum) {
    const int scale = std::max(1, grid.side / 256);
    const int margin = 12 * scale;
    const int bar = 16 * scale;
    const int numbers = 9 * 6 * scale;
    Canvas canvas(static_cast<std::uint32_t>(grid.side + 3 * margin + bar + numbers),
                  static_cast<std::uint32_t>(grid.side + 2 * margin), k_white);
    const double range = maximum > minimum ? maximum - minimum : 1.0;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const auto i = static_cast<std::size_t>(row * grid.side + column);
            canvas.set(
                margin + column, margin + row,
                grid.is_inside[i] ? viridis_color((values[i] - minimum) / range) : k_outside);
        }
    const int left = 2 * margin + grid.side;
    for (int row = 0; row < grid.side; ++row)
        canvas.fill(left, margin + row, bar, 1, viridis_color(1.0 - (row + 0.5) / grid.side));
    constexpr int k_steps = 5;
    for (int step = 0; step <= k_steps; ++step) {
        const double value = minimum + range * step / k_steps;
        const int y = margin + (grid.side - 1) * (k_steps - step) / k_steps;
        canvas.fill(left + bar, y - scale / 2, 3 * scale, scale, k_black);
        const int top = std::clamp(y - Canvas::text_height(scale) / 2, margin,
                                   margin + grid.side - Canvas::text_height(scale));
        canvas.write(left + bar + 6 * scale, top, short_number(value, range / k_steps), k_black,
                     scale);
    }
    return canvas;
}

class FieldCommand final : public Command {
public:
    std::string name() const override { return "field"; }
    std::string summary() const override {
        return "Evaluate or draw a tangential distance field around a model";
    }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        std::string names;
        std::vector<std::string> choices;
        for (const NamedFunction& named : named_functions()) {
            choices.emplace_back(named.name);
            std::string line(named.name);
            line.resize(18, ' ');
            names += "  " + line + std::string(named.what) + "\n";
        }
        app.add_option("--function", function_, "Function of a plane's votes, see below")
            ->check(CLI::IsMember(choices))
            ->type_name("NAME")
            ->option_text("NAME [origins]");
        app.add_option("--weight", weight_, "Weight of a plane: 1, or the area of its faces")
            ->type_name("count|area")
            ->check(CLI::IsMember({"count", "area"}))
            ->capture_default_str();
        add_number(app, "--tolerance", tolerance_, 0.0, 1.0,
                   "Error of a value, relative to the greatest possible value; 0 sums all planes");
        add_points(app, "--discount", discounts_,
                   "Point already chosen: planes vote only for better points; repeatable");
        add_points(app, "--at", at_, "Print the value at this point; repeatable");
        app.add_option_function<std::string>(
               "--slice",
               [this](const std::string& text) { slice_ = parse_slice("--slice", text); },
               "Draw the field in this plane, at VALUE of the model's radii from its center")
            ->type_name("AXIS=VALUE");
        add_count(app, "--resolution", resolution_, 16, 8192, "Side of the slice in pixels");
        add_output(app, "-o,--output", output_, ".png", "PNG file for the slice");
        app.footer(
            "The field at a point is a sum over all planes of the model's faces. Each plane adds "
            "a\n"
            "function of the point's signed distance from it. Distances are in the model's radii;\n"
            "--at and --discount are in the model's own coordinates. A slice shows the ball or\n"
            "shell in which the function is defined; the two other axes point right and up.\n\n"
            "Functions:\n" +
            names +
            "\nExamples:\n"
            "  rimline field fandisk.obj --function views --slice z=0 -o slice.png\n"
            "  rimline field bunny.obj --function origins --at 0,0.1,0 --at 0.1,0,0 --json");
    }

    ExitStatus run(const Context& context) override {
        check_output(context, output_);
        if (at_.empty() && !slice_) throw UsageError("field: say what to tell: --at or --slice");
        if (slice_.has_value() != !output_.empty())
            throw UsageError("field: --slice and --output go together");
        std::optional<OutputFile> file;
        if (slice_) file.emplace(output_, model_.model);

        const Mesh mesh = model_.load_mesh(context);
        std::optional<Progress> progress;
        progress.emplace(context, "grouping planes");
        const UnitPlanes planes(mesh);
        const NamedFunction& function = *find_named_function(function_);
        const TangentialField field(planes, function.function,
                                    {tolerance_, weight_ == "area" ? FieldOptions::Weight::area
                                                                   : FieldOptions::Weight::count});
        context.checkpoint();
        progress.emplace(context, "voting");
        context.times.end("planes");
        DiscountedField votes(field);
        for (const glm::vec3& point : discounts_)
            votes.discount(field.frame().from_model(glm::dvec3(point)));

        nlohmann::ordered_json object{
            {"model", model_.model},
            {"function", function_},
            {"weight", weight_},
            {"planes", field.plane_count()},
            {"center", json_vector(field.frame().center)},
            {"radius", field.frame().radius},
            {"greatest_value", field.max_value()},
            {"error_bound", votes.error_bound()},
        };
        add_values(field.frame(), votes, object);
        context.times.end("votes");
        progress.reset();
        if (slice_) draw_slice(function, votes, *file, object, context);
        if (context.json)
            print_json(context, std::move(object));
        else
            print(object, field.plane_count(), votes.error_bound());
        return ExitStatus::success;
    }

private:
    void add_values(const UnitFrame& frame, const DiscountedField& votes,
                    nlohmann::ordered_json& object) const {
        std::vector<glm::dvec3> points;
        for (const glm::vec3& at : at_) points.push_back(frame.from_model(glm::dvec3(at)));
        std::vector<double> values(points.size());
        votes.values(points, values);
        object["values"] = values;
    }

    // To be called last: after a failure standard output must be empty.
    void print(const nlohmann::ordered_json& object, std::size_t planes, double error_bound) const {
        std::printf("%s: %zu planes, %s; values are right to %.3g\n", model_.model.c_str(), planes,
                    function_.c_str(), error_bound);
        for (std::size_t i = 0; i < at_.size(); ++i)
            std::printf("  %.9g,%.9g,%.9g  %.9g\n", double{at_[i].x}, double{at_[i].y},
                        double{at_[i].z}, object["values"][i].get<double>());
        if (!slice_) return;
        const auto& slice = object["slice"];
        const auto at = slice["greatest_at"].get<std::array<double, 3>>();
        std::printf("  %s: from %.6g to %.6g, at %.9g,%.9g,%.9g\n", output_.c_str(),
                    slice["least"].get<double>(), slice["greatest"].get<double>(), at[0], at[1],
                    at[2]);
    }

    void draw_slice(const NamedFunction& function, const DiscountedField& votes, OutputFile& file,
                    nlohmann::ordered_json& object, const Context& context) const {
        const SliceGrid grid = make_grid(*slice_, function, static_cast<int>(resolution_));
        std::vector<double> values(grid.points.size());
        Progress progress(context, "summing votes");
        votes.values(grid.points, values, progress.call());
        context.times.end("votes");
        double minimum = INFINITY;
        double maximum = -INFINITY;
        std::size_t best = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!grid.is_inside[i]) continue;
            minimum = std::min(minimum, values[i]);
            if (values[i] > maximum) best = i;
            maximum = std::max(maximum, values[i]);
        }
        if (!(minimum <= maximum))
            throw Error(ErrorCode::bad_input,
                        "--slice: that plane does not meet the function's domain, which ends " +
                            short_number(function.max_radius, 0.1) + " from the center");
        write_picture(file, draw(grid, values, minimum, maximum));
        context.times.end("writing");
        const glm::dvec3 at = votes.field().frame().to_model(grid.points[best]);
        object["slice"] = {{"axis", std::string(1, static_cast<char>('x' + slice_->axis))},
                           {"value", slice_->value},
                           {"least", minimum},
                           {"greatest", maximum},
                           {"greatest_at", json_vector(at)},
                           {"output", output_}};
    }

    ModelArgument model_;
    std::string function_ = "origins";
    std::string weight_ = "count";
    double tolerance_ = 1e-3;
    std::vector<glm::vec3> discounts_;
    std::vector<glm::vec3> at_;
    std::optional<Slice> slice_;
    std::uint32_t resolution_ = 512;
    std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_field_command() { return std::make_unique<FieldCommand>(); }

}  // namespace rimline::tools
