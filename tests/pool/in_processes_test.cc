#include "tools/pool/in_processes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

namespace talus::in_processes_test {
namespace {

std::map<int, TaskOutcome> outcomes(int count, int jobs, const std::function<std::string(int)>& task) {
  std::map<int, TaskOutcome> all;
  in_processes(count, jobs, task, [&](int i, const TaskOutcome& outcome) { all[i] = outcome; });
  return all;
}

TEST(InProcesses, EachTaskReturnsItsTextWhateverTheNumberOfJobs) {
  for (const int jobs : {1, 3, 20}) {
    const auto all = outcomes(7, jobs, [](int i) { return std::string(static_cast<std::size_t>(i) * 50'000, 'x'); });
    ASSERT_EQ(all.size(), 7U);
    for (const auto& [i, outcome] : all) {
      EXPECT_FALSE(outcome.failed);
      EXPECT_EQ(outcome.text.size(), static_cast<std::size_t>(i) * 50'000) << "more than a pipe holds";
    }
  }
}

TEST(InProcesses, AFailureOrACrashCostsOneTask) {
  const auto all = outcomes(3, 2, [](int i) -> std::string {
    if (i == 0) throw std::runtime_error("no room");
    if (i == 1) _Exit(7);
    return "done";
  });
  EXPECT_TRUE(all.at(0).failed);
  EXPECT_EQ(all.at(0).text, "no room");
  EXPECT_TRUE(all.at(1).failed);
  EXPECT_EQ(all.at(2).text, "done");
}

}  // namespace
}  // namespace talus::in_processes_test
