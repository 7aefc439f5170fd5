// What the other tests rely on: each helper passes when it should and fails when it should.

#include "Support/OutputFiles.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

TEST(TestSupport, ThrowsWantsTheExceptionAndTheMessage)
{
  const auto fail = [] { throw std::runtime_error("the band is full"); };
  EXPECT_TRUE(Throws<std::runtime_error>(fail, "full"));
  EXPECT_TRUE(Throws<std::exception>(fail, "full")) << "a base class";
  EXPECT_FALSE(Throws<std::runtime_error>(fail, "empty")) << "another message";
  EXPECT_FALSE(Throws<std::runtime_error>([] {}, "full")) << "nothing thrown";
  EXPECT_THROW(Throws<std::invalid_argument>(fail, "full"), std::runtime_error)
    << "another exception";
}

TEST(TestSupport, EachTestHasAFolderOfItsOwn)
{
  const std::filesystem::path file = OutputName("file");
  EXPECT_EQ(file.parent_path().filename(), "EachTestHasAFolderOfItsOwn");
  EXPECT_EQ(file.parent_path().parent_path().filename(), "TestSupport");
  EXPECT_EQ(CountFiles(EmptyFolder("empty")), 0u);
}
