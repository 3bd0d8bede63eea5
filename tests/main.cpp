// The test program: doctest's own runner, then one closing line with the counts.

#define DOCTEST_CONFIG_IMPLEMENT
#include <iostream>

#include "doctest.h"
#include "tests/fixtures/models.h"

namespace {

struct Tally {
  unsigned passed = 0, failed = 0, skipped = 0;
  bool complete = false;  ///< the run came to its end: not a mere query such as --list-test-cases
};

Tally& tally() {
  static Tally counts;
  return counts;
}

/// Listens to the run and sorts every test case into passed, failed, skipped (a missing model was announced).
struct TallyListener : doctest::IReporter {
  explicit TallyListener(const doctest::ContextOptions&) {}

  void test_case_start(const doctest::TestCaseData&) override { fixtures::skip_announced() = false; }
  void test_case_end(const doctest::CurrentTestCaseStats& test) override {
    if (!test.testCaseSuccess) {
      ++tally().failed;
    } else if (fixtures::skip_announced()) {
      ++tally().skipped;
    } else {
      ++tally().passed;
    }
  }
  void test_run_end(const doctest::TestRunStats&) override { tally().complete = true; }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("tally", 1, TallyListener);

}  // namespace

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int result = context.run();
  if (tally().complete) {
    std::cout << tally().passed << " passed, " << tally().failed << " failed, " << tally().skipped
              << " skipped" << std::endl;
  }
  return result;
}
