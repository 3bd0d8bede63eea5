// Replays of faults that were once found, and of hard sequences; a moment of endurance on every domain; and
// that a fault would be found, minimised and written down.

#include <algorithm>
#include <filesystem>

#include "doctest.h"
#include "geom/check.h"
#include "tests/endurance/minimise.h"
#include "tests/endurance/run.h"

using namespace endurance;

TEST_CASE("endurance: every replay passes with both engines") {
  std::size_t replays = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FPO_REPLAYS_DIR)) {
    if (entry.path().extension() != ".txt") continue;
    CAPTURE(entry.path().filename().string());
    Replay replay = read_replay(entry.path());
    ++replays;
    const bool verify_always = replay.operations.size() < 500;
    for (const bool search : {true, false}) {
      replay.search = search;
      CHECK(fault_of(replay, verify_always) == "");
    }
  }
  CHECK(replays > 0);
}

TEST_CASE("endurance: some thousand moves on every domain") {
  RunOptions options;
  options.moves = 2000;
  options.check_every = options.brute_every = 50;
  options.rebuild_every = 250;
  for (const Course& course : courses()) {
    CAPTURE(course.name);
    const RunResult result = run(course, options);
    CHECK_MESSAGE(!result.failure, result.failure.value_or(Replay{}).remark);
    CHECK(result.moves == options.moves);
    CHECK(result.operations > options.moves);
    CHECK(result.rebuilds == 8);
  }
}

TEST_CASE("endurance: a replay is read as it was written") {
  Replay replay;
  replay.remark = "of all kinds";
  replay.place = {"wave-disk", 7, true, {1, 1}};
  replay.search = false;
  replay.operations = {{true, geom::SiteId(3), {{0.1, -1e-300, 0x1p-160}, 1.0 / 3}},
                       {false, geom::SiteId(3), {}},
                       {true, geom::SiteId(70), {{0, -0.0, 5}, -2}}};
  const std::string text = to_text(replay);
  CHECK(to_text(parse_replay(text)) == text);
  CHECK(parse_replay(text).operations[0].point.position == replay.operations[0].point.position);
  replay.place = {"plane", 0, false, {0.1, 0.3}};
  CHECK(to_text(parse_replay(to_text(replay))) == to_text(replay));
  CHECK_THROWS_AS(parse_replay("+ 1 2 3 4 5\n"), geom::InputError);
  CHECK_THROWS_AS(parse_replay("plane 1 1\n+ 1 2 x 4\n"), geom::InputError);
  CHECK_THROWS_AS(parse_replay("plane 1 1\n* 1 2 3 4\n"), geom::InputError);
}

// The fault: 7, later 3, later still 3 again.
TEST_CASE("endurance: minimising leaves what a fault needs") {
  std::vector<int> items;
  for (int i = 0; i < 1000; ++i) items.push_back(i % 10);
  std::size_t calls = 0;
  const auto fails = [&](const std::vector<int>& sequence) {
    ++calls;
    const int needed[] = {7, 3, 3};
    const auto* next = std::begin(needed);
    for (const int item : sequence)
      if (next != std::end(needed) && item == *next) ++next;
    return next == std::end(needed);
  };
  CHECK(minimised(items, fails, 100'000) == std::vector{7, 3, 3});
  CHECK(calls < 200);
  calls = 0;
  CHECK(fails(minimised(items, fails, 5)));
  CHECK(calls <= 6);
}
