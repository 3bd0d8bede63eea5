#include "tools/shared_options.h"

#include "tools/cli.h"

namespace tools {

void declare_log(OptionTable& options, std::filesystem::path& log) {
  options.output({.name = "log", .value = "OUT.csv", .help = "iteration, moved, delta, mean_delta, seconds"},
                 log, {".csv", ".txt"});
}

void declare_json(OptionTable& options, bool& json) {
  options.flag({.name = "json", .help = "print the summary as a JSON object"}, json);
}

void declare_shortest_edge_removal(OptionTable& options, bool& removal) {
  options.toggle({.name = "ser", .help = "shortest edge removal first"}, removal);
}

void ScopeFlags::declare(OptionTable& options, const std::string& local_by_default,
                         const std::string& global_by_default) {
  options.flag({.name = "local", .help = "look for farthest points nearby only" + local_by_default}, local);
  options.flag({.name = "global", .help = "look for them everywhere" + global_by_default}, global);
}

std::optional<fpo::Scope> ScopeFlags::scope() const {
  if (local && global) throw UsageError("--local and --global exclude each other");
  if (local) return fpo::Scope::two_ring;
  if (global) return fpo::Scope::global;
  return {};
}

}  // namespace tools
