// Points that represent a surface whose number of points is unknown in advance.

#include "Grid/SurfaceSample.h"

#include <gtest/gtest.h>

#include <cstddef>

using namespace activesurface;

namespace TestSurfaceSample
{

// All points are kept below twice Most; beyond that, every second, fourth and so on.
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
