// A file is replaced completely or not at all, and no temporary file remains.

#include "Support/OutputFiles.h"
#include "Support/Throws.h"

#include "FileReplacement.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace activesurface;

namespace TestFileReplacement
{

namespace
{

void WriteText(const std::string& name, const std::string& text)
{
  std::ofstream(name) << text;
}

std::string ReadText(const std::string& name)
{
  std::ostringstream text;
  text << std::ifstream(name).rdbuf();
  return text.str();
}

}

TEST(TestFileReplacement, FinishedFileTakesTheName)
{
  const std::string folder = EmptyFolder("finished");
  const std::string name = folder + "a.vdb";
  WriteText(name, "old");
  FileReplacement file(name);
  WriteText(file.GetTemporaryName(), "new");
  EXPECT_EQ(ReadText(name), "old") << "before the end";
  file.Finish();
  EXPECT_EQ(ReadText(name), "new") << "at the end";
  EXPECT_EQ(CountFiles(folder), 1u) << "files";
}

TEST(TestFileReplacement, UnfinishedFileLeavesTheOneBefore)
{
  const std::string folder = EmptyFolder("unfinished");
  const std::string name = folder + "a.vdb";
  WriteText(name, "old");
  {
    FileReplacement file(name);
    WriteText(file.GetTemporaryName(), "half of");
    EXPECT_EQ(CountFiles(folder), 2u) << "files, while it is written";
  }
  EXPECT_EQ(ReadText(name), "old");
  EXPECT_EQ(CountFiles(folder), 1u) << "files";
}

TEST(TestFileReplacement, FoldersAndDevicesAreRefused)
{
  const std::string folder = EmptyFolder("folder");
  EXPECT_TRUE(Throws<std::runtime_error>([&] { FileReplacement file(folder); }, "folder"));
  EXPECT_TRUE(Throws<std::runtime_error>([] { FileReplacement file("/dev/null"); }, "device"));
}

TEST(TestFileReplacement, FileThatIsNotWrittenCannotBeFinished)
{
  FileReplacement file(EmptyFolder("nothing") + "a.vdb");
  EXPECT_TRUE(Throws<std::runtime_error>([&] { file.Finish(); }, "name"));
}

}
