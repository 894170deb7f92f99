#pragma once

#include <string>
#include <vector>

namespace swarmsmith::cli {

/// A machine's text looks like options of the program: `--nstates 2 --s0 0 ...`. Makes one word of
/// it that starts with a blank, so that it is taken for what it is. The machine begins at a word
/// with `--nstates`, or as trees and networks begin, and goes on as long as the words are of its
/// grammar, or is everything behind a word `--`. Other words stay as they are.
std::vector<std::string> with_machine_as_one_word(std::vector<std::string> words);

}  // namespace swarmsmith::cli
