#pragma once

// A model of a batch, and what is done with it.

#include <string>
#include <vector>

#include "tools/batch/batch_inputs.h"

namespace rimline::tools {

struct BatchTask {
    BatchInput input;
    std::string key;  ///< The model as the manifest names it: bytes that are no UTF-8 are escaped.
    std::vector<std::string> arguments;  ///< Of a `rimline` that does it.
    std::string command;                 ///< The arguments, as the manifest names them.
    /// The files and folders that the subcommand is asked to write, one for each of batch_output_words().
    std::vector<std::string> outputs;

    /// The files that are there, ascending: the outputs, and those in an output that is a folder.
    std::vector<std::string> found_outputs() const;
    /// The same as the manifest names them: printable, ascending.
    std::vector<std::string> named_outputs() const;
};

/// A word in braces in `text` that stands for nothing, with its braces. Empty if there is none.
std::string unknown_batch_place(const std::string& text);

/// The names of what a subcommand writes, as its options have them: values of -o, --save-scene and --export.
std::vector<std::string> batch_output_words(const std::vector<std::string>& subcommand);

/// What to do about two models for which `word`, one of batch_output_words(), names the same output.
std::string advice_for_two(const BatchInput& one, const BatchInput& other, const std::string& word);

/// `subcommand` is its name and its options, in which {stem}, {name}, {path} and {ext} stand for the model and {out}
/// for `folder`.
BatchTask make_batch_task(const BatchInput& input, const std::vector<std::string>& subcommand,
                          const std::string& folder);

}  // namespace rimline::tools
