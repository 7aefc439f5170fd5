// Region of changed particles: contains all changes, and little else.

#include "Support/RandomShapes.h"

#include "Targets/ChangedRegion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestChangedRegion
{

namespace
{
using Bounds = ChangedRegion::Box;

// Random box within +-size along x and y, and a tenth of that along z.
Bounds DrawBox(RandomShapes& random, double size, double width)
{
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double centre = random.DrawBetween(-size, size) * (axis == 2 ? 0.1 : 1.0);
    const double half = 0.5 * width * random.DrawBetween(0.5, 1.5);
    box[2 * axis] = centre - half;
    box[2 * axis + 1] = centre + half;
  }
  return box;
}

// Returns true if the boxes are at most `room` apart; `room` may be negative.
bool Touch(const Bounds& a, const Bounds& b, double room)
{
  bool touch = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    touch = touch && a[2 * axis] <= b[2 * axis + 1] + room && b[2 * axis] <= a[2 * axis + 1] + room;
  }
  return touch;
}

bool TouchAny(const std::vector<Bounds>& boxes, const Bounds& box, double room)
{
  return std::any_of(
    boxes.begin(), boxes.end(), [&](const Bounds& other) { return Touch(other, box, room); });
}

}

// Cells are half as wide as the boxes in the mean, or wider if more than 64 would be needed.
TEST(TestChangedRegion, BoxesAreFoundAndLittleElse)
{
  for (const int count : { 1, 3, 40, 400 })
  {
    RandomShapes random(count);
    std::vector<Bounds> boxes;
    for (int i = 0; i < count; ++i)
    {
      boxes.push_back(DrawBox(random, 10.0, 1.0));
    }
    ChangedRegion region;
    region.Set(boxes);
    int missed = 0, wrong = 0, near = 0, far = 0;
    for (int i = 0; i < 20000; ++i)
    {
      const Bounds box = DrawBox(random, 11.0, 0.3);
      const bool touches = TouchAny(boxes, box, 0.0), isFar = !TouchAny(boxes, box, 1.01);
      near += touches;
      far += isFar;
      missed += touches && !region.Touches(box.data());
      wrong += isFar && region.Touches(box.data());
    }
    const std::string name = std::to_string(count) + " boxes";
    EXPECT_GT(near, 10) << "boxes that touch, " << name;
    EXPECT_LT(count < 400 ? 1000 : 0, far) << "boxes that are far away, " << name;
    EXPECT_EQ(missed, 0) << "of those that touch, missed, " << name;
    EXPECT_EQ(wrong, 0) << "of those that are far away, found, " << name;
  }
}

TEST(TestChangedRegion, NothingAndEverything)
{
  const Bounds box = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  ChangedRegion region;
  EXPECT_TRUE(region.Touches(box.data())) << "everything may have changed before Set";
  region.Set({});
  EXPECT_FALSE(region.Touches(box.data())) << "no boxes";
  region.SetEverywhere();
  EXPECT_TRUE(region.Touches(box.data())) << "everywhere";
}

// Faces that meet touch. Boxes without extent, and boxes at extreme coordinates, are found.
TEST(TestChangedRegion, EdgesOfTheRange)
{
  ChangedRegion region;
  region.Set({ { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }, { 5.0, 6.0, 0.0, 1.0, 0.0, 1.0 } });
  const Bounds meets = { 6.0, 7.0, 0.0, 1.0, 0.0, 1.0 }, between = { 3.0, 3.1, 0.0, 1.0, 0.0, 1.0 };
  EXPECT_TRUE(region.Touches(meets.data())) << "faces that meet";
  EXPECT_FALSE(region.Touches(between.data())) << "between two boxes";

  const Bounds point = { 1e100, 1e100, 0.0, 0.0, 0.0, 0.0 };
  region.Set({ point, { -1e100, -1e100, 0.0, 0.0, 0.0, 0.0 } });
  const Bounds around = { 0.9e100, 1.1e100, -1.0, 1.0, -1.0, 1.0 };
  EXPECT_TRUE(region.Touches(point.data()) && region.Touches(around.data())) << "points far apart";
}

}
