#include "tools/view/edit_history.h"

#include <doctest/doctest.h>

using namespace rimline;
using namespace rimline::tools;

namespace {

ViewEdit of_width(float width) {
    ViewEdit edit;
    edit.appearance.line_width_px = width;
    return edit;
}

}  // namespace

TEST_CASE("changes are undone in their order and done again until there is another one") {
    EditHistory history;
    history.begin(of_width(1));
    CHECK_FALSE(history.undo());
    for (const float width : {2.0f, 2.0f, 3.0f, 4.0f}) history.note(of_width(width));
    CHECK(history.undo() == of_width(3));
    CHECK(history.undo() == of_width(2));
    CHECK(history.redo() == of_width(3));
    history.note(of_width(3));  // As it was left.
    CHECK(history.redo() == of_width(4));
    CHECK_FALSE(history.redo());
    CHECK(history.undo() == of_width(3));
    history.note(of_width(9));
    CHECK_FALSE(history.redo());
    CHECK(history.undo() == of_width(3));
    CHECK(history.undo() == of_width(2));
    CHECK(history.undo() == of_width(1));
    CHECK_FALSE(history.undo());
    CHECK(history.redo() == of_width(2));
    history.adopt(of_width(2.5f));  // What has become of it.
    history.note(of_width(2.5f));
    CHECK(history.redo() == of_width(3));
    CHECK(history.undo() == of_width(2.5f));
    CHECK(history.undo() == of_width(1));
    history.begin(of_width(5));
    CHECK_FALSE(history.redo());
    for (int i = 0; i < 300; ++i) history.note(of_width(float(i + 10)));
    int undone = 0;
    while (history.undo()) ++undone;
    CHECK(undone == int(EditHistory::k_most));
}

TEST_CASE("the direction of a chosen sun is the one that it had before the change") {
    const auto of_sun = [](bool is_chosen, const glm::dvec3& direction) {
        ViewEdit edit;
        edit.has_chosen_sun = is_chosen;
        edit.lights = {{.vector = direction, .directional = true}};
        return edit;
    };
    EditHistory history;
    history.begin(of_sun(true, {1, 0, 0}));
    history.note(of_sun(true, {0, 1, 0}));  // It has followed the camera.
    history.note(of_sun(false, {0, 0, 1}));
    const auto before = history.undo();
    REQUIRE(before);
    CHECK(before->has_chosen_sun);
    CHECK(before->lights[0].vector == glm::dvec3(0, 1, 0));
    const auto after = history.redo();
    REQUIRE(after);
    CHECK(after->lights[0].vector == glm::dvec3(0, 0, 1));
    history.note(of_sun(false, {0, 0, 2}));
    CHECK(history.undo() == after);
}
