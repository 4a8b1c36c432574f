#include "tools/view/view_session.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/tools/scratch_folder.h"
#include "tests/tools/view/opened_model.h"
#include "tools/options/picture_scene.h"
#include "tools/options/three_point.h"
#include "tools/output/same_picture.h"
#include "tools/view/camera_motion.h"
#include "tools/view/screen_view.h"
#include "tools/view/view_arguments.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

std::unique_ptr<CloudDocument> open_cloud(const std::string& name) {
    return std::make_unique<CloudDocument>(CloudArgument{.model = name, .as_points = true},
                                           [](const std::string&) { return LongCall{}; });
}

// Whether every vertex of the shown model is in a picture of this aspect.
bool all_in_view(const ViewSession& session, double aspect) {
    const ScreenView view(session.camera, {aspect, 1.0});
    for (const glm::vec3& position : session.model().mesh().positions()) {
        const auto pixel = view.pixel_of(glm::dvec3(position));
        if (!pixel || pixel->x < 0.0 || pixel->x > aspect || pixel->y < 0.0 || pixel->y > 1.0)
            return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a model that is shown is wholly in view, lit, and drawn as the look says") {
    ViewSession session;
    CHECK(session.is_empty());
    for (const double aspect : {0.5, 1.0, 2.5}) {
        session.show(tests::opened_model("shape:spring"), aspect);
        CHECK(all_in_view(session, aspect));
    }
    CHECK(session.lights.size() == 1);
    session.appearance.style = Style::toon;
    session.appearance.line_width_px = 4.0f;
    session.appearance.lines = false;
    session.appearance.shadows = false;
    const Scene scene = session.scene();
    REQUIRE(scene.instances.size() == 1);
    CHECK(scene.instances[0].octree == &session.model().octree());
    CHECK(scene.style == Style::toon);
    CHECK(scene.line_width_px == 4.0f);
    CHECK_FALSE(scene.lines);
    CHECK_FALSE(scene.shadows);
    CHECK_FALSE(scene.silhouette_camera);
    session.appearance.ground = true;
    CHECK(session.scene().instances.size() == 2);
}

TEST_CASE(
    "a model has the colors of its file until the user chooses a color or switches them off") {
    ViewSession session;
    session.show(tests::opened_model("shape:spring"), 1.0);
    const auto shows_mesh_colors = [&] {
        return session.scene().instances[0].material.shows_mesh_colors;
    };
    CHECK(shows_mesh_colors());
    session.appearance.color = glm::vec3(0.5f);
    CHECK_FALSE(shows_mesh_colors());
    session.appearance.color.reset();
    session.appearance.materials = false;
    CHECK_FALSE(shows_mesh_colors());
}

TEST_CASE(
    "a cloud is wholly in view, and its lines are the silhouette from the camera or where it "
    "froze") {
    ViewSession session;
    session.show(open_cloud("shape:torus:4000"), 1.5);
    REQUIRE(session.is_cloud());
    CHECK(session.lights.empty());
    const UmbrellaIndex& umbrellas = session.cloud().umbrellas();
    const ScreenView view(session.camera, {1.5, 1.0});
    for (const glm::vec3& position : umbrellas.positions()) {
        const auto pixel = view.pixel_of(glm::dvec3(position));
        REQUIRE(pixel);
        CHECK((pixel->x >= 0.0 && pixel->x <= 1.5 && pixel->y >= 0.0 && pixel->y <= 1.0));
    }
    const auto consensus_count = [&](const HomogeneousPoint& point) {
        return PointSilhouette(umbrellas, point).consensus().size();
    };
    const SplatScene scene = std::get<SplatScene>(session.picture());
    CHECK(scene.cloud->splats.size() >= session.cloud().surface().size());
    CHECK(scene.strokes.size() == consensus_count(session.silhouette_point()));
    CHECK(scene.strokes.size() > 20);
    session.freeze();
    const HomogeneousPoint frozen_at = session.silhouette_point();
    orbit(session.camera, {0.9, 0.1});
    CHECK(session.silhouette_point() == frozen_at);
    CHECK(session.cloud_scene().strokes.size() == scene.strokes.size());
    session.thaw();
    CHECK(session.cloud_scene().strokes.size() == consensus_count(session.silhouette_point()));
    CHECK(session.cloud().report().consensus_edges == session.cloud_scene().strokes.size());
    const std::uint64_t revision = session.cloud_scene().cloud->revision;
    CHECK(session.cloud_scene().cloud->revision == revision);
    session.appearance.color = glm::vec3(1.0f, 0.0f, 0.0f);
    CHECK(session.cloud_scene().cloud->revision != revision);
    session.appearance.lines = false;
    CHECK(session.cloud_scene().strokes.empty());
    CHECK(std::ranges::all_of(  // Dots, and no border.
        session.cloud_scene().cloud->strokes,
        [](const gpu::StrokeRecord& stroke) { return stroke.from == stroke.to; }));
}

TEST_CASE("a frozen silhouette stays that of where the camera was") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot:4000"), 1.5);
    const HomogeneousPoint before = session.silhouette_point();
    CHECK(before == HomogeneousPoint::viewpoint(glm::vec3(session.camera.eye)));
    session.freeze();
    orbit(session.camera, {1.0, 0.3});
    CHECK(session.silhouette_point() == before);
    const Scene scene = session.scene();
    REQUIRE(scene.silhouette_camera);
    CHECK(glm::vec3(scene.silhouette_camera->eye) == before.xyz());
    CHECK(scene.camera.eye != scene.silhouette_camera->eye);
    session.replace(tests::opened_model("shape:knot:2000"));  // The same with its models moved.
    CHECK(session.silhouette_point() == before);
    session.thaw();
    CHECK(session.silhouette_point() == HomogeneousPoint::viewpoint(glm::vec3(session.camera.eye)));
    session.freeze();
    session.show(tests::opened_model("shape:box"), 1.5);
    CHECK_FALSE(session.frozen());
}

