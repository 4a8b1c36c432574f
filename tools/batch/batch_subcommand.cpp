#include "tools/batch/batch_subcommand.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/batch/batch_task.h"
#include "tools/command.h"

namespace rimline::tools {

namespace {

struct BatchSubcommand {
    std::string_view name;
    std::string_view output;    ///< An example of its -o, a file or a folder. Empty: it has none.
    bool needs_output = false;  ///< Without -o it fails, or writes a file with a name of its own.
};

constexpr std::array<BatchSubcommand, 13> k_batch_subcommands{
    {{"render", "{out}/{path}.png", true},
     {"animate", "{out}/{path}", true},
     {"info", ""},
     {"silhouette", "{out}/{path}.obj"},
     {"draw", "{out}/{path}.svg", true},
     {"track", ""},
     {"views", "{out}/{path}"},
     {"path", "{out}/{path}"},
     {"light", ""},
     {"origins", "{out}/{path}.png"},
     {"field", "{out}/{path}.png"},
     {"points", "{out}/{path}.png"},
     {"convert", "{out}/{path}.glb", true}}};

void check_word(const std::string& word, const std::string& subcommand) {
    if (word == "--")
        throw UsageError(
            "a second -- : the models stand before the first one, and the subcommand's options "
            "after it");
    if (word == "--help" || word == "-h")
        throw UsageError("after -- come options that do something with a model, not " + word,
                         subcommand);
    if (const std::string place = unknown_batch_place(word); !place.empty())
        throw UsageError(place + " in '" + word +
                         "': expected {stem}, {name}, {path}, {ext} or {out}");
}

}  // namespace

void check_batch_subcommand(const std::vector<std::string>& words) {
    if (words.empty())
        throw UsageError("no subcommand: after the models comes -- and a subcommand, as -- info");
    const std::string& name = words.front();
    const auto found = std::ranges::find(k_batch_subcommands, name, &BatchSubcommand::name);
    if (found == k_batch_subcommands.end())
        throw UsageError("after -- comes a subcommand that takes a model, not '" + name + "'");
    for (const std::string& word : words) check_word(word, name);
    const std::vector<std::string> outputs = batch_output_words(words);
    const std::string example = "-o " + std::string(found->output);
    if (outputs.empty() && found->needs_output)
        throw UsageError("after -- " + name + " needs -o, as " + example +
                         ": else all models would write one file");
    if (std::ranges::find(outputs, k_standard_output) != outputs.end())
        throw UsageError("standard output is no output of a batch: name one for each model" +
                         (found->output.empty() ? "" : ", as " + example));
}

}  // namespace rimline::tools
