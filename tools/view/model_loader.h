#pragma once

// Opens models and clouds on a separate thread, so that the window stays responsive while a large file is
// read.
//
// Only one file is loaded at a time: open() cancels the load before it. The window's thread fetches the
// result with take(). A failed load gives an error message and does not end the program.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/view/added_model.h"
#include "tools/view/background_call.h"
#include "tools/view/view_session.h"

namespace rimline::tools {

class ModelLoader {
public:
    /// `wake` is called on the loading thread whenever stage() or the result has changed.
    explicit ModelLoader(std::function<void()> wake = {}) : call_(std::move(wake)) {}

    /// Cancels the load before, and starts to open what the arguments of `rimline view` say.
    void open(std::vector<std::string> arguments);
    /// The same for one file or built-in shape.
    void open(const std::string& name);
    /// The same for a scene of models that have been moved or added.
    void arrange(Arrangement arrangement);
    /// How the result takes the place of what is shown.
    enum class Kind {
        document,    ///< Only the document is new: the look of the picture stays.
        scene,       ///< A scene file, which says all.
        arrangement  ///< The same models moved, or more of them: all else stays.
    };
    struct Result {
        OpenedView view;  ///< Its document is empty if the load failed.
        Kind kind = Kind::document;
        std::string error;  ///< Why it failed.
    };
    using Stage = BackgroundCall<Result>::Stage;

    /// Asks the load to stop and does not wait for it. Its result is discarded, as is one that was not taken.
    void cancel() { call_.cancel(); }
    /// Nothing while no load is in progress.
    std::optional<Stage> stage() const { return call_.stage(); }
    /// The result of the last open(). Each result is returned once.
    std::optional<Result> take() { return call_.take(); }

private:
    // `name` begins messages that do not name what they are about.
    void start(std::string name, BackgroundCall<Result>::Work work);

    BackgroundCall<Result> call_;
};

}  // namespace rimline::tools
