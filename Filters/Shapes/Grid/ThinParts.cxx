#include "Grid/ThinParts.h"

#include "Grid/GridSamples.h"
#include "Grid/SurfaceSample.h"

#include "vtkMath.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// Equidistant points along a normal.
struct Way
{
  double Step;
  int Count;
};

Way MakeWay(const SurfaceSample& surface, double thickness)
{
  constexpr double within = 0.99; // tolerance, so that parts of exactly this thickness are not thin
  constexpr double part = 0.25;   // of the detail, to sample its slopes
  constexpr double mostSteps = 256.0;
  const double length = (surface.IsMiddle ? 0.5 : 1.0) * within * thickness;
  const double step = part * std::min(thickness, surface.Detail);
  const double count = std::min(std::ceil(length / step), mostSteps);
  return { length / count, static_cast<int>(count) };
}

// Returns true if the function is positive and rises, within 45 degrees, at a point along the
// normal.
bool LeadsOut(const GridSamples& function, const SurfacePoint& from, double sense, const Way& way)
{
  constexpr double steepest = 0.70710678118654752440; // the cosine of 45 degrees
  for (int i = 1; i <= way.Count; ++i)
  {
    double x[3], gradient[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = from.Place[axis] + sense * (i * way.Step) * from.Normal[axis];
    }
    const double value = function.Evaluate(x, gradient);
    const double rise = sense * vtkMath::Dot(gradient, from.Normal.data());
    if (value > 0.0 && rise > 0.0 && rise >= steepest * vtkMath::Norm(gradient))
    {
      return true;
    }
  }
  return false;
}

}

double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness)
{
  const Way way = MakeWay(surface, thickness);
  const std::vector<SurfacePoint>& points = surface.Points;
  std::vector<char> isThin(points.size());
  constexpr std::size_t grain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), grain),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        isThin[i] =
          LeadsOut(function, points[i], 1.0, way) && LeadsOut(function, points[i], -1.0, way);
      }
    });
  double whole = 0.0, thin = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    whole += points[i].Area;
    thin += isThin[i] ? points[i].Area : 0.0;
  }
  return whole > 0.0 ? thin / whole : 0.0;
}

}
