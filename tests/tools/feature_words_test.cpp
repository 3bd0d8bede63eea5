#include "tools/feature_words.h"

#include "doctest.h"

using fpo::FeatureNeed;

TEST_CASE("feature words: below the number it is said with the reason, from there on nothing is") {
  fpo::RemeshResult result;
  result.samples.resize(100);
  CHECK(tools::feature_bound_line(result).empty());  // no features
  result.feature_edges = 40;
  result.proven_edges = 38;
  for (const std::size_t needed : {50, 100, 101, 5000}) {
    CAPTURE(needed);
    result.feature_bound = {needed, FeatureNeed::close_curves};
    const std::string line = tools::feature_bound_line(result);
    CHECK(line.empty() == (needed <= 100));
    if (line.empty()) continue;
    CHECK(line.find("-n " + std::to_string(needed)) != std::string::npos);
    CHECK(line.find("close to each other") != std::string::npos);
    CHECK(line.find("38 of 40") != std::string::npos);
    CHECK(line.find("collapsed") == std::string::npos);
  }
  result.collapsed_curves = 3;
  CHECK(tools::feature_bound_line(result).find("3 curves are collapsed") != std::string::npos);
  result.feature_bound = {0, FeatureNeed::small_angles};
  CHECK(tools::feature_bound_line(result).find("no number of samples") != std::string::npos);
}
