#pragma once

// The main loop of the window: events, input, panel, loader and renderer, until the window is closed.
//
// A frame is drawn only when its content has changed, and the picture in it only when more than the panel has. A CPU
// device draws fewer pixels and faces while something moves, and all of them when nothing has moved for a moment.

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/vulkan/vulkan_instance.h"
#include "tools/command.h"
#include "tools/view/background_call.h"
#include "tools/view/edit_history.h"
#include "tools/view/hough_inspection.h"
#include "tools/view/hough_panel.h"
#include "tools/view/model_loader.h"
#include "tools/view/panel_context.h"
#include "tools/view/view_counters.h"
#include "tools/view/view_input.h"
#include "tools/view/view_panel.h"
#include "tools/view/view_session.h"
#include "tools/view/window.h"
#include "tools/view/window_renderer.h"

namespace rimline::tools {

struct ViewLoopOptions {
    std::string device;      ///< The value of --device.
    bool panel = true;       ///< Shows panel and handles; else only the picture.
    bool inspector = false;  ///< Starts with the Hough space window open.
    /// Closes after this number of frames. 0: the user closes the window.
    std::uint32_t frames = 0;
    /// Starts with the model fitted into the part of the window that the panel leaves free.
    bool fits = true;
    /// Of pictures that are saved. Not set: the panel's own.
    std::optional<ImageSize> picture_size = {};
    /// Shown at first.
    std::vector<std::string> warnings = {};
};

class ViewLoop {
public:
    /// `instance` must have the window's extensions. `session` must hold a document. The three must outlive
    /// the loop.
    ViewLoop(Window& window, const VulkanInstance& instance, ViewSession& session,
             ViewLoopOptions options);
    ~ViewLoop();
    ViewLoop(const ViewLoop&) = delete;
    ViewLoop& operator=(const ViewLoop&) = delete;

    /// Runs until the window is closed or `context` is cancelled. Throws Error if no frame can be drawn.
    void run(const Context& context);

    /// One iteration: processes events and the panel, and draws a frame if one is due or if `always`.
    /// Returns whether a frame was drawn.
    bool step(bool always);

    /// Opens models as the panel does: on another thread. Errors are shown in the panel. `adds`: to the scene that
    /// is shown; else the first one takes its place.
    void open(const std::vector<std::string>& names, bool adds = false);
    /// Shows these models instead, as the panel does where they are moved or removed: on another thread.
    /// `has_new_first`: the first one was not the first before (Arrangement).
    void arrange(std::vector<PlacedModel> models, bool has_new_first = false);
    bool is_loading() const { return loader_.stage().has_value(); }
    const std::string& message() const noexcept { return panel_.message; }
    MessageKind message_kind() const noexcept { return panel_.message_kind; }
    /// Of pictures that are saved.
    ImageSize picture_size() const { return panel_.picture_request().size; }
    const ViewGallery& gallery() const noexcept { return gallery_; }
    /// Of these, those that the last frame has shown.
    std::size_t shown_views() const noexcept { return shown_gallery_[0]; }

    WindowRenderer& renderer() noexcept { return renderer_; }
    /// Captures the next frame as the window shows it. run() captures the last of its frames.
    void capture_next() noexcept { captures_next_ = true; }
    const Picture& captured() const noexcept { return captured_; }
    /// How many frames had a new picture, not the one before under another panel.
    std::size_t picture_count() const noexcept { return counters_.frames; }
    /// Of the last of these frames.
    const FrameReport& report() const noexcept { return counters_.report; }
    /// Whether the picture that is shown was drawn faster: on a CPU device at the lower resolution and of few faces, and
    /// without exact lines.
    bool is_coarse() const noexcept { return is_coarse_; }
    /// Whether the picture is fine and nothing is left to be done until the next event.
    bool is_at_rest() const { return !is_coarse_ && !rehearses(); }

    /// The window's area that the panel and the Hough space beside it leave free.
    FreeArea free_area() const;

private:
    bool show_loaded();  // Returns whether a new document is shown.
    void show_warnings(const std::vector<std::string>& warnings);
    void apply_keys();
    void draw_hough_space();
    double hough_width() const;
    void execute(const PanelRequests& requests);
    // Whether there is no such file, or it was written here, or the user has asked for it twice.
    bool may_write(const std::string& path);
    void save(const PanelRequests::Save& save);
    void round_lights();
    void save_scene(const PanelRequests::Save& save);
    void fit();
    void find_views();
    void reduce_model();
    void forget_document();  // Before another one takes its place.
    void play_or_stop();
    void move_along_path();
    void copy_command();
    void set_up_axis(const glm::dvec3& up);
    void follow_file_colors();
    enum class Loads {
        other,
        arrangement,  // What the user has changed of the models.
        undone,       // The same, undone or done again.
    };
    void cancel_load();
    void undo_or_redo(bool undoes);
    void restore(const ViewEdit& edit);
    bool has_model(const char* why_not);  // Else says why a key does nothing.
    std::array<std::size_t, 3> gallery_state() const;
    void lay_out();
    void draw_panel();
    void build_panel();
    bool draw();
    ViewPicture picture(bool is_fine, const LongCall& call) const;
    std::optional<WindowRenderer::Frame> draw_new(bool is_fine);
    bool draw_kept();
    bool rehearses() const;
    void rehearse();
    void note_frame(WindowRenderer::Frame& frame);
    double waiting_time() const;
    bool is_quiet_for(double wait_s);
    bool is_frame_fine() const;
    FrameQuality quality(bool is_fine) const;
    std::optional<ImageSize> exact_size(bool is_fine) const;

    Window& window_;
    ViewSession& session_;
    ViewLoopOptions options_;
    PanelContext context_;
    WindowRenderer renderer_;
    ModelLoader loader_;
    Loads loads_ = Loads::other;  // What the loader is at, until its result is taken.
    ViewGallery gallery_;         // Refers to the session's document, as the next one does.
    std::optional<BackgroundCall<std::unique_ptr<const ReducedModel>>> reducer_;
    RecentFiles recent_;
    std::array<std::size_t, 3> shown_gallery_{};
    std::string notice_;                     // For the next document, when it is there.
    std::optional<bool> asked_file_colors_;  // Of the document.
    std::vector<std::string> added_;    // What the loader adds to the scene, until it is there.
    std::optional<CameraPath> played_;  // While the camera moves along it.
    double played_from_s_ = 0.0;
    ViewPanel panel_;
    ViewInput input_;
    EditHistory history_;
    HoughPanel hough_;
    std::optional<HoughInspection> inspection_;
    const ModelDocument* inspected_ = nullptr;
    ViewCounters counters_;
    Coarseness coarseness_;
    FreeArea last_area_;          // Of fit().
    bool framed_shadow_ = false;  // By fit().
    struct DrawnSight {
        ViewSight sight;
        glm::uvec2 size_px;
        bool operator==(const DrawnSight&) const = default;
    };
    std::optional<DrawnSight> drawn_sight_;  // Of the picture that the window shows.
    PanelRequests requests_;
    std::set<std::string> may_replace_;  // Files, by the names that the user gave.
    Picture captured_;
    bool captures_next_ = false;
    bool is_moving_ = false;
    bool is_coarse_ = false;
    std::uint32_t coarse_frames_ = 0;  // Since the last fine one.
    bool is_rehearsed_ = true;         // What comes after this picture, if it moves.
    int frames_due_ = 0;
    bool is_laid_out_ = false;              // The panel, before the first frame.
    std::uint32_t frames_of_document_ = 0;  // Drawn since it was opened.
    double last_change_s_ = 0.0;
};

}  // namespace rimline::tools
