#include "tools/view/view_loop.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stop_token>
#include <string>
#include <utility>

#include "tools/view/camera_motion.h"
#include "tools/view/framed_for.h"
#include "tools/view/view_marks.h"

namespace rimline::tools {

namespace {

// Of one round along the camera path.
constexpr double k_round_s = 24.0;
// After an event: the toolkit needs up to two more frames to complete its layout.
constexpr int k_frames_after_event = 3;
// Time without a change after which the picture is drawn at full resolution.
constexpr double k_rest_s = 0.3;
// Between two looks at a picture that is drawn beside the one that is shown.
constexpr double k_asking_s = 0.002;
// Longest time to wait for events.
constexpr double k_idle_s = 0.5;

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

ViewLoop::ViewLoop(Window& window, const VulkanInstance& instance, ViewSession& session,
                   ViewLoopOptions options)
    : window_(window),
      session_(session),
      options_(std::move(options)),
      context_(window),
      renderer_(instance, window, options_.device, context_.font_texture()),
      loader_([] { Window::wake(); }),
      gallery_([] { Window::wake(); }),
      recent_(recent_files_path()),
      coarseness_(renderer_.device_facts().type == VK_PHYSICAL_DEVICE_TYPE_CPU) {
    panel_.visible = options_.panel;
    if (options_.picture_size) panel_.set_picture_size(*options_.picture_size);
    show_warnings(options_.warnings);
    history_.begin(session_.edit());
    hough_.open = options_.inspector;
    if (options_.panel && options_.fits) fit();
    if (options_.panel) {
        reduce_model();
        find_views();
        // A run for a screenshot opens nothing to be opened again.
        if (options_.frames == 0) recent_.add(session_.document().name());
    }
}

ViewLoop::~ViewLoop() = default;

FreeArea ViewLoop::free_area() const {
    FreeArea area{.window = window_.size()};
    if (options_.panel && panel_.visible && !panel_.is_folded())
        area.left = double{ViewPanel::k_width} * window_.content_scale();
    if (options_.panel && hough_.open && !session_.is_cloud()) area.right = hough_width();
    return area;
}

// With its margins.
double ViewLoop::hough_width() const {
    const double unit = window_.content_scale();
    const double free =
        window_.size().x - (panel_.visible ? double{ViewPanel::k_width} * unit : 0.0);
    return std::clamp(0.5 * free, 240.0 * unit, 480.0 * unit);
}

void ViewLoop::fit() {
    session_.fit(free_area());
    last_area_ = free_area();
    framed_shadow_ = session_.frames_shadow();
    input_.is_framed = true;
}

bool ViewLoop::has_model(const char* why_not) {
    if (session_.is_cloud()) panel_.show_message(why_not, MessageKind::error);
    return !session_.is_cloud();
}

// The toolkit loses a key that is pressed and released within one frame; the window's list does not.
void ViewLoop::apply_keys() {
    const std::vector<int> keys = window_.take_pressed_keys();
    const std::vector<Window::Shortcut> shortcuts = window_.take_pressed_shortcuts();
    if (ImGui::GetIO().WantTextInput) return;
    for (const Window::Shortcut& shortcut : shortcuts) {
        if (shortcut.key == GLFW_KEY_Z) undo_or_redo(!shortcut.has_shift);
        if (shortcut.key == GLFW_KEY_Y) undo_or_redo(false);
    }
    for (const int key : keys) {
        switch (key) {
            case GLFW_KEY_TAB: panel_.visible = !panel_.visible; break;
            case GLFW_KEY_F:
                played_.reset();
                fit();
                break;
            case GLFW_KEY_G:
                if (has_model(
                        "a cloud has no ground, because it has no faces to cast shadows: open a "
                        "model with faces"))
                    session_.appearance.ground = !session_.appearance.ground;
                break;
            case GLFW_KEY_I:
                if (has_model(
                        "Hough space is of faces, and a cloud has none: open a model with faces"))
                    hough_.open = !hough_.open;
                break;
            case GLFW_KEY_P: requests_.save = panel_.picture_request(); break;
            case GLFW_KEY_SPACE: requests_.play = true; break;
            case GLFW_KEY_C: requests_.copy_command = true; break;
            case GLFW_KEY_X:
                if (has_model("scene files hold models: of a cloud, copy the command (C) or save a "
                              "picture (P)"))
                    requests_.save_scene = panel_.scene_request();
                break;
            case GLFW_KEY_Z:
                if (session_.frozen())
                    session_.thaw();
                else
                    session_.freeze();
                break;
            default: break;
        }
    }
}

// Beside the frames: the first ones that move may have all faces.
void ViewLoop::reduce_model() {
    const ModelDocument* const model = session_.document().model();
    if (!coarseness_.is_slow_device() || !model || model->reduced() ||
        !ReducedModel::is_worth_it(model->mesh()))
        return;
    reducer_.emplace();
    reducer_->start({}, [&mesh = model->mesh()](const BeginCall& begin) {
        try {
            auto reduced = std::make_unique<const ReducedModel>(mesh, begin({}));
            return reduced->is_useful() ? std::move(reduced) : nullptr;
        } catch (const std::exception&) {
            // Cancelled, or without memory: the window works without.
            return std::unique_ptr<const ReducedModel>();
        }
    });
}

void ViewLoop::forget_document() {
    gallery_.clear();
    reducer_.reset();
}

void ViewLoop::find_views() {
    played_.reset();
    gallery_.clear();
    if (const ModelDocument* model = session_.document().model())
        gallery_.find(*model, session_.scene_up());
}

void ViewLoop::play_or_stop() {
    if (played_) {
        played_.reset();
        return;
    }
    played_ = gallery_.path();
    if (!played_) return;
    played_from_s_ = now_s();
    session_.look_from(played_->position(0.0) - session_.bounds().center);
    fit();
    if (session_.has_chosen_sun()) session_.choose_sun(free_area().aspect());
}

// The user's own moves end it.
void ViewLoop::move_along_path() {
    if (is_moving_ || !input_.is_framed) played_.reset();
    if (!played_) return;
    const double rounds = (now_s() - played_from_s_) / k_round_s;
    session_.move_to(played_->position(rounds - std::floor(rounds)) - session_.bounds().center);
    if (!session_.is_whole(free_area())) fit();
    is_moving_ = true;
}

// A picture of the whole document shows it from the same side of the new up.
void ViewLoop::set_up_axis(const glm::dvec3& up) {
    Camera& camera = session_.camera;
    const glm::dvec3 direction = direction_about(camera.eye - camera.target, camera.up, up);
    set_up(camera, up);
    if (input_.is_framed) session_.look_from(direction);
    find_views();
}

void ViewLoop::execute(const PanelRequests& requests) {
    if (requests.cancel) cancel_load();
    if (requests.open) open({*requests.open}, requests.adds);
    if (requests.arranged) arrange(*requests.arranged, requests.has_new_first);
    if (requests.up) set_up_axis(*requests.up);
    if (requests.look_from) session_.look_from(*requests.look_from);
    if (requests.fit || requests.look_from || ((requests.up || requests.lens) && input_.is_framed))
        fit();
    if (requests.fit || requests.look_from || requests.up) played_.reset();
    const bool is_dark =
        (requests.look_from || requests.up) && !session_.is_cloud() && session_.has_chosen_sun();
    if (requests.choose_sun || is_dark) session_.choose_sun(free_area().aspect());
    if (requests.copy_command) copy_command();
    if (requests.play) play_or_stop();
    if (requests.fit || requests.look_from || requests.up || requests.choose_sun || requests.play)
        frames_due_ = k_frames_after_event;
    if (requests.save) save(*requests.save);
    if (requests.save_scene) save_scene(*requests.save_scene);
}

// The toolkit hides a window until it has measured it, and fits it to its content one frame later. Its own size changes
// the content, so that it takes as many frames as after an event.
void ViewLoop::lay_out() {
    is_laid_out_ = true;
    for (int frame = 0; frame < k_frames_after_event; ++frame) {
        context_.begin_frame();
        draw_panel();
        context_.end_frame();
    }
}

void ViewLoop::build_panel() {
    context_.begin_frame();
    requests_ = {};
    if (options_.panel) {
        const bool has_handles = panel_.visible && !session_.is_cloud();
        is_moving_ = input_.apply(session_, free_area(), has_handles, window_.take_press());
        move_along_path();
        apply_keys();
        const bool is_as_fitted =
            free_area() == last_area_ && session_.frames_shadow() == framed_shadow_;
        if (input_.is_framed && !is_as_fitted) fit();
    }
    draw_panel();
    context_.end_frame();
}

// With what lies beside it and over the picture.
void ViewLoop::draw_panel() {
    if (!options_.panel) return;
    const auto gallery = gallery_.views();
    shown_gallery_ = gallery_state();
    const ViewPanel::Status status{.counters = counters_,
                                   .loading = loader_.stage(),
                                   .device = renderer_.device_facts().name,
                                   .recent = recent_.names(),
                                   .gallery = gallery,
                                   .has_path = gallery_.path().has_value(),
                                   .plays_path = played_.has_value(),
                                   .finds_views = gallery_.is_finding(),
                                   .scale = window_.content_scale()};
    if (panel_.visible) {
        draw_marks(session_, free_area(), input_.light());
        draw_axes(session_.camera, free_area());
        panel_.draw(session_, input_, hough_, status, requests_);
    }
    panel_.draw_messages(status, requests_);
    if (hough_.open && !session_.is_cloud()) draw_hough_space();
}

// Beside the picture of the model.
void ViewLoop::draw_hough_space() {
    if (inspected_ != &session_.model()) {
        inspected_ = &session_.model();
        inspection_.emplace(session_.model());
    }
    inspection_->update(session_.model(), session_.silhouette_point());
    const float margin = 10.0f * window_.content_scale();
    const auto width = static_cast<float>(hough_width()) - 2.0f * margin;
    hough_.draw(*inspection_, float(window_.size().x) - width - margin, margin, width,
                1.05f * width);
}

// Waits so long for events at most.
bool ViewLoop::is_quiet_for(double wait_s) {
    window_.poll(wait_s);
    return !window_.has_activity() && !window_.should_close();
}

bool ViewLoop::is_frame_fine() const {
    const bool rests = !is_moving_ && now_s() - last_change_s_ >= k_rest_s;
    return rests || !options_.panel || options_.frames > 0;
}

FrameQuality ViewLoop::quality(bool is_fine) const {
    return is_fine ? FrameQuality{} : coarseness_.quality();
}

// The size of the picture, for lines with exact visibility; while something moves, lines are streamed.
std::optional<ImageSize> ViewLoop::exact_size(bool is_fine) const {
    const VkExtent2D size = window_.size_px();
    if (!is_fine || size.width == 0 || size.height == 0) return {};
    return ImageSize{size.width, size.height};
}

void ViewLoop::note_frame(WindowRenderer::Frame& frame) {
    if (captures_next_) captured_ = std::move(frame.picture);
    captures_next_ = false;
    // When the frames in flight that may refer to it are done.
    if (++frames_of_document_ > RendererOptions{}.frames_in_flight + 1) session_.forget_previous();
}

bool ViewLoop::draw_kept() {
    std::optional<WindowRenderer::Frame> frame =
        renderer_.draw_kept(context_.drawing(), captures_next_);
    if (frame) note_frame(*frame);
    return frame.has_value();
}

ViewPicture ViewLoop::picture(bool is_fine, const LongCall& call) const {
    const ShownBeside panels(session_, free_area());
    ViewPicture picture = session_.picture(exact_size(is_fine), call);
    if (Scene* const scene = std::get_if<Scene>(&picture)) {
        if (const ReducedModel* const reduced = session_.model().reduced()) {
            scene->kept = {is_fine ? &reduced->octree() : &session_.model().octree()};
            if (!is_fine) reduced->stand_in(scene->instances.front());
        }
        if (!quality(is_fine).shadows) scene->shadows = false;
        scene->line_width_px /= static_cast<float>(quality(is_fine).divisor);
    }
    return picture;
}

// A fine picture takes the place of the one before when it is done, unless an event comes first: then there is none.
std::optional<WindowRenderer::Frame> ViewLoop::draw_new(bool is_fine) {
    const bool is_beside = is_fine && options_.frames == 0 && renderer_.has_kept_picture();
    std::stop_source stop;
    LongCall call;
    if (is_beside)
        call = {stop.get_token(), [&](double) {
                    if (!is_quiet_for(0.0)) stop.request_stop();
                }};
    const FrameQuality frame_quality = quality(is_fine);
    ViewPicture picture;
    try {
        picture = this->picture(is_fine, call);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) throw;
        return std::nullopt;
    }
    if (is_beside) {
        FrameReport report;
        const auto became = renderer_.draw_beside(picture, frame_quality, report,
                                                  [&] { return is_quiet_for(k_asking_s); });
        if (became == WindowRenderer::Beside::given_up) return std::nullopt;
        if (became == WindowRenderer::Beside::done) {
            auto frame = renderer_.draw_kept(context_.drawing(), captures_next_);
            if (frame) frame->report = std::move(report);
            return frame;
        }
    }
    return renderer_.draw(picture, context_.drawing(), frame_quality, captures_next_);
}

// On a device that is slow, after a picture at rest. The stand-in of a large model comes first.
bool ViewLoop::rehearses() const {
    return !is_rehearsed_ && !(reducer_ && reducer_->stage()) && renderer_.has_kept_picture();
}

// The first frame that moves is answered in time only if nothing has to be compiled for it.
void ViewLoop::rehearse() {
    is_rehearsed_ = true;
    renderer_.rehearse(picture(false, {}), quality(false),
                       [&] { return is_quiet_for(k_asking_s); });
}

bool ViewLoop::draw() {
    const bool is_fine = is_frame_fine();
    const VkExtent2D size = window_.size_px();
    DrawnSight sight{session_.sight(), {size.width, size.height}};
    sight.sight.camera = session_.shown_camera(free_area());
    // A run for a screenshot draws what it is asked for.
    if (options_.frames == 0 && sight == drawn_sight_ && (!is_fine || !is_coarse_) &&
        renderer_.has_kept_picture())
        return draw_kept();
    const double start_s = now_s();
    std::optional<WindowRenderer::Frame> frame;
    try {
        frame = draw_new(is_fine);
    } catch (const Error& error) {
        forget_document();
        cancel_load();
        if (error.code() != ErrorCode::too_large || !session_.show_previous(free_area().aspect()))
            throw;
        history_.begin(session_.edit());
        panel_.show_message(error.what(), MessageKind::error);
        fit();
        reduce_model();
        find_views();
        frames_due_ = k_frames_after_event;
        return false;
    }
    const double frame_ms = 1e3 * (now_s() - start_s);
    if (is_fine) {
        coarse_frames_ = 0;
        coarseness_.add_fine(frame_ms);
        is_rehearsed_ = !coarseness_.is_slow_device() || options_.frames > 0;
    }
    if (!frame) return false;
    note_frame(*frame);
    drawn_sight_ = std::move(sight);
    is_coarse_ = !is_fine;
    if (frame->report.segments > 0) {
        const ShownLines& lines = session_.model().lines();
        frame->report.silhouette = lines.silhouette_count();
        frame->report.creases = lines.crease_count();
    }
    counters_.add(frame->report, frame_ms);
    // The frame waits for that before the one before, so the first coarse frames wait for a fine one.
    if (!is_fine && ++coarse_frames_ > RendererOptions{}.frames_in_flight)
        coarseness_.add(frame_ms);
    if (session_.is_cloud()) counters_.cloud = session_.cloud().report();
    return true;
}

double ViewLoop::waiting_time() const {
    // A hidden window is not drawn; an event tells when it is shown.
    if (!window_.is_shown()) return k_idle_s;
    if (frames_due_ > 0 || is_moving_) return 0.0;
    if (is_coarse_) return std::max(k_rest_s - (now_s() - last_change_s_), 1e-3);
    if (rehearses()) return k_asking_s;
    return k_idle_s;
}

// What the panel shows of it.
std::array<std::size_t, 3> ViewLoop::gallery_state() const {
    return {gallery_.views().size(), gallery_.is_finding() ? 1u : 0u,
            gallery_.path().has_value() ? 1u : 0u};
}

bool ViewLoop::step(bool always) {
    window_.poll(always ? 0.0 : waiting_time());
    if (window_.take_activity()) {
        frames_due_ = k_frames_after_event;
        last_change_s_ = now_s();
    }
    const bool has_new = show_loaded();
    if (reducer_)
        if (auto reduced = reducer_->take()) {
            session_.document().model()->set_reduced(*std::move(reduced));
            is_rehearsed_ = false;
        }
    const bool has_views = options_.panel && gallery_state() != shown_gallery_;
    if (has_new || has_views || loader_.stage()) frames_due_ = k_frames_after_event;
    const bool refines = is_coarse_ && now_s() - last_change_s_ >= k_rest_s;
    if (!always && frames_due_ == 0 && !is_moving_ && !refines) {
        if (!is_coarse_ && rehearses()) rehearse();
        return false;
    }
    frames_due_ = std::max(frames_due_ - 1, 0);
    if (!is_laid_out_) lay_out();
    build_panel();
    const bool drawn = draw();
    // After the frame, because requests may take long.
    execute(requests_);
    follow_file_colors();
    // Once for a drag.
    if (options_.panel && !is_moving_ && !ImGui::IsAnyItemActive() && loads_ != Loads::undone)
        history_.note(session_.edit());
    return drawn;
}

void ViewLoop::run(const Context& context) {
    std::uint32_t drawn = 0;
    while (!window_.should_close()) {
        context.checkpoint();
        if (options_.frames > 0 && drawn + 1 == options_.frames) captures_next_ = true;
        if (step(options_.frames > 0)) ++drawn;
        if (options_.frames > 0 && drawn == options_.frames) break;
    }
}

}  // namespace rimline::tools
