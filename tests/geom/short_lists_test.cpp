#include "geom/short_lists.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"

using namespace geom;

TEST_CASE("short lists: against vectors while members come and go") {
  using Member = Id<struct MemberTag>;
  Rng rng(3);
  ShortLists<SiteId, Member> lists(4);
  std::vector<std::vector<Member>> expected(40);
  for (int step = 0; step < 20000; ++step) {
    const std::size_t k = static_cast<std::size_t>(rng.below(rng.below(2) == 0 ? 3 : 40));
    const SiteId key(k);
    std::vector<Member>& list = expected[k];
    if (rng.below(500) == 0) {
      if (k < lists.num_keys()) lists.clear(key);
      list.clear();
    } else if (list.empty() || rng.below(100) < 52) {
      const Member m(static_cast<std::size_t>(step));
      CHECK(lists.push(key, m) == list.size());
      list.push_back(m);
    } else {
      const auto place = static_cast<std::uint32_t>(rng.below(list.size()));
      const bool last = place + 1 == list.size();
      const Member moved = lists.erase(key, place);
      list[place] = list.back();
      list.pop_back();
      CHECK(moved == (last ? Member() : list[place]));
    }
    const SiteId other(static_cast<std::size_t>(rng.below(45)));  // some have no list
    for (const SiteId s : {key, other})
      CHECK(std::ranges::equal(std::as_const(lists)[s],
                               s.index() < 40 ? expected[s.index()] : std::vector<Member>()));
  }
}