TEST_CASE("another lens keeps the size of what lies at the target") {
    ViewSession session;
    session.show(tests::opened_model("shape:torus"), 1.0);
    const double height = view_height(session.camera);
    session.appearance.fov_y_deg = 70.0;
    session.apply_lens();
    CHECK(view_height(session.camera) == doctest::Approx(height));
    session.appearance.orthographic = true;
    session.apply_lens();
    CHECK(session.camera.is_orthographic());
    CHECK(view_height(session.camera) == doctest::Approx(height));
    CHECK(session.silhouette_point().is_direction());
    session.appearance.orthographic = false;
    session.apply_lens();
    CHECK_FALSE(session.camera.is_orthographic());
    CHECK(view_height(session.camera) == doctest::Approx(height));
}

TEST_CASE("fitting brings the model back into view from where the camera is, by any lens") {
    ViewSession session;
    session.show(tests::opened_model("shape:spring"), 1.2);
    for (const bool orthographic : {false, true}) {
        session.appearance.orthographic = orthographic;
        session.apply_lens();
        orbit(session.camera, {2.0, -0.4});
        pan(session.camera, {3.0, 1.0});
        const glm::dvec3 ahead = glm::normalize(session.camera.target - session.camera.eye);
        session.fit({.window = {1.2, 1.0}});
        CHECK(all_in_view(session, 1.2));
        CHECK(glm::distance(glm::normalize(session.camera.target - session.camera.eye), ahead) <
              1e-9);
    }
}

TEST_CASE("the camera looks from where it is told to, level, and never straight along its axis") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.2);
    const glm::dvec3 up = session.camera.up;
    for (const glm::dvec3& wanted : {glm::dvec3(0, 0, 1), {1, 0.4, -0.3}, {0, 1, 0}, {0, -2, 0}}) {
        session.look_from(wanted);
        CHECK(session.camera.up == up);
        CHECK(session.camera.target == session.bounds().center);
        const glm::dvec3 direction = glm::normalize(session.camera.eye - session.camera.target);
        CHECK(glm::dot(direction, glm::normalize(wanted)) > 0.9998);
        CHECK(std::abs(glm::dot(direction, up)) < 0.9999);
    }
    // From above, the front is below.
    session.look_from({0, 1, 0});
    CHECK(session.camera.eye.z > session.camera.target.z);
}

