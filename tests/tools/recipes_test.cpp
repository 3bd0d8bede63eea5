// README's recipes, each command run as it is printed.

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "doctest.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

namespace {

/// The indented commands between two headings of README.
std::vector<std::string> commands_under(const std::string& heading) {
  std::ifstream file(std::filesystem::path(FPO_REPLAYS_DIR) / "../../../README.md");
  REQUIRE(file.is_open());
  std::vector<std::string> commands;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) inside = line == "## " + heading;
    if (inside && line.starts_with("build/")) commands.push_back(line.substr(0, line.find("  #")));
  }
  return commands;
}

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream in(command);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

TEST_CASE("README: its recipes run as printed, and write what they say") {
  const fixtures::ScratchFolder folder;
  const std::vector<std::string> commands = commands_under("Six recipes");
  CHECK(commands.size() >= 6);
  for (const std::string& command : commands) {
    CAPTURE(command);
    std::vector<std::string> words = words_of(command);
    const std::string program = words.front().substr(std::string("build/").size());
    words.erase(words.begin());
    const fixtures::ProgramResult result = fixtures::run_program(program, words, folder.path());
    CAPTURE(result.err);
    CHECK(result.code == 0);
    CHECK(result.err.find("warning") == std::string::npos);
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
      if (words[i] == "-o" || words[i] == "--points") CHECK(std::filesystem::exists(folder / words[i + 1]));
  }
}
