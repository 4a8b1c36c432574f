#pragma once

// CLI11's classes, for headers that only name them. <CLI/App.hpp> itself defines objects and a hundred kilobytes of
// functions in every source that sees it, seven seconds of a compiler each. A source that makes an App includes
// <CLI/Config.hpp> and <CLI/Formatter.hpp> too.

namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI
