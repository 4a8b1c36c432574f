#pragma once

// What the user has changed of models, lights and look, to be undone and done again. Cameras move too often to be a
// part of it.

#include <optional>
#include <utility>
#include <vector>

#include "tools/view/view_session.h"

namespace rimline::tools {

class EditHistory {
public:
    static constexpr std::size_t k_most = 100;

    /// Begins anew, for another document.
    void begin(ViewEdit now) {
        now_ = std::move(now);
        undone_.clear();
        done_.clear();
    }
    /// After what the user did; once for a drag.
    void note(const ViewEdit& now) {
        if (now == now_) {
            now_ = now;  // A chosen sun has followed the camera.
            return;
        }
        if (done_.size() == k_most) done_.erase(done_.begin());
        done_.push_back(std::exchange(now_, now));
        undone_.clear();
    }
    /// The state before the last change; nothing where there is none.
    std::optional<ViewEdit> undo() { return step(done_, undone_); }
    /// The state that the last undo() left.
    std::optional<ViewEdit> redo() { return step(undone_, done_); }
    /// What has become of the state that one of the two gave. It is no change.
    void adopt(ViewEdit now) { now_ = std::move(now); }

private:
    std::optional<ViewEdit> step(std::vector<ViewEdit>& from, std::vector<ViewEdit>& to) {
        if (from.empty()) return std::nullopt;
        to.push_back(std::exchange(now_, std::move(from.back())));
        from.pop_back();
        return now_;
    }

    ViewEdit now_;
    std::vector<ViewEdit> done_, undone_;
};

}  // namespace rimline::tools
