#include "Simulation/SurfaceStart.h"

#include "Base/Obstacle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

constexpr char CoveredStart[] =
  "The obstacle covers the initial shape (by default the target), or all that the voxels can "
  "resolve of it, so there is no skin; move the obstacle or the shape, reduce VoxelSize, or check "
  "that ObstacleFunction is negative only inside the obstacle.";
constexpr char StartWithoutSurface[] =
  "The initial shape (by default the target) has no surface within the bounds, or none that the "
  "voxels can resolve, so there is no skin; check VoxelSize and ModelBounds and, unless the shape "
  "is InitialFunction or a mesh at input port 1, TargetIsoValue, InvertTarget and "
  "ParticleThreshold.";
constexpr char StartWithoutNumbers[] =
  "The initial shape (by default the target) is not a finite number at any sampled point within "
  "the bounds, so there is no skin; check its values.";

double FindMargin(const SurfaceStart& start)
{
  return start.Box.Present ? 2.0 * start.Domain.VoxelSize : 0.0;
}

// Finds the box to sample. With walls the box is two voxels wider at each end, so that the surface
// can close at the walls.
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

// Subtracts the obstacle. Multiplies the obstacle's depths by the slope of the shape, so that
// linear interpolation along an edge finds the right crossing.
void CutAtObstacle(
  const SurfaceStart& start, std::size_t count, const double* points, double* values)
{
  std::vector<double> depths, near;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; start.Solid && i < count; ++i)
  {
    const double depth = start.Solid->DepthAt(points + 3 * i);
    if (depth > -HUGE_VAL)
    {
      depths.push_back(depth);
      places.push_back(i);
      near.insert(near.end(), points + 3 * i, points + 3 * i + 3);
    }
  }
  std::vector<double> levels(places.size()), slopes(places.size());
  start.Shape.EvaluateLevel(places.size(), near.data(), levels.data(), slopes.data());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    values[places[i]] = std::max(values[places[i]], slopes[i] * depths[i]);
  }
}

// Sets the flags of StartOn, isFinite and hasInside, even if the start evaluates no node.
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
  std::atomic<bool> isFinite{ false };  // true if finite at any point
  std::atomic<bool> hasInside{ false }; // before the obstacle is subtracted
  InitialFunction function;
  function.ThreadSafe = start.Shape.IsThreadSafe() && (!start.Solid || start.Solid->IsThreadSafe());
  function.Evaluate = [&](std::size_t count, const double* points, double* values)
  {
    start.Shape.EvaluateLevel(count, points, values);
    if (!isFinite.load(std::memory_order_relaxed) &&
      std::any_of(values, values + count, [](double value) { return std::isfinite(value); }))
    {
      isFinite.store(true, std::memory_order_relaxed);
    }
    CutAtWalls(start.Box, count, points, values);
    if (std::any_of(values, values + count, [](double value) { return value < 0.0; }))
    {
      hasInside.store(true, std::memory_order_relaxed);
    }
    CutAtObstacle(start, count, points, values);
  };
  if (start.Shape.IsWithinRegions())
  {
    function.ForEachRegion = [&start](const RegionVisitor& visit)
    { start.Shape.ForEachRegion(visit); };
  }
  if (!start.Solid) // the faces of an obstacle are not on the surface of the shape
  {
    function.Surface = start.Shape.FindSurface();
    function.Surface.DepthOfWalls = FindMargin(start);
  }
  double bounds[6];
  FindBounds(start, bounds);
  if (!band.Start(0.0, bounds, function, progress))
  {
    return false;
  }
  // Sharpens the edge between shape and wall or obstacle: the distances of the start have rounded
  // this edge by a few hundredths of a voxel.
  if (start.Box.Present || start.Solid)
  {
    band.Confine(start.Box, start.Solid);
  }
  if (band.IsEmpty())
  {
    const bool isCovered = start.Solid && hasInside;
    if (!isCovered)
    {
      EvaluateAtCorners(function, bounds); // without a surface the function may be unevaluated
    }
    messages.Say("empty",
      isCovered    ? CoveredStart
        : isFinite ? StartWithoutSurface
                   : StartWithoutNumbers);
  }
  return true;
}

}
