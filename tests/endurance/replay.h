#pragma once
// A sequence of insertions and removals, as text: what a long run did before it failed, small enough to be
// kept and replayed for ever.

#include <filesystem>
#include <string>
#include <vector>

#include "geom/ids.h"
#include "geom/vec.h"

namespace endurance {

struct Operation {
  bool insert = false;
  geom::SiteId site;
  geom::WeightedPoint3 point;  ///< of an insertion; in the plane z = 0
};

/// Where the sites are: a shape of geom/shapes/shapes.h, or ("plane") the torus of a period.
struct Place {
  std::string shape;
  int size = 0;
  bool all_corners = false;  ///< which circles are registered: type C only, or all
  geom::Vec2 period{1, 1};
};

struct Replay {
  std::string remark;  ///< a line: why it is kept
  Place place;
  bool search = true;  ///< which engine failed
  std::vector<Operation> operations;
};

/// The file:
///   # remark
///   surface SHAPE SIZE c|all search|triangulation     or     plane WIDTH HEIGHT
///   + ID X Y Z WEIGHT                                        + ID X Y WEIGHT
///   - ID
/// with hexadecimal numbers. Throw geom::InputError on another text.
std::string to_text(const Replay& replay);
Replay parse_replay(const std::string& text);
Replay read_replay(const std::filesystem::path& path);

}  // namespace endurance
