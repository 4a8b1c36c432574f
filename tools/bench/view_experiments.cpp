#include "tools/bench/view_experiments.h"

#include <algorithm>
#include <vector>

#include "engine/measure/view_ratios.h"
#include "engine/view_defaults.h"
#include "silhouette/field/best_views.h"
#include "silhouette/field/sun_choice.h"
#include "tools/bench/mesh_variants.h"
#include "tools/options/picture_scene.h"
#include "tools/options/simplified_mesh.h"
#include "tools/output/contact_sheet.h"
#include "tools/output/output_folder.h"
#include "tools/output/picture_file.h"
#include "tools/output/view_pictures.h"

namespace rimline::tools {

namespace {

constexpr ImageSize k_cell{400, 300};
constexpr std::uint32_t k_views = 4;
constexpr std::uint32_t k_gap = 4;
constexpr double k_bend_deg = 70.0;
constexpr double k_crease_deg = 50.0;  // Edges of machine parts.

// One mesh on the device.
class Stage {
public:
    Stage(const std::string& model, const Mesh& mesh, const Device& device, glm::vec3 up)
        : model_(model),
          octree_(mesh),
          ratios_(device.context(), octree_),
          renderer_(device.context()) {
        picture_.up = up;
    }

    std::vector<glm::dvec3> choose(bool has_ratio, const TangentialFunction& function,
                                   const Context& context) {
        const TangentialField field = make_view_field(octree_.mesh(), {}, function);
        BestViewsOptions options;
        options.count = k_views;
        if (has_ratio)
            options.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
                return ratios_.measure(eyes, context.stop);
            };
        std::vector<glm::dvec3> eyes;
        for (const BestView& view : find_best_views(field, options, {context.stop, {}}).views)
            eyes.push_back(view.eye);
        return eyes;
    }

    std::vector<Picture> draw(const std::vector<glm::dvec3>& eyes, const char* style,
                              bool has_chosen_sun, const Context& context) {
        const Mesh& mesh = octree_.mesh();
        std::vector<LightedView> views;
        for (const glm::dvec3& eye : eyes) {
            const Camera camera = make_view_camera(mesh, eye, picture_, k_cell);
            const std::optional<ChosenSun> sun =
                has_chosen_sun ? choose_sun(mesh, eye, {context.stop, {}}) : std::nullopt;
            views.push_back({eye, {sun ? Light{.vector = sun->direction} : default_sun(camera)}});
        }
        SceneOptions scene;
        scene.style = style;
        scene.crease_degrees = k_crease_deg;
        if (!lines_) lines_.emplace(prepare_lines(octree_, context));
        return draw_views(renderer_, {model_, octree_, scene, picture_, &*lines_}, views, k_cell,
                          context);
    }

private:
    const std::string& model_;
    HoughOctree octree_;
    ViewRatios ratios_;
    Renderer renderer_;  // One a mesh: a renderer identifies meshes by address.
    std::optional<ShownLines> lines_;
    PictureOptions picture_;
};

}  // namespace

void draw_view_experiments(const std::string& model, const Mesh& mesh, const Device& device,
                           const std::optional<glm::vec3>& up, const std::filesystem::path& folder,
                           const Context& context) {
    const OutputFolder output(folder, "pictures");
    PictureOptions upright;
    upright.up = up;
    const glm::vec3 axis(up_of(mesh, upright));
    struct Sheet {
        std::string name;
        Picture picture;
    };
    std::vector<Sheet> sheets;
    const auto add = [&](const char* name, const std::vector<Picture>& pictures) {
        if (!pictures.empty())
            sheets.push_back({name, make_contact_sheet(pictures, k_views, k_gap, {255, 255, 255})});
    };
    const auto add_views = [&](const char* name, const Mesh& of, bool has_ratio,
                               const TangentialFunction& function) {
        Stage stage(model, of, device, axis);
        const std::vector<glm::dvec3> eyes = stage.choose(has_ratio, function, context);
        add(name, stage.draw(eyes, "ink", false, context));
    };
    add_views("votes", mesh, false, view_function());
    add_views("plateau_2", mesh, true, view_function(1.0, 2.0));
    for (const auto& [name, faces] : {std::pair("10k", 10'000u), std::pair("20k", 20'000u)})
        if (mesh.face_count() > faces)
            add_views(name, Mesh(simplified(mesh, faces)), true, view_function());
    add_views("bent", Mesh(bent(mesh, glm::dvec3(axis), k_bend_deg)), true, view_function());
    {
        Stage stage(model, mesh, device, axis);
        const std::vector<glm::dvec3> eyes = stage.choose(true, view_function(), context);
        add("ratio", stage.draw(eyes, "ink", false, context));
        std::vector<Picture> lit = stage.draw(eyes, "toon", false, context);
        lit.resize(eyes.empty() ? 0 : k_views,
                   {k_cell.width, k_cell.height,
                    std::vector<std::uint8_t>(std::size_t{4} * k_cell.width * k_cell.height, 255)});
        for (Picture& picture : stage.draw(eyes, "toon", true, context))
            lit.push_back(std::move(picture));
        add("light", lit);
    }
    const std::string name = std::filesystem::path(model).stem().string();
    for (const Sheet& sheet : sheets) {
        OutputFile file(output.path() / (name + "_" + sheet.name + ".png"));
        write_png(file, sheet.picture);
    }
}

}  // namespace rimline::tools
