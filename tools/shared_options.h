#pragma once
// Options that several tools have.

#include <filesystem>
#include <optional>
#include <string>

#include "fpo/domain.h"
#include "tools/option_table.h"

namespace tools {

/// --log: a table of the iterations (run_log.h).
void declare_log(OptionTable& options, std::filesystem::path& log);
/// --json
void declare_json(OptionTable& options, bool& json);
/// --ser
void declare_shortest_edge_removal(OptionTable& options, bool& removal);

/// --local and --global: where farthest points are looked for.
struct ScopeFlags {
  bool local = false, global = false;

  /// `by_default` is said of each: "" or " (default if ...)".
  void declare(OptionTable& options, const std::string& local_by_default,
               const std::string& global_by_default);
  /// None: neither is given. Throws UsageError if both are.
  std::optional<fpo::Scope> scope() const;
};

}  // namespace tools
