#include "tools/view/model_loader.h"

#include <CLI/Error.hpp>
#include <exception>
#include <new>
#include <utility>

#include "tools/command.h"
#include "tools/view/view_arguments.h"

namespace rimline::tools {

void ModelLoader::open(const std::string& name) {
    // Else it would be an option.
    open(std::vector{(name.starts_with('-') ? "./" : "") + name});
}

void ModelLoader::open(std::vector<std::string> arguments) {
    std::string name = arguments.front();
    start(std::move(name), [arguments = std::move(arguments)](const BeginCall& begin) {
        ParsedView parsed = open_view(arguments, begin);
        return Result{.view = std::move(parsed.view),
                      .kind = parsed.is_scene_file ? Kind::scene : Kind::document,
                      .error = {}};
    });
}

void ModelLoader::arrange(Arrangement arrangement) {
    std::string name = arrangement.added.empty() ? "the scene" : arrangement.added.front();
    start(std::move(name), [arrangement = std::move(arrangement)](const BeginCall& begin) {
        const std::vector<PlacedModel> models = place_added(arrangement, begin);
        std::vector<std::string> arguments = view_arguments(models, arrangement.up);
        arguments.insert(arguments.begin(),
                         {"--materials", arrangement.has_file_colors ? "on" : "off"});
        return Result{.view = open_view(std::move(arguments), begin, models).view,
                      .kind = Kind::arrangement,
                      .error = {}};
    });
}

void ModelLoader::start(std::string name, BackgroundCall<Result>::Work work) {
    std::string task = "opening " + name;
    call_.start(std::move(task),
                [name = std::move(name), work = std::move(work)](const BeginCall& begin) {
                    Result result;
                    try {
                        result = work(begin);
                    } catch (const Error& error) {
                        result.error = error.code() == ErrorCode::cancelled ? "" : error.what();
                    } catch (const UsageError& error) {
                        result.error = error.what();
                    } catch (const CLI::ParseError& error) {
                        result.error = error.what();
                    } catch (const std::bad_alloc&) {
                        result.error = name + ": there is not enough memory for it";
                    } catch (const std::exception& error) {
                        // An exception that left the thread would end the program.
                        result.error = name + ": unexpected: " + error.what();
                    }
                    return result;
                });
}

}  // namespace rimline::tools
