#pragma once

#include <string>
#include <vector>

namespace swarmsmith::cli {

/// A machine's text looks like options of the program: `--nstates 2 --s0 0 ...`. Joins its
/// arguments into one argument that starts with a blank, so that it is not read as options. The
/// machine begins at an argument with `--nstates`, or with the first switch of a tree or network,
/// and continues while the arguments belong to its grammar; or it is everything after an argument
/// `--`. Other arguments do not change.
std::vector<std::string> with_machine_as_one_word(std::vector<std::string> words);

}  // namespace swarmsmith::cli
