#include "tools/period.h"

#include "geom/check.h"
#include "geom/regular/flat_torus.h"
#include "tools/numbers.h"

namespace tools {

geom::Vec2 parse_period(const std::string& text) {
  const std::size_t times = text.find('x');
  geom::require(times != std::string::npos, "'" + text + "' is not WIDTHxHEIGHT");
  const auto side = [](const std::string& number) {
    return parse_number(number, geom::FlatTorus::least_period, geom::FlatTorus::largest_period);
  };
  return {side(text.substr(0, times)), side(text.substr(times + 1))};
}

}  // namespace tools
