#include "Frames/ParticleSpacing.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkOctreePointLocator.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

namespace
{

double FindMedian(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Point of the median coordinates. HalfSize is half of the median distance of the particles from
// this point, along the axis where this median is largest. If the median is 0, HalfSize is half of
// the largest distance along an axis; if all particles coincide, 1. Distances are halved because
// full differences may overflow.
struct Middle
{
  double At[3];
  double HalfSize = 0.0;
};

Middle FindMiddle(const ParticleList& particles)
{
  Middle middle;
  double farthest = 0.0;
  std::vector<double> values(particles.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    double& at = middle.At[axis];
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = particles[i].Position[axis];
    }
    at = FindMedian(values);
    std::transform(values.begin(), values.end(), values.begin(),
      [at](double x) { return std::fabs(0.5 * x - 0.5 * at); });
    farthest = std::max(farthest, *std::max_element(values.begin(), values.end()));
    middle.HalfSize = std::max(middle.HalfSize, FindMedian(values));
  }
  const double inOnePlace = farthest > 0.0 ? farthest : 1.0;
  middle.HalfSize = middle.HalfSize > 0.0 ? middle.HalfSize : inOnePlace;
  return middle;
}

constexpr std::size_t Samples = 1000;

// Number of nearest points to find: the particle itself and three neighbours.
constexpr std::size_t Nearest = 4;
using Distances = std::array<double, Nearest>; // ascending; HUGE_VAL if there is no such particle

// Search tree of the particles. The leaves of an octree stay small even if a few particles are far
// away. The tree uses single precision, so its coordinates are relative to Middle::At, in units of
// twice Middle::HalfSize.
class Neighbourhoods
{
public:
  explicit Neighbourhoods(const ParticleList& particles)
    : Particles(particles)
    , Centre(FindMiddle(particles))
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(particles.size()));
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), this->ToTree(particles[i].Position).data());
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    this->Tree->SetDataSet(cloud);
    this->Tree->BuildLocator();
  }

  // Returns the Nearest smallest distances. Searches more candidates, because of single precision:
  // the tree cannot rank nearly equal distances, as in a lattice.
  Distances FindNearest(const double from[3]) const
  {
    constexpr std::size_t looked = 17;
    vtkNew<vtkIdList> nearest;
    this->Tree->FindClosestNPoints(static_cast<int>(std::min(looked, this->Particles.size())),
      this->ToTree(from).data(), nearest);
    std::vector<double> distances(Nearest, HUGE_VAL);
    for (vtkIdType k = 0; k < nearest->GetNumberOfIds(); ++k)
    {
      const SkeletonVertex to = this->Particles[static_cast<std::size_t>(nearest->GetId(k))];
      distances.push_back(
        std::hypot(to.Position[0] - from[0], to.Position[1] - from[1], to.Position[2] - from[2]));
    }
    std::sort(distances.begin(), distances.end());
    Distances least;
    std::copy_n(distances.begin(), Nearest, least.begin());
    return least;
  }

private:
  std::array<double, 3> ToTree(const double x[3]) const
  {
    constexpr double farAway = 1e15; // its square is finite in single precision
    std::array<double, 3> place;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double from = 0.5 * x[axis] - 0.5 * this->Centre.At[axis];
      place[axis] = std::min(std::max(from / this->Centre.HalfSize, -farAway), farAway);
    }
    return place;
  }

  const ParticleList& Particles;
  const Middle Centre;
  vtkNew<vtkOctreePointLocator> Tree;
};

// Selects 1,000 to 2,000 particles, or all if there are fewer.
std::vector<SkeletonVertex> PickSamples(const ParticleList& particles)
{
  const std::size_t stride = std::max<std::size_t>(1, particles.size() / Samples);
  std::vector<SkeletonVertex> samples;
  for (std::size_t i = 0; i < particles.size(); i += stride)
  {
    samples.push_back(particles[i]);
  }
  return samples;
}

// Returns the median of valueOf(particle, distance to its third nearest neighbour) over the sample;
// see FindSpacing.
template <class Function>
double FindMedianOf(const ParticleFrame& frame, const Function& valueOf)
{
  const std::size_t count = frame.Particles.size();
  if (count < 2)
  {
    return 0.0;
  }
  const Neighbourhoods near(frame.Particles);
  std::vector<double> values;
  for (const SkeletonVertex& sample : PickSamples(frame.Particles))
  {
    const double distance = near.FindNearest(sample.Position)[std::min(Nearest, count) - 1];
    if (distance > 0.0)
    {
      values.push_back(valueOf(sample, distance));
    }
  }
  return values.empty() ? 0.0 : FindMedian(values);
}

}

double FindMedianRadius(const ParticleFrame& frame)
{
  std::vector<double> radii;
  for (const SkeletonVertex& sample : PickSamples(frame.Particles))
  {
    radii.push_back(sample.Radius);
  }
  return FindMedian(radii);
}

double FindSpacing(const ParticleFrame& frame)
{
  return FindMedianOf(frame, [](const SkeletonVertex&, double distance) { return distance; });
}

double FindOverlap(const ParticleFrame& frame)
{
  return FindMedianOf(frame,
    [&frame](const SkeletonVertex& particle, double distance)
    { return 2.0 * particle.Radius / frame.ReachPerRadius / distance; });
}

}
