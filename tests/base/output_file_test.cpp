#include "base/output_file.h"

#include <fstream>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string refusal(const fs::path& file, FileKind kind) {
  const auto place = output_place(file, kind);
  return place ? "" : to_string(place.error());
}

TEST(FileKindTest, IsToldByTheBeginning) {
  EXPECT_EQ(kind_of(std::string("SQLite format 3\0..", 18)), FileKind::Store);
  EXPECT_EQ(kind_of("\x1a\x45\xdf\xa3..."), FileKind::Video);
  EXPECT_EQ(kind_of("....ftypisom"), FileKind::Video);
  EXPECT_EQ(kind_of("RIFF....AVI "), FileKind::Video);
  EXPECT_EQ(kind_of("\x89PNG\r\n"), FileKind::Picture);
  EXPECT_EQ(kind_of("%PDF-1.4"), FileKind::Pdf);
  EXPECT_EQ(kind_of("\x1f\x8b\x08..."), FileKind::Gzip);
  EXPECT_EQ(kind_of("<?xml version='1.0'?>\n<svg xmlns"), FileKind::Svg);
  EXPECT_EQ(kind_of("<!DOCTYPE html>\n<html><body><svg>"), FileKind::WebPage);
  EXPECT_EQ(kind_of("{\"a\":1}"), FileKind::Json);
  EXPECT_EQ(kind_of("# a comment, with commas\n\n[[camera]]\nname = 1\n"), FileKind::Toml);
  EXPECT_EQ(kind_of("format = 1\n"), FileKind::Toml);
  EXPECT_EQ(kind_of("[simulator]\n"), FileKind::Toml);
  EXPECT_EQ(kind_of("cycle,time_s,robot\n0,0,0\n"), FileKind::Table);
  EXPECT_EQ(kind_of("# a head\n--nstates 1 --s0 0 --rwm0 5\n"), FileKind::Text);
  EXPECT_EQ(kind_of("\\begin{table}, and so on"), FileKind::Text);
  EXPECT_EQ(kind_of("notes of a person"), FileKind::Text);
  EXPECT_EQ(kind_of(""), FileKind::Text);
}

TEST(OutputFilesTest, TwoOutputsAreNotOneFile) {
  const TemporaryFolder folder;
  const auto refusal_of = [](const fs::path& table, const fs::path& picture) {
    const auto own = each_its_own_file({{"--csv", table.string()}, {"--svg", picture.string()}});
    return own ? "" : to_string(own.error());
  };
  const std::string picture = (folder / "a.x").string();
  EXPECT_EQ(refusal_of(folder / "a.x", folder / "a.x"),
            "--svg: names the same file as --csv: " + picture + "; give each its own file");
  EXPECT_NE(refusal_of(folder / "b/../a.x", folder / "a.x"), "");
  EXPECT_EQ(refusal_of(folder / "a.x", folder / "b.x"), "");
  // By any name, whether it is there already or not.
  fs::create_symlink("a.x", folder / "link.x");
  EXPECT_NE(refusal_of(folder / "link.x", folder / "a.x"), "");
  write(folder / "a.x", "a,b\n");
  fs::create_hard_link(folder / "a.x", folder / "hard.x");
  EXPECT_NE(refusal_of(folder / "link.x", folder / "a.x"), "");
  EXPECT_NE(refusal_of(folder / "a.x", folder / "hard.x"), "");
  EXPECT_EQ(refusal_of(folder / "a.x", folder / "b.x"), "");
  // Not wanted, standard output, and a device.
  EXPECT_EQ(refusal_of("", ""), "");
  EXPECT_EQ(refusal_of("-", "-"), "");
  EXPECT_EQ(refusal_of("/dev/null", "/dev/null"), "");
}

TEST(OutputPlaceTest, OneThatIsReadIsNotWritten) {
  const TemporaryFolder folder;
  write(folder / "a.csv", "a,b\n");
  EXPECT_EQ(refusal(folder / "a.csv", FileKind::Table), "");
  note_input(folder / "a.csv");
  EXPECT_THAT(refusal(folder / "a.csv", FileKind::Table),
              HasSubstr("a.csv: is an input of this command"));
  // By any name.
  fs::create_hard_link(folder / "a.csv", folder / "b.csv");
  fs::create_symlink("a.csv", folder / "c.csv");
  EXPECT_NE(refusal(folder / "b.csv", FileKind::Table), "");
  EXPECT_NE(refusal(folder / "c.csv", FileKind::Table), "");
  forget_input(folder / "a.csv");
  EXPECT_EQ(refusal(folder / "c.csv", FileKind::Table), "");
}

TEST(OutputPlaceTest, OfAnotherKindIsNotReplaced) {
  const TemporaryFolder folder;
  write(folder / "arena.toml", "format = 1\n");
  EXPECT_THAT(refusal(folder / "arena.toml", FileKind::WebPage),
              HasSubstr("already exists and is a TOML file, not a web page"));
  EXPECT_EQ(refusal(folder / "arena.toml", FileKind::Toml), "");
  write(folder / "empty", "");
  EXPECT_EQ(refusal(folder / "empty", FileKind::Video), "");
  EXPECT_EQ(refusal("/dev/null", FileKind::Video), "");
  EXPECT_EQ(refusal(folder / "new.svg", FileKind::Svg), "");
}

TEST(OutputPlaceTest, IsWhereLinksLeadAlsoToNothing) {
  const TemporaryFolder folder;
  fs::create_symlink("target.csv", folder / "link.csv");
  EXPECT_EQ(output_place(folder / "link.csv", FileKind::Table).value(), folder / "target.csv");
  fs::create_symlink("round.csv", folder / "round.csv");
  EXPECT_TRUE(output_place(folder / "round.csv", FileKind::Table).has_value());
}

}  // namespace
}  // namespace swarmsmith