TEST_CASE("the chosen sun takes the place of all lights and lights what the camera sees") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.2);
    session.add_light();
    CHECK_FALSE(session.has_chosen_sun());
    session.choose_sun(1.2);
    REQUIRE(session.lights.size() == 1);
    CHECK(session.has_chosen_sun());
    CHECK(session.lights[0].directional);
    CHECK(glm::dot(session.lights[0].vector, session.camera.eye - session.camera.target) > 0.0);
    const glm::dvec3 sun = session.lights[0].vector;
    session.look_from(session.camera.target - session.camera.eye);
    session.choose_sun(1.2);
    CHECK(glm::dot(session.lights[0].vector, session.camera.eye - session.camera.target) > 0.0);
    CHECK(session.lights[0].vector != sun);
}

TEST_CASE("a sun that was chosen has its direction again when it is restored") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.2);
    REQUIRE(session.has_chosen_sun());
    const glm::dvec3 sun = session.lights[0].vector;
    const ViewEdit before = session.edit();
    session.lights[0].vector = {0, 1, 0};  // Dragged.
    CHECK_FALSE(session.edit() == before);
    session.look_from(session.camera.target - session.camera.eye);
    session.restore(before);
    CHECK(session.has_chosen_sun());
    CHECK(session.lights[0].vector == sun);
    // One that is chosen for another camera stays.
    session.look_from({1, 0, 0});
    session.choose_sun(1.2);
    const glm::dvec3 other = session.lights[0].vector;
    CHECK(other != sun);
    CHECK(session.edit() == before);
    session.restore(before);
    CHECK(session.lights[0].vector == other);
}

TEST_CASE("a camera that moves keeps the model in its place and its chosen sun beside it") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.2);
    const FreeArea area{.window = {900, 700}, .left = 320};
    session.fit(area);
    CHECK(session.is_whole(area));
    const auto sun_in_picture = [&] {
        return camera_from_world(session.camera) * session.lights[0].vector;
    };
    const glm::dvec3 sun = sun_in_picture();
    const ScreenView before(session.camera, area.window);
    const auto place = before.pixel_of(session.bounds().center);
    session.move_to({-1.0, 0.3, -0.5});
    CHECK(session.has_chosen_sun());
    CHECK(glm::distance(sun_in_picture(), sun) < 1e-9);
    const ScreenView after(session.camera, area.window);
    CHECK(glm::distance(*after.pixel_of(session.bounds().center), *place) < 1e-6);
    session.round_to_options();
    CHECK(session.has_chosen_sun());
    session.lights[0].vector = {0, 1, 0};  // The user's own.
    session.move_to({1.0, 0.3, -0.5});
    CHECK(session.lights[0].vector == glm::dvec3(0, 1, 0));
    pan(session.camera, {2.0, 0.0});
    CHECK_FALSE(session.is_whole(area));
}

TEST_CASE(
    "the command of a window says what differs from the style's own, and all of camera and "
    "lights") {
    ViewSession session;
    session.appearance.set_style(Style::toon);
    session.appearance.ground = true;
    session.appearance.line_width_px = 3.5f;
    session.show(tests::opened_model("shape:knot"),
                 {.eye = {3, 2, 4}, .target = {0, 0.5, 0}, .fov_y_deg = 30},
                 {{.vector = {1, 2, 0.5}, .directional = true},
                  {.vector = {3, 1, 1}, .directional = false}});
    CHECK(session.command({320, 240}, "my picture.png") ==
          "rimline render shape:knot --style toon --lines on --line-width 3.5 --ground --size "
          "320x240 "
          "--eye 3,2,4 --target 0,0.5,0 --up 0,1,0 --fov 30 --sun 1,2,0.5 --light 3,1,1 -o 'my "
          "picture.png'");
    session.show(tests::opened_model("shape:knot"), {.eye = {3, 2, 4}}, {{.vector = {1, 2, 0.5}}});
    session.document().model()->set_models(
        std::vector<PlacedModel>{{.model = "shape:knot", .subdivide = 2}}, std::nullopt);
    CHECK(session.command({320, 240}, "a.png")
              .starts_with("rimline render shape:knot --subdivide 2 --style "));
    CHECK(session.command_obstacle().empty());
}

