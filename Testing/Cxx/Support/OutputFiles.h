/**
 * Output files of a test, in a folder of its own, because ctest runs several tests at once.
 */
#ifndef OutputFiles_h
#define OutputFiles_h

#include "Support/TestFolders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>

/** Path of a file in the folder of the current test. */
inline std::string OutputName(const std::string& name)
{
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
    std::filesystem::path(TestOutputFolder) / test->test_suite_name() / test->name();
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

/** Creates an empty folder in the folder of the current test; its path ends in a slash. */
inline std::string EmptyFolder(const std::string& name)
{
  const std::string folder = OutputName(name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder + "/";
}

inline std::size_t CountFiles(const std::string& folder)
{
  return static_cast<std::size_t>(std::distance(
    std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

#endif
