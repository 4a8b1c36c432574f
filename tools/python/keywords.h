#pragma once

// Keyword arguments as options of the command: draw(mesh, line_width=2, eye=(1, 2, 3)) has the options, checks and
// messages of `rimline draw --line-width 2 --eye 1,2,3`.
//
//     None                     not given
//     True, False              a flag, or on and off
//     a number                 the number
//     three numbers            x,y,z
//     a list of these          the option as often
//     a list of str            a,b,c
//     two numbers              WxH, where it is a size
//     three or four numbers    a color, from 0 to 1, where it is one

#include <pybind11/pybind11.h>

#include <string>

#include "tools/cli_classes.h"

namespace rimline::python {

/// The message with `line_width` for `--line-width`: callers know keywords.
std::string in_keywords(std::string message);

/// Parses `keywords` into the options of `app`, once. Throws TypeError for a
/// name that `app` has not, ValueError for a wrong value.
void parse_keywords(CLI::App& app, const pybind11::dict& keywords);

}  // namespace rimline::python