TEST_CASE("the command of a cloud has its camera and its silhouette as the file has coordinates") {
    ViewSession session;
    session.show(open_cloud("shape:torus:2000"), 1.5);
    const UmbrellaIndex& umbrellas = session.cloud().umbrellas();
    session.freeze();
    orbit(session.camera, {-0.8, 0.3});
    pan(session.camera, {0.1, 0.2});
    session.round_to_options();
    CHECK(session.command_obstacle().empty());
    std::string command = session.command({320, 240}, "a.png");
    CHECK(command.starts_with("rimline points shape:torus:2000 --as-points --eye"));
    CHECK(command.ends_with(" --background '#f8f4ec' --size 320x240 -o a.png"));
    // As the options are read.
    const auto in_index = [&](const std::string& option) {
        const std::size_t at = command.find(" " + option);
        REQUIRE(at != std::string::npos);
        const std::string value = command.substr(at + option.size() + 2);
        return umbrellas.to_index(parse_exact_point(option, value.substr(0, value.find(' '))));
    };
    CHECK(in_index("--eye") == glm::vec3(session.camera.eye));
    CHECK(in_index("--target") == glm::vec3(session.camera.target));
    CHECK(in_index("--from") == session.silhouette_point().xyz());
    session.appearance.orthographic = true;
    session.apply_lens();
    session.freeze();
    command = session.command({320, 240}, "a.png");
    CHECK(command.find(" --direction") != std::string::npos);
    CHECK(command.find(" --ortho " + exact_text(session.camera.ortho_height / umbrellas.scale())) !=
          std::string::npos);
    session.appearance.line_color = glm::vec3(0.5f);
    CHECK(session.command_obstacle().find("(P)") != std::string::npos);
}

TEST_CASE("what no command says is refused with a word of what says it") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.0);
    const auto shows = [&](std::uint32_t first, std::uint32_t second, const glm::dvec3& up) {
        session.document().model()->set_models(
            {{.model = "shape:box", .subdivide = first},
             {.model = "shape:knot", .subdivide = second, .at = {3, 0, 0}}},
            up);
    };
    for (const std::uint32_t steps : {0u, 2u}) {
        shows(steps, steps, session.camera.up);
        CHECK(session.command_obstacle().empty());
        const bool says =
            session.command({320, 240}, "a.png").find("--subdivide 2 ") != std::string::npos;
        CHECK(says == (steps > 0));
    }
    const auto obstacle_has = [&](const char* words) {
        return session.command_obstacle().find(words) != std::string::npos;
    };
    shows(0, 1, session.camera.up);
    CHECK(obstacle_has("subdivided"));
    CHECK(obstacle_has("scene file (X)"));
    shows(1, 1, {1, 0, 0});
    CHECK(obstacle_has("up is another axis"));
    CHECK(obstacle_has("scene file (X)"));
}

TEST_CASE("three-point lighting is in the command and in the scene file as its sun") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"),
                 {.eye = {3, 2, 4}, .target = {0, 0.5, 0}, .fov_y_deg = 30},
                 {{.vector = {1, 2, 0.5}, .directional = true}});
    CHECK_FALSE(session.written_scene({320, 240}).picture.contains("lighting"));
    session.appearance.three_point = true;
    // Fill and rim follow the camera.
    for (const glm::dvec3 direction : {glm::dvec3(1, 1, 1), glm::dvec3(-2, 0, 1)}) {
        session.look_from(direction);
        Scene expected = session.scene();
        REQUIRE(expected.lights.size() == 3);
        expected.lights.resize(1);
        add_fill_and_rim(expected);
        const Scene scene = session.scene();
        for (std::size_t light = 0; light < 3; ++light) {
            CHECK(scene.lights[light].vector == expected.lights[light].vector);
            CHECK(scene.lights[light].share == expected.lights[light].share);
        }
    }
    const WrittenScene written = session.written_scene({320, 240});
    CHECK(written.picture["lighting"] == "three-point");
    CHECK(written.lights.size() == 1);
    const std::string command = session.command({320, 240}, "a.png");
    CHECK(command.find("--lighting three-point") != std::string::npos);
    CHECK(command.find("--sun 1,2,0.5") != std::string::npos);
    // A picture with them takes no other light.
    session.add_light();
    CHECK_FALSE(session.written_scene({320, 240}).picture.contains("lighting"));
    CHECK(session.scene().lights.size() == 2);
    session.remove_light(1);
    CHECK(session.is_three_point());
}

TEST_CASE("a frozen silhouette is in the command and in the scene file") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"),
                 {.eye = {3.1, 2, 4}, .target = {0, 0.5, 0}, .fov_y_deg = 30},
                 {{.vector = {1, 2, 0.5}, .directional = true}});
    const auto says = [&](const std::string& words) {
        return session.command({320, 240}, "a.png").find(words) != std::string::npos;
    };
    CHECK_FALSE(says("--silhouette-from"));
    session.freeze();
    orbit(session.camera, {1.0, 0.3});
    CHECK(says(" --silhouette-from 3.1,2,4 "));
    CHECK(session.written_scene({320, 240}).picture["silhouette-from"] ==
          nlohmann::ordered_json{3.1, 2.0, 4.0});
    // What a picture is drawn with is what the command says.
    session.round_to_options();
    CHECK(session.silhouette_point() == HomogeneousPoint::viewpoint({3.1f, 2.0f, 4.0f}));

    Camera from{.eye = {1, 2.5, -2}, .target = {0, 0.5, 0}};
    from.ortho_height = 3.0;
    session.camera = from;
    session.freeze();
    CHECK(says(" --silhouette-direction 1,2,-2 "));
    CHECK(session.written_scene({320, 240}).picture["silhouette-direction"] ==
          nlohmann::ordered_json{1.0, 2.0, -2.0});
    session.round_to_options();
    CHECK(session.silhouette_point().is_direction());
    session.thaw();
    CHECK_FALSE(says("--silhouette"));
}

TEST_CASE("what cannot be drawn gives way to the model before it") {
    ViewSession session;
    CHECK_FALSE(session.show_previous(1.0));
    session.show(tests::opened_model("shape:box"), 1.0);
    session.forget_previous();
    CHECK_FALSE(session.show_previous(1.0));
    session.show(tests::opened_model("shape:sphere:500"), 1.0);
    CHECK(session.model().name() == "shape:sphere:500");
    CHECK(session.show_previous(1.0));
    CHECK(session.model().name() == "shape:box");
    CHECK_FALSE(session.show_previous(1.0));
}

TEST_CASE("up is what is chosen: the ground follows it") {
    ViewSession session;
    session.show(tests::opened_model("shape:box"), 1.0);
    session.appearance.ground = true;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 up(0.0);
        up[axis] = 1.0;
        set_up(session.camera, up);
        const Mesh& ground = session.scene().instances[1].octree->mesh();
        for (const glm::vec3& corner : ground.positions())
            CHECK(corner[axis] == doctest::Approx(-1.0).epsilon(0.01));
        // The same one in every frame: a renderer knows it by its address.
        CHECK(&ground == &session.scene().instances[1].octree->mesh());
    }
}

TEST_CASE("lights that are added differ, and any but the last can go") {
    ViewSession session;
    session.show(tests::opened_model("shape:box"), 1.0);
    for (int i = 0; i < 5; ++i) session.add_light();
    REQUIRE(session.lights.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j)
            CHECK(glm::distance(session.lights[i].vector, session.lights[j].vector) > 0.2);
    const Light second = session.lights[1];
    session.remove_light(0);
    CHECK(session.lights[0].vector == second.vector);
    while (session.lights.size() > 1) session.remove_light(session.lights.size() - 1);
    CHECK(session.lights[0].vector == second.vector);
}

TEST_CASE("a scene that the window writes says what the window shows") {
    ViewSession session;
    session.show(tests::opened_model("shape:box"), 1.5);
    std::vector<PlacedModel> models(2);
    models[0].model = "shape:box";
    models[1] = {.model = "shape:knot:3000",
                 .subdivide = 1,
                 .at = {0.1f, 2.0f, -3.3f},
                 .turn = {.axis = glm::vec3(1, 2, 3), .degrees = 33.3},
                 .scale = 0.7,
                 .up = UpChoice{glm::vec3(0, 0, 1)},
                 .paint = Color{200, 100, 50}};
    session.document().model()->set_models(models, glm::dvec3(0, 0, 1));
    session.appearance.set_style(Style::toon);
    session.appearance.ground = true;
    session.appearance.line_width_px = 3.3f;
    session.appearance.background = linear_from_srgb(Color{10, 20, 30});
    session.lights.push_back({.vector = {1.5, 2.5, 3.5}, .directional = false});

    const tests::ScratchFolder folder;
    const std::string path = (folder / "scene.json").string();
    tests::write_bytes(path, scene_text(session.written_scene({640, 480}), path));
    const SceneFile scene = read_scene_file(path);
    REQUIRE(scene.models.size() == 2);
    CHECK(scene.models[1].model == models[1].model);
    CHECK(scene.models[1].subdivide == 1);
    CHECK(scene.models[1].at == models[1].at);
    CHECK(scene.models[1].turn == models[1].turn);
    CHECK(scene.models[1].scale == models[1].scale);
    CHECK(scene.models[1].up == models[1].up);
    CHECK(scene.models[1].paint == models[1].paint);
    REQUIRE(scene.up);
    CHECK(scene.up->direction == glm::vec3(0, 0, 1));
    const auto value = [](const std::vector<SceneFile::Setting>& settings, const char* option) {
        for (const SceneFile::Setting& setting : settings)
            if (setting.option == option) return setting.value;
        return std::string("nothing");
    };
    CHECK(scene.lights.size() == 2);
    CHECK(value(scene.lights, "--light") == "1.5,2.5,3.5");
    CHECK(value(scene.picture, "--style") == "toon");
    CHECK(value(scene.picture, "--ground") == "true");
    CHECK(value(scene.picture, "--line-width") == "3.3");
    CHECK(value(scene.picture, "--background") == "#0a141e");
    CHECK(value(scene.picture, "--size") == "640x480");
    CHECK(value(scene.picture, "--color") == "nothing");
    const SceneFile::Camera* camera = find_camera(scene, "");
    REQUIRE(camera);
    CHECK(parse_point("", value(camera->settings, "--eye")) == glm::vec3(session.camera.eye));
    CHECK(parse_point("", value(camera->settings, "--target")) == glm::vec3(session.camera.target));
    CHECK(value(camera->settings, "--fov") == exact_text(session.camera.fov_y_deg));
    // Without creases, toon says nothing; ink says that it has none.
    CHECK(value(scene.picture, "--crease") == "nothing");
    session.appearance.set_style(Style::ink);
    CHECK_FALSE(session.written_scene({640, 480}).picture.contains("crease"));
    session.appearance.crease_angle_deg = 0.0f;
    CHECK(session.written_scene({640, 480}).picture["crease"] == 180.0);
    // Those of ink in a style that has none of its own, and all from an angle on.
    session.appearance.set_style(Style::toon);
    session.appearance.crease_angle_deg = 30.0f;
    CHECK(session.written_scene({640, 480}).picture["crease"] == "clear");
    session.appearance.only_clear_creases = false;
    CHECK(session.written_scene({640, 480}).picture["crease"] == 30.0);
    // Without lines, none of what they have: `render` refuses it.
    session.appearance.hidden = true;
    session.appearance.lines = false;
    for (const char* option : {"crease", "hidden", "line-width"}) {
        CHECK_FALSE(session.written_scene({640, 480}).picture.contains(option));
        CHECK(session.command({640, 480}, "a.png").find(std::string("--") + option) ==
              std::string::npos);
    }
}

