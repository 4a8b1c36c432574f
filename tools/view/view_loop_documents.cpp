// What the loop of the window opens, arranges, undoes, saves and copies.

#include <GLFW/glfw3.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "tools/output/output_file.h"
#include "tools/view/framed_for.h"
#include "tools/view/view_loop.h"

namespace rimline::tools {

namespace {

void check_picture_name(const std::string& path) {
    if (!path.ends_with(".png")) throw UsageError(path + ": the name of a picture ends in .png");
}

}  // namespace

void ViewLoop::open(const std::vector<std::string>& names, bool adds) {
    const auto is_scene = [](const std::string& name) { return is_scene_file(name); };
    const ModelDocument* const model = session_.document().model();
    added_.clear();
    notice_.clear();
    if (!adds || !model) {
        if (names.size() > 1)
            notice_ = "opened the first of " + std::to_string(names.size()) +
                      " files; tick \"add it to the scene\" to show them side by side";
        loader_.open(names.front());
        loads_ = Loads::other;
    } else if (std::ranges::any_of(names, is_scene)) {
        panel_.show_message("a scene file cannot be added to a scene", MessageKind::error);
    } else {
        added_ = names;
        loader_.arrange({.models = model->models(),
                         .added = names,
                         .up = session_.scene_up(),
                         .towards_viewer = session_.camera.eye - session_.camera.target,
                         .positions = model->mesh().positions(),
                         .has_file_colors = session_.appearance.shows_file_colors()});
        loads_ = Loads::arrangement;
    }
}

void ViewLoop::arrange(std::vector<PlacedModel> models, bool has_new_first) {
    loader_.arrange({.models = std::move(models),
                     .up = session_.scene_up(),
                     .has_file_colors = session_.appearance.shows_file_colors(),
                     .has_new_first = has_new_first});
    loads_ = Loads::arrangement;
}

void ViewLoop::cancel_load() {
    loader_.cancel();
    loads_ = Loads::other;
    added_.clear();
    notice_.clear();
    panel_.forget_places();  // Else they would be asked for again.
}

bool ViewLoop::show_loaded() {
    std::vector<std::string> dropped = window_.take_dropped();
    if (!dropped.empty()) open(dropped, panel_.adds());
    std::optional<ModelLoader::Result> result = loader_.take();
    if (!result) return false;
    const Loads loaded = std::exchange(loads_, Loads::other);
    OpenedView& view = result->view;
    if (!view.document) {
        notice_.clear();
        panel_.show_message(result->error, MessageKind::error);
        panel_.forget_places();
        added_.clear();
        return false;
    }
    panel_.message.clear();
    forget_document();
    // The next document may have the same address.
    inspected_ = nullptr;
    drawn_sight_.reset();
    std::vector<std::string> warnings = std::move(view.warnings);
    for (const std::string& warning : view.document.warnings()) warnings.push_back(warning);
    const bool was_framed = input_.is_framed;
    const bool is_given = view.frame_aspect.has_value();
    switch (result->kind) {
        case ModelLoader::Kind::document:
            session_.show(std::move(view.document), free_area().aspect());
            break;
        case ModelLoader::Kind::scene: session_.show(std::move(view)); break;
        case ModelLoader::Kind::arrangement:
            session_.replace(std::move(view.document));
            if (session_.has_chosen_sun()) session_.choose_sun(free_area().aspect());
            break;
    }
    frames_of_document_ = 0;
    if (result->kind != ModelLoader::Kind::arrangement)
        history_.begin(session_.edit());
    else if (loaded == Loads::undone)
        history_.adopt(session_.edit());
    asked_file_colors_.reset();
    if (view.size) panel_.set_picture_size(*view.size);
    if (is_given)
        input_.is_framed = false;
    else if (result->kind != ModelLoader::Kind::arrangement || was_framed)
        fit();
    reduce_model();
    find_views();
    recent_.add(session_.document().name());
    for (const std::string& name : std::exchange(added_, {})) recent_.add(name);
    window_.set_title("Rimline - " + session_.document().name());
    const std::string notice = std::exchange(notice_, {});
    if (!notice.empty()) panel_.show_message(notice, MessageKind::result);
    show_warnings(warnings);
    return true;
}

void ViewLoop::show_warnings(const std::vector<std::string>& warnings) {
    if (warnings.empty()) return;
    std::string text = warnings.front();
    if (warnings.size() == 2) text += " (and another warning)";
    if (warnings.size() > 2)
        text += " (and " + std::to_string(warnings.size() - 1) + " more warnings)";
    panel_.show_message(std::move(text), MessageKind::warning);
}

void ViewLoop::undo_or_redo(bool undoes) {
    // The last change is the one that is being loaded.
    if (undoes && loads_ == Loads::arrangement) {
        cancel_load();
        panel_.show_message("the change of the models is cancelled", MessageKind::result);
        return;
    }
    if (loads_ != Loads::undone) history_.note(session_.edit());
    const std::optional<ViewEdit> edit = undoes ? history_.undo() : history_.redo();
    if (edit)
        restore(*edit);
    else
        panel_.show_message(undoes ? "nothing to undo" : "nothing to do again",
                            MessageKind::result);
}

// Models take a while. Until they are there, the session's state is none of the user's.
void ViewLoop::restore(const ViewEdit& edit) {
    const ViewAppearance before = session_.appearance;
    session_.restore(edit);
    const bool has_lens = before.fov_y_deg == session_.appearance.fov_y_deg &&
                          before.orthographic == session_.appearance.orthographic;
    if (!has_lens && input_.is_framed) fit();
    const ModelDocument* const model = session_.document().model();
    if (!model || edit.models == model->models()) {
        if (loads_ == Loads::undone) cancel_load();
        return;
    }
    loader_.arrange({.models = edit.models,
                     .up = edit.scene_up.value_or(session_.scene_up()),
                     .has_file_colors = session_.appearance.shows_file_colors()});
    loads_ = Loads::undone;
}

// Where models are painted, the colors of all faces are made when the scene is loaded.
void ViewLoop::follow_file_colors() {
    const ModelDocument* const model = session_.document().model();
    const bool wanted = session_.appearance.shows_file_colors();
    if (!model || !model->has_paint() || model->has_file_colors() == wanted || loader_.stage() ||
        loads_ != Loads::other || asked_file_colors_ == wanted)
        return;
    asked_file_colors_ = wanted;
    loader_.arrange({.models = model->models(),
                     .added = {},
                     .up = session_.scene_up(),
                     .positions = {},
                     .has_file_colors = wanted});
}

bool ViewLoop::may_write(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) || !may_replace_.insert(path).second) return true;
    panel_.show_message(path + " exists: save again to replace it", MessageKind::error);
    return false;
}

