#pragma once

// The name that was probably meant by a mistyped one, for "did you mean" in messages.
//
// Names are compared by the optimal string alignment distance: the least number of letters to insert, delete,
// replace, or swap with their neighbor, where no letter is edited twice. Case does not count.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace rimline::tools {

/// O(length of a * length of b).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of `names`, the first of several; empty if each is farther away than a third of the letters of
/// `text`, at least 1 and at most 3, or if `text` is one of them.
std::string nearest_name(std::string_view text, std::span<const std::string> names);

/// "; did you mean 'NAME'?" with nearest_name(); empty if there is none.
std::string did_you_mean(std::string_view text, std::span<const std::string> names);

}  // namespace rimline::tools