TEST_CASE("a mask has no lines, and the next style has its own again") {
    ViewAppearance appearance;
    CHECK(appearance.lines);
    appearance.set_style(Style::mask);
    CHECK_FALSE(appearance.lines);
    appearance.set_style(Style::hatch);
    CHECK(appearance.lines);
}

TEST_CASE("a scene file that is saved again keeps its size and its other cameras") {
    const tests::ScratchFolder folder;
    const std::string path = (folder / "scene.json").string();
    tests::write_bytes(path, R"({"rimline_scene": 1, "models": [{"model": "shape:box"}], "cameras":
        {"front": {"eye": "front", "up": "z"}, "near": {"eye": [3, 2, 1], "fov": 12.5}},
        "picture": {"size": "600x800"}})");
    ParsedView parsed = open_view({path}, [](const std::string&) { return LongCall{}; });
    CHECK(parsed.is_scene_file);
    CHECK(parsed.view.size == ImageSize{600, 800});
    // The size of the window is another thing.
    CHECK(open_view({path, "--size", "90x70"}, [](const std::string&) {
              return LongCall{};
          }).view.size == ImageSize{600, 800});
    ViewSession session;
    session.show(std::move(parsed.view));
    const std::string again = (folder / "again.json").string();
    tests::write_bytes(again, scene_text(session.written_scene({600, 800}), again));
    const SceneFile before = read_scene_file(path), after = read_scene_file(again);
    REQUIRE(after.cameras.size() == 3);
    CHECK(after.cameras[0].name == "window");
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(after.cameras[i + 1].name == before.cameras[i].name);
        CHECK(after.cameras[i + 1].json == before.cameras[i].json);
    }
    // Those of another document are not its own.
    session.show(tests::opened_model("shape:knot"), 1.0);
    CHECK(session.written_scene({600, 800}).cameras.size() == 1);
}

TEST_CASE("what a scene file says beyond the window is kept where render takes it with the rest") {
    const tests::ScratchFolder folder;
    const std::string path = (folder / "scene.json").string();
    const auto open_with = [&](const std::string& picture, std::size_t warnings) {
        tests::write_bytes(
            path, R"({"rimline_scene": 1, "models": [{"model": "shape:box"}], "picture": )" +
                      picture + "}");
        ParsedView parsed = open_view({path}, [](const std::string&) { return LongCall{}; });
        CHECK(parsed.view.warnings.size() == warnings);
        for (const std::string& warning : parsed.view.warnings)
            CHECK(warning.find("view has no --") != std::string::npos);
        ViewSession session;
        session.show(std::move(parsed.view));
        return session;
    };
    const auto written = [](const ViewSession& session) {
        return session.written_scene({600, 800}).picture;
    };
    ViewSession session = open_with(
        R"({"style": "toon", "palette": "sea", "intersections": false, "min-length": 7.5})", 3);
    CHECK(written(session)["palette"] == "sea");
    CHECK(written(session)["intersections"] == false);
    CHECK(written(session)["min-length"] == 7.5);
    session.replace(tests::opened_model("shape:box"));  // Its models moved.
    CHECK(written(session)["min-length"] == 7.5);
    session.freeze();
    CHECK_FALSE(written(session).contains("intersections"));
    CHECK_FALSE(written(session).contains("min-length"));
    session.thaw();
    CHECK(written(session).contains("min-length"));
    session.appearance.set_style(Style::hatch);  // It has other palettes.
    CHECK_FALSE(written(session).contains("palette"));
    CHECK(written(session).contains("intersections"));
    session.show(tests::opened_model("shape:knot"), 1.0);
    CHECK_FALSE(written(session).contains("intersections"));

    session = open_with(R"({"outline": "sobel", "depth-step": 0.01})", 2);
    CHECK(written(session)["outline"] == "sobel");
    session.appearance.hidden = true;
    CHECK_FALSE(written(session).contains("outline"));
    CHECK_FALSE(written(session).contains("depth-step"));
}