void ViewLoop::save(const PanelRequests::Save& save) {
    try {
        check_picture_name(save.path);
        OutputFile file(save.path, session_.document().name());
        if (const ModelDocument* model = session_.document().model())
            for (const PlacedModel& placed : model->models())
                if (is_same_file(save.path, placed.model))
                    throw UsageError(save.path +
                                     ": this is the model itself; name another file to write");
        if (!may_write(save.path)) return;
        round_lights();
        const FramedFor framed(session_, input_.is_framed, save.size);
        session_.round_to_options();
        Picture picture =
            renderer_.picture(session_.picture(save.size), save.size.width, save.size.height);
        session_.finish().apply(picture);
        const std::vector<std::byte> png = encode_png(picture);
        file.write({reinterpret_cast<const char*>(png.data()), png.size()});
        file.commit();
        may_replace_.insert(save.path);
        panel_.show_message("saved " + save.path, MessageKind::result);
    } catch (
        const std::runtime_error& error) {  // Error, or UsageError if the path is the model itself.
        panel_.show_message(error.what(), MessageKind::error);
    } catch (const std::bad_alloc&) {
        panel_.show_message(save.path + ": there is not enough memory for a picture of this size",
                            MessageKind::error);
    }
}

// Before a picture is framed for what is saved: their shadows may widen it. It is no change that could be undone.
void ViewLoop::round_lights() {
    const bool is_noted = loads_ != Loads::undone;
    if (is_noted) history_.note(session_.edit());
    session_.round_lights();
    if (is_noted) history_.adopt(session_.edit());
}

void ViewLoop::save_scene(const PanelRequests::Save& save) {
    try {
        if (!is_scene_file(save.path))
            throw UsageError(save.path + ": the name of a scene file ends in .json");
        OutputFile file(save.path);
        if (!may_write(save.path)) return;
        round_lights();
        const FramedFor framed(session_, input_.is_framed, save.size);
        file.write(scene_text(session_.written_scene(save.size), save.path));
        file.commit();
        may_replace_.insert(save.path);
        panel_.show_message("saved " + save.path, MessageKind::result);
    } catch (const std::runtime_error& error) {
        panel_.show_message(error.what(), MessageKind::error);
    }
}

void ViewLoop::copy_command() {
    const PanelRequests::Save picture = panel_.picture_request();
    try {
        check_picture_name(picture.path);
    } catch (const UsageError& error) {
        panel_.show_message(error.what(), MessageKind::error);
        return;
    }
    if (const std::string obstacle = session_.command_obstacle(); !obstacle.empty()) {
        panel_.show_message(obstacle, MessageKind::error);
        return;
    }
    round_lights();
    const FramedFor framed(session_, input_.is_framed, picture.size);
    glfwSetClipboardString(window_.handle(), session_.command(picture.size, picture.path).c_str());
    panel_.show_message("the command is in the clipboard", MessageKind::result);
}

}  // namespace rimline::tools
