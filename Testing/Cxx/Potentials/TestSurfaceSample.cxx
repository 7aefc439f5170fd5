// Points that stand for a surface, of which nobody knows how many there will be.

#include "SurfaceSample.h"

#include <gtest/gtest.h>

#include <cstddef>

using namespace activesurface;

namespace TestSurfaceSample
{

// All as long as there are less than two times Most; then each second, fourth ...
TEST(TestSurfaceSample, GatheredPointsAreEvenlyApart)
{
  constexpr std::size_t most = SurfaceSample::Most;
  SurfaceGatherer gatherer;
  for (std::size_t i = 0; i < 7 * most; ++i)
  {
    if (gatherer.WantsNext())
    {
      gatherer.Add({ { static_cast<double>(i), 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, 1.0 });
    }
    if (i == most)
    {
      EXPECT_EQ(gatherer.Points.size(), most + 1) << "all at first";
    }
  }
  constexpr std::size_t apart = 4;
  ASSERT_EQ(gatherer.Points.size(), 7 * most / apart);
  for (std::size_t i = 0; i < gatherer.Points.size(); ++i)
  {
    ASSERT_EQ(gatherer.Points[i].Place[0], static_cast<double>(apart * i)) << "point " << i;
  }
}

}
