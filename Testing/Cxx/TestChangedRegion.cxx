// The region in which particles have changed: nothing of it is missed, and little besides is in it.

#include "Targets/ChangedRegion.h"
#include "Check.h"
#include "RandomShapes.h"

#include <algorithm>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{
using Bounds = ChangedRegion::Box;

// Within +-size along x and y, and a tenth of that along z.
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

// With room between them, or less than none.
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

// Cells are half as wide as the boxes in the mean, or wider where more than 64 would be needed.
void BoxesAreFoundAndLittleElse(Check& check)
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
    check.Less(10, near, "boxes that touch, " + name);
    check.Less(count < 400 ? 1000 : 0, far, "boxes that are far away, " + name);
    check.Equal(missed, 0, "of those that touch, missed, " + name);
    check.Equal(wrong, 0, "of those that are far away, found, " + name);
  }
}

void NothingAndEverything(Check& check)
{
  const Bounds box = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  ChangedRegion region;
  check.True(region.Touches(box.data()), "before anything is known all may have changed");
  region.Set({});
  check.True(!region.Touches(box.data()), "no boxes");
  region.SetEverywhere();
  check.True(region.Touches(box.data()), "everywhere");
}

// Faces that meet touch; so does a box without extent, and one of an absurd place or size.
void EdgesOfTheRange(Check& check)
{
  ChangedRegion region;
  region.Set({ { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }, { 5.0, 6.0, 0.0, 1.0, 0.0, 1.0 } });
  const Bounds meets = { 6.0, 7.0, 0.0, 1.0, 0.0, 1.0 }, between = { 3.0, 3.1, 0.0, 1.0, 0.0, 1.0 };
  check.True(region.Touches(meets.data()), "faces that meet");
  check.True(!region.Touches(between.data()), "between two boxes");

  const Bounds point = { 1e100, 1e100, 0.0, 0.0, 0.0, 0.0 };
  region.Set({ point, { -1e100, -1e100, 0.0, 0.0, 0.0, 0.0 } });
  const Bounds around = { 0.9e100, 1.1e100, -1.0, 1.0, -1.0, 1.0 };
  check.True(region.Touches(point.data()) && region.Touches(around.data()), "points far apart");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "BoxesAreFoundAndLittleElse", BoxesAreFoundAndLittleElse },
      { "NothingAndEverything", NothingAndEverything }, { "EdgesOfTheRange", EdgesOfTheRange } });
}
