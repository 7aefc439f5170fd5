// Events between two times of a skin, derived from its parts.

#include "Support/SurfaceMeasures.h"

#include "Surface/SkinEvents.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkinEvents
{
std::vector<SkinPart> PartsOf(const Shape& shape)
{
  NarrowBand band(VoxelSizeOf(48));
  StartOn(band, shape);
  return FindSkinParts(band);
}

// Balls along the x axis.
Shape BallsAt(const std::vector<std::pair<double, double>>& placesAndRadii)
{
  std::vector<Ball> balls;
  for (const auto& [x, radius] : placesAndRadii)
  {
    balls.push_back({ { x, 0.01, -0.02 }, radius });
  }
  return MakeBalls(balls);
}

void CheckEvent(const Shape& before, const Shape& after, const std::string& expected)
{
  EXPECT_EQ(FindEvents(PartsOf(before), PartsOf(after)), expected) << "events";
}

TEST(TestSkinEvents, BodiesMergeAndSplit)
{
  const Shape two = BallsAt({ { -0.42, 0.35 }, { 0.42, 0.35 } });
  const Shape one = BallsAt({ { -0.3, 0.36 }, { 0.3, 0.36 } });
  CheckEvent(two, one, "merge");
  CheckEvent(one, two, "split");
  CheckEvent(two, two, "");
  CheckEvent(one, BallsAt({ { -0.25, 0.36 }, { 0.25, 0.36 } }), "");
}

// The body that vanishes in the second case is next to an unchanged body, with which it has not
// merged.
TEST(TestSkinEvents, BodiesVanish)
{
  const Shape large = BallsAt({ { -0.4, 0.4 } });
  CheckEvent(BallsAt({ { -0.4, 0.4 }, { 0.7, 0.1 } }), large, "vanish");
  CheckEvent(BallsAt({ { -0.4, 0.4 }, { 0.22, 0.12 } }), large, "vanish");
  CheckEvent(large, MakeConstant(1.0), "vanish");
  CheckEvent(MakeConstant(1.0), large, "birth");
}

TEST(TestSkinEvents, JumpsAreNoEvents)
{
  CheckEvent(BallsAt({ { -0.6, 0.2 } }), BallsAt({ { 0.6, 0.2 } }), "");
}

TEST(TestSkinEvents, VoidsAndHolesOpenAndClose)
{
  const Point origin = { 0.0, 0.0, 0.0 };
  const Shape ball = MakeBall(origin, 0.7), shell = MakeShell(0.7, 0.3);
  CheckEvent(shell, ball, "void closes");
  CheckEvent(ball, shell, "void opens");
  const Shape ring = MakeTorus(origin, 0.5, 0.2);
  CheckEvent(ball, ring, "hole opens");
  CheckEvent(ring, ball, "hole closes");
}

TEST(TestSkinEvents, SeveralEventsAreTold)
{
  const Shape before = BallsAt({ { -0.62, 0.18 }, { -0.22, 0.18 }, { 0.5, 0.28 } });
  const Shape after = BallsAt({ { -0.52, 0.2 }, { -0.32, 0.2 }, { 0.32, 0.15 }, { 0.68, 0.15 } });
  CheckEvent(before, after, "merge, split");
}
}
