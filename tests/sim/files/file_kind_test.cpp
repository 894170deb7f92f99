#include <array>
#include <functional>
#include <string>
#include <vector>

#include "sim/control/flavour_file.h"
#include "sim/files/machine_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// A text that is one kind of file, and a reader that takes only this kind.
struct FileKind {
  std::string name;
  std::vector<std::string> texts;
  std::function<std::vector<std::string>(const std::string&)> complaints;
};

template <class Parse>
std::function<std::vector<std::string>(const std::string&)> complaints_by(const Parse& parse) {
  return [parse](const std::string& text) {
    return complaints_of(parse("format = 1\n" + text, "f.toml"));
  };
}

std::vector<FileKind> file_kinds() {
  return {{"a mission file",
           {"preset = \"aggregation\"\nrobots = 2\n", "name = \"x\"\n[score]\nkind = 1\n"},
           complaints_by(parse_mission)},
          {"a robot file",
           {"base = \"epuck\"\n[neighbours]\nrange = 0.7\n", "[body]\nmass = 3\n",
            "[drive]\nfrce = 3\n"},
           complaints_by(parse_robot)},
          {"a profile",
           {"base = \"epuck\"\n[neighbours]\nmiss_rate = 0.7\n", "[timing]\njiter = 0.1\n"},
           complaints_by(parse_profile)},
          {"a flavour",
           {"base = \"chocolate\"\n[steering]\nobstacle_gain = 7\n", "states = 99\n"},
           complaints_by(parse_flavour)}};
}

// Also of files with errors of their own, which only their own readers list.
TEST(FileKind, AFileThatIsOfAnotherKindGetsOneSentence) {
  for (const FileKind& given : file_kinds()) {
    for (const std::string& text : not_empty(given.texts)) {
      for (const FileKind& wanted : file_kinds()) {
        const auto said = wanted.complaints(text);
        if (wanted.name == given.name) {
          EXPECT_THAT(said, Not(Contains(HasSubstr("this is ")))) << text;
        } else {
          EXPECT_THAT(said, ElementsAre(HasSubstr("f.toml: this is " + given.name + "; ")))
              << wanted.name << " of\n"
              << text;
        }
      }
      EXPECT_THAT(complaints_of(parse_machine_file("format = 1\n" + text, "f.toml")),
                  ElementsAre(HasSubstr("this is " + given.name)));
    }
  }
}

}  // namespace
}  // namespace swarmsmith
