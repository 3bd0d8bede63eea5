// The paper's rows: sanity of the figures, and how models are recognised.

#include "fpo/measure/paper_rows.h"

#include <algorithm>
#include <set>
#include <string>

#include "doctest.h"

TEST_CASE("paper rows: every block has one row a method, FPO among them, with figures that can be") {
  std::size_t rows = 0;
  for (const fpo::PaperBlock& block : fpo::paper_blocks()) {
    CAPTURE(block.model);
    std::set<std::string> methods;
    for (const fpo::PaperRow& row : block.rows) {
      CHECK(methods.insert(row.method).second);
      const fpo::PaperFigures& f = row.figures;
      CHECK((0 < f.q_min && f.q_min < f.q_avg && f.q_avg < 1));
      CHECK((0 < f.theta_min && f.theta_min < f.theta_min_avg && f.theta_min_avg < 60));
      CHECK((60 < f.theta_max && f.theta_max < 180));
      // The largest angle leaves twice the smallest at least.
      CHECK(f.theta_max + 2 * f.theta_min <= 180);
      // The paper counts from about 30 degrees on.
      if (f.theta_lt30_pct > 0) CHECK(f.theta_min < 30);
      CHECK((90 < f.v567_pct && f.v567_pct <= 100));
      CHECK((0 < f.d_h_pct && f.d_h_pct < 3));
    }
    CHECK(methods.contains("FPO"));
    CHECK(methods.contains("MPS"));
    CHECK(methods.contains("SER") == (block.table != 4));
    rows += block.rows.size();
  }
  CHECK(rows == fpo::paper_rows().size());
}

TEST_CASE("paper rows: a model is known by its file's stem, kind of sizing and number of samples") {
  const auto found = [](const char* stem, std::size_t n, bool adaptive) {
    const auto block = fpo::find_paper_block(stem, n, adaptive);
    return block ? block->model + " " + std::to_string(block->samples) : "";
  };
  CHECK(found("eight", 1700, false) == "Eight 1700");
  CHECK(found("EIGHT", 1660, false) == "Eight 1700");
  CHECK(found("eight", 1760, false) == "");
  CHECK(found("eight", 1700, true) == "");
  CHECK(found("eighth", 1700, false) == "");
  CHECK(found("genus3", 6500, false) == "Genus 6500");
  CHECK(found("homer", 7900, false) == "Homer 7900");
  CHECK(found("homer", 7500, true) == "Homer 7500");
  CHECK(found("mask", 3300, true) == "Mask 3300");
  CHECK(found("3", 6500, false) == "");
  CHECK(found("", 6500, false) == "");
}
