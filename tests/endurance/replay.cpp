#include "tests/endurance/replay.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "geom/check.h"

namespace endurance {
namespace {

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, " %a", x);
  return text;
}

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(const std::string& line) : in_(line), line_(line) {}
  std::string word() {
    std::string result;
    geom::require(static_cast<bool>(in_ >> result), "replay: a word is missing: " + line_);
    return result;
  }
  double number() {
    const std::string text = word();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    geom::require(*end == '\0', "replay: not a number: " + text);
    return value;
  }
  int integer() { return static_cast<int>(number()); }

 private:
  std::istringstream in_;
  std::string line_;
};

void parse_line(Words& words, Replay& replay) {
  const std::string kind = words.word();
  if (kind == "surface") {
    replay.place.shape = words.word();
    replay.place.size = words.integer();
    replay.place.all_corners = words.word() == "all";
    replay.search = words.word() == "search";
  } else if (kind == "plane") {
    replay.place.shape = kind;
    replay.place.period.x() = words.number(), replay.place.period.y() = words.number();
  } else {
    geom::require(kind == "+" || kind == "-", "replay: '" + kind + "' means nothing");
    Operation operation{kind == "+", geom::SiteId(words.integer()), {}};
    if (operation.insert) {
      geom::Vec3& x = operation.point.position;
      x = geom::Vec3::Zero();
      for (int k = 0; k < (replay.place.shape == "plane" ? 2 : 3); ++k) x[k] = words.number();
      operation.point.weight = words.number();
    }
    replay.operations.push_back(operation);
  }
}

}  // namespace

std::string to_text(const Replay& replay) {
  const Place& place = replay.place;
  const bool plane = place.shape == "plane";
  std::string text = "# " + replay.remark + "\n";
  if (plane)
    text += "plane" + hexadecimal(place.period.x()) + hexadecimal(place.period.y()) + "\n";
  else
    text += "surface " + place.shape + " " + std::to_string(place.size) +
            (place.all_corners ? " all" : " c") + (replay.search ? " search" : " triangulation") + "\n";
  for (const Operation& o : replay.operations) {
    text += (o.insert ? "+ " : "- ") + std::to_string(o.site.value);
    if (o.insert) {
      for (int k = 0; k < (plane ? 2 : 3); ++k) text += hexadecimal(o.point.position[k]);
      text += hexadecimal(o.point.weight);
    }
    text += "\n";
  }
  return text;
}

Replay parse_replay(const std::string& text) {
  Replay replay;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line[0] == '#') {
      replay.remark = line.substr(std::min<std::size_t>(2, line.size()));
      continue;
    }
    Words words(line);
    parse_line(words, replay);
  }
  geom::require(!replay.place.shape.empty(), "replay: neither a surface nor a plane");
  return replay;
}

Replay read_replay(const std::filesystem::path& path) {
  std::ifstream file(path);
  geom::require(file.good(), path.string() + ": cannot be read");
  std::stringstream text;
  text << file.rdbuf();
  return parse_replay(text.str());
}

}  // namespace endurance
