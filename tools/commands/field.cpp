// rimline field: a tangential distance field at points, or as a picture of a slice.

#include <CLI/App.hpp>
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
#include "silhouette/field/unit_planes.h"
#include "silhouette/mesh/winding.h"
#include "tools/command.h"
#include "tools/options/exact_text.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_file.h"
#include "tools/output/plot_scale.h"
#include "tools/output/slice_picture.h"
#include "tools/output/slice_values.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

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

class FieldCommand final : public Command {
public:
    std::string name() const override { return "field"; }
    std::string summary() const override {
        return "Evaluate or draw a tangential distance field around a model";
    }

    void add_options(CLI::App& app) override {
        app_ = &app;
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
        app.add_option(
               "--weight", weight_,
               "Weight of a plane: 1, or the area of its faces in squared radii of the model")
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
            "shell in which the function is defined; the two other axes point right and up, in\n"
            "the model's own units. The model is drawn as seen along the axis, and where the\n"
            "slice cuts it. It sums in every fourth square, and interpolates between them where a\n"
            "check says that this changes values by less than the tolerance.\n\n"
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
        if (!slice_) refuse_options(*app_, {"--resolution"}, "belongs to --slice");
        std::optional<OutputFile> file;
        if (slice_) file.emplace(output_, model_.model);

        const Mesh mesh = model_.load_mesh(context);
        check_has_planes(model_.model, mesh);
        std::optional<Progress> progress;
        progress.emplace(context, "grouping planes");
        const UnitPlanes planes = outward_planes(mesh, context.stop);
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
            {"inside_out", is_inside_out(mesh)},
            {"greatest_value", field.max_value()},
            {"error_bound", votes.error_bound()},
        };
        add_values(field.frame(), votes, object);
        context.times.end("votes");
        progress.reset();
        if (slice_) draw(mesh, function, votes, *file, object, context);
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
        std::printf("%s: %zu plane%s, %s; values are right to %.3g\n", model_.model.c_str(), planes,
                    planes == 1 ? "" : "s", function_.c_str(), error_bound);
        for (std::size_t i = 0; i < at_.size(); ++i)
            std::printf("  %s  %.9g\n", vector_text(at_[i]).c_str(),
                        object["values"][i].get<double>());
        if (!slice_) return;
        const auto& slice = object["slice"];
        const auto at = slice["greatest_at"].get<std::array<double, 3>>();
        std::printf("  %s: from %.6g to %.6g, at %.9g,%.9g,%.9g\n", output_.c_str(),
                    slice["least"].get<double>(), slice["greatest"].get<double>(), at[0], at[1],
                    at[2]);
    }

    void draw(const Mesh& mesh, const NamedFunction& function, const DiscountedField& votes,
              OutputFile& file, nlohmann::ordered_json& object, const Context& context) const {
        const SliceGrid grid(slice_->axis, slice_->value, function.min_radius, function.max_radius,
                             static_cast<int>(resolution_));
        if (grid.points().empty())
            throw UsageError(
                "--slice: that plane does not meet the function's domain, which ends " +
                short_number(function.max_radius, 0.1) + " radii from the center");
        const SliceValues slice = [&] {
            Progress progress(context, "summing votes");
            return slice_values(
                grid, votes.error_bound(),
                [&](std::span<const glm::dvec3> points, std::span<double> out,
                    const LongCall& call) { votes.values(points, out, call); },
                progress.call());
        }();
        context.times.end("votes");
        const std::vector<double>& values = slice.values;
        const auto [least, greatest] = std::ranges::minmax_element(values);
        const UnitFrame& frame = votes.field().frame();
        const glm::dvec3 at =
            frame.to_model(grid.points()[static_cast<std::size_t>(greatest - values.begin())]);
        const double coordinate = frame.center[slice_->axis] + slice_->value * frame.radius;
        Progress progress(context, "drawing the slice");
        write_picture(file, draw_slice({.mesh = mesh,
                                        .frame = frame,
                                        .grid = grid,
                                        .values = values,
                                        .title = function_ + ", " + axis_name() + " = " +
                                                 short_number(coordinate, 0.01 * frame.radius),
                                        .unit = weight_ == "area" ? "votes x area" : "votes"},
                                       progress.call()));
        context.times.end("drawing");
        object["slice"] = {
            {"axis", axis_name()},      {"value", slice_->value},
            {"coordinate", coordinate}, {"least", *least},
            {"greatest", *greatest},    {"greatest_at", json_vector(at)},
            {"sums", slice.sums},       {"interpolation_error", slice.greatest_error},
            {"output", output_}};
    }

    std::string axis_name() const { return std::string(1, static_cast<char>('x' + slice_->axis)); }

    const CLI::App* app_ = nullptr;
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
