#pragma once

// What the window is to show, as the arguments of `rimline view`: models at their places, a scene file or a
// cloud, and the camera, lights and look. The panel opens files and changes scenes by such arguments too.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/begin_call.h"
#include "tools/cli_classes.h"
#include "tools/options/cloud_argument.h"
#include "tools/options/model_list.h"
#include "tools/options/picture_options.h"
#include "tools/options/scene_options.h"
#include "tools/view/view_session.h"

namespace rimline::tools {

class ViewArguments {
public:
    void add_to(CLI::App& app);
    /// After parsing. Throws UsageError, and what ModelList::settle() throws.
    void settle();

    const ModelList& models() const noexcept { return models_; }
    const PictureOptions& picture() const noexcept { return picture_; }
    /// Whether nothing says where the camera is.
    bool fits() const noexcept { return !picture_.eye && !picture_.target; }
    bool is_scene_file() const { return tools::is_scene_file(models_.name()); }

    /// After settle(): ModelList::subdivide_as().
    void subdivide_as(std::span<const PlacedModel> models) { models_.subdivide_as(models); }
    /// After settle(). `inspects`: Hough space is to be shown, which clouds do not have. Throws UsageError for options
    /// that clouds do not have, and what open_document() and the constructor of ModelDocument throw.
    OpenedView open(const BeginCall& begin, bool inspects = false);

private:
    Document open_document_of_models(const BeginCall& begin);
    OpenedView cloud_view(Document document, bool inspects) const;
    OpenedView model_view(Document document);

    ModelList models_;
    CloudArgument cloud_;  // Only its flags are used.
    PictureOptions picture_;
    SceneOptions scene_;
};

struct ParsedView {
    OpenedView view;
    bool is_scene_file = false;
};
/// Opens what the arguments of a command line say, the subcommand left out. `subdivided`, unless it is empty: the
/// models of the arguments, which say how each is subdivided. Throws UsageError for arguments that are not understood,
/// and what ViewArguments throws.
ParsedView open_view(std::vector<std::string> arguments, const BeginCall& begin,
                     std::span<const PlacedModel> subdivided = {});

}  // namespace rimline::tools
