// Tests that the helpers of the other tests pass and fail when they should.

#include "Support/OutputFiles.h"
#include "Support/SameSkins.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace TestSupport
{

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

TEST(TestSupport, EmptySkinsAreNotTheSame)
{
  using activesurface::AreSameSkins;
  EXPECT_TRUE(AreSameSkins("bytes", "bytes"));
  EXPECT_FALSE(AreSameSkins("bytes", "other"));
  EXPECT_FALSE(AreSameSkins("bytes", ""));
  EXPECT_FALSE(AreSameSkins("", ""));
}

TEST(TestSupport, EmptyBandsCannotBeCompared)
{
  using namespace activesurface;
  const NarrowBand empty(0.1);
  NarrowBand ball(VoxelSizeOf(32)), other(VoxelSizeOf(32));
  StartOn(ball, MakeBall(CentreA, 0.5));
  StartOn(other, MakeBall(CentreA, 0.5));
  EXPECT_TRUE(AreIdentical(ball, other));
  StartOn(other, MakeBall(CentreB, 0.5));
  EXPECT_FALSE(AreIdentical(ball, other));
  EXPECT_FALSE(AreIdentical(ball, empty));
  EXPECT_TRUE(Throws<std::logic_error>([&] { AreIdentical(empty, empty); }, "empty"));
}

}
