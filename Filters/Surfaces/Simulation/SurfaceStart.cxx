#include "Simulation/SurfaceStart.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace activesurface
{

namespace
{

double FindMargin(const SurfaceStart& start)
{
  return start.Box.Present ? 2.0 * start.Domain.VoxelSize : 0.0;
}

// The box to sample: within walls so wide that the surface can close on them.
void FindBounds(const SurfaceStart& start, double bounds[6])
{
  const double margin = FindMargin(start);
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = start.Domain.Bounds[2 * axis] - margin;
    bounds[2 * axis + 1] = start.Domain.Bounds[2 * axis + 1] + margin;
  }
}

void CutAtWalls(const Walls& box, std::size_t count, const double* points, double* values)
{
  for (std::size_t i = 0; box.Present && i < count; ++i)
  {
    values[i] = std::max(values[i], DistanceToWalls(box, points + 3 * i));
  }
}

void EvaluateAtCorners(const InitialFunction& function, const double bounds[6])
{
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[3], value;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = bounds[2 * axis + (corner >> axis & 1)];
    }
    function.Evaluate(1, point, &value);
  }
}

}

bool StartOn(
  NarrowBand& band, const SurfaceStart& start, Warnings& messages, const ProgressFunction& progress)
{
  std::atomic<bool> isFinite{ false }; // anywhere
  InitialFunction function;
  function.ThreadSafe = start.Shape.IsThreadSafe();
  function.Evaluate = [&start, &isFinite](std::size_t count, const double* points, double* values)
  {
    start.Shape.EvaluateLevel(count, points, values);
    if (!isFinite.load(std::memory_order_relaxed) &&
      std::any_of(values, values + count, [](double value) { return std::isfinite(value); }))
    {
      isFinite.store(true, std::memory_order_relaxed);
    }
    CutAtWalls(start.Box, count, points, values);
  };
  if (start.Shape.IsWithinRegions())
  {
    function.ForEachRegion = [&start](const RegionVisitor& visit)
    { start.Shape.ForEachRegion(visit); };
  }
  function.Surface = start.Shape.FindSurface();
  function.Surface.DepthOfWalls = FindMargin(start);
  double bounds[6];
  FindBounds(start, bounds);
  if (!band.Start(0.0, bounds, function, progress))
  {
    return false;
  }
  // The rim of shape and wall is round in the distances of the start, by a few hundredths of a
  // voxel.
  if (start.Box.Present)
  {
    band.Confine(start.Box);
  }
  if (band.IsEmpty())
  {
    EvaluateAtCorners(function, bounds); // where nothing was, as there is no surface
    messages.Say("empty",
      isFinite ? "The initial shape has no surface within the bounds, so there is no skin; check "
                 "ModelBounds, TargetIsoValue and whether VoxelSize is small enough."
               : "The initial shape is not a finite number anywhere within the bounds, so there is "
                 "no skin; check the initial shape, or the target where there is none.");
  }
  return true;
}

}
