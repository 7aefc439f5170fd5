// The main function of all tests. A filter that selects no test is an error; otherwise a renamed
// test would pass.

#include <gtest/gtest.h>

#include <cstdio>

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0)
  {
    std::fprintf(stderr, "No test has this name; --gtest_list_tests prints the names.\n");
    return 1;
  }
  return failed;
}
