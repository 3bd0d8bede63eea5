#include "tools/feature_words.h"

#include "tools/worded.h"

namespace tools {

const char* feature_need(fpo::FeatureNeed need) {
  switch (need) {
    case fpo::FeatureNeed::number:
      return "curves are many";
    case fpo::FeatureNeed::short_curves:
      return "some curves are short";
    case fpo::FeatureNeed::close_curves:
      return "some curves are close to each other";
    case fpo::FeatureNeed::small_angles:
      return "some curves meet at small angles";
  }
  return "";
}

std::string feature_bound_line(const fpo::RemeshResult& result) {
  const std::size_t n = result.samples.size(), needed = result.feature_bound.samples;
  const char* why = feature_need(result.feature_bound.need);
  std::string line;
  if (needed > n)
    line =
        worded("features  from -n %zu on all curves are kept and none is in the way of another's edges: %s",
               needed, why);
  else if (needed == 0 && result.feature_bound.need != fpo::FeatureNeed::number)
    line = worded("features  with no number of samples are curves out of the way of each other's edges: %s",
                  why);
  else
    return {};
  if (!result.has_levels)
    line += worded("; here %zu of %zu edges are proven", result.proven_edges, result.feature_edges);
  if (result.collapsed_curves > 0)
    line += ", and " + counted(result.collapsed_curves, "curve is collapsed", "curves are collapsed");
  return line;
}

}  // namespace tools
