#pragma once

// What is wrong with a command line, in plain words, with the name that was probably meant.

#include <string>
#include <vector>

#include "tools/cli_classes.h"

namespace rimline::tools {

/// The program and the subcommands that the command line names, outermost first.
std::vector<const CLI::App*> parsed_chain(const CLI::App& app);

/// The message for the exception that `app` threw while it parsed: CLI11's, or our own words where CLI11's are no
/// plain sentence.
std::string usage_words(const CLI::ParseError& error, const CLI::App& app);

/// The same for the first wrong value in the order in which the user typed them. Call it once, after parsing
/// failed: the callbacks of options run again.
std::string first_usage_words(const CLI::ParseError& error, const CLI::App& app);

}  // namespace rimline::tools
