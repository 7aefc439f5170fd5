#include "Targets/ParticleFrame.h"

#include "Targets/ParticleOrder.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkOctreePointLocator.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

// The array as numbers, so many for each point, or null if there is none.
vtkDataArray* AsNumbers(
  vtkAbstractArray* array, vtkIdType points, const char* what, int components = 1)
{
  if (!array)
  {
    return nullptr;
  }
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers || numbers->GetNumberOfComponents() != components ||
    numbers->GetNumberOfTuples() != points)
  {
    throw std::invalid_argument(std::string("The array \"") +
      (array->GetName() ? array->GetName() : "") + "\" cannot give the particles' " + what +
      ": it has to hold " + (components == 1 ? "one number" : "three numbers") +
      " for each point.");
  }
  return numbers;
}

std::vector<std::int64_t> ReadIds(vtkDataArray* array)
{
  constexpr double exact = 9007199254740992.0; // 2^53
  const vtkIdType count = array->GetNumberOfTuples();
  const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  for (vtkIdType i = 0; i < count && isReal; ++i)
  {
    const double value = array->GetComponent(i, 0);
    if (!(std::fabs(value) <= exact) || value != std::floor(value))
    {
      throw std::invalid_argument(std::string("The array \"") +
        (array->GetName() ? array->GetName() : "") +
        "\" cannot give the particles' ids: they have to be integers.");
    }
  }
  vtkNew<vtkTypeInt64Array> ids;
  ids->DeepCopy(array);
  return { ids->GetPointer(0), ids->GetPointer(0) + count };
}

template <class Value>
void Permute(const std::vector<std::size_t>& order, std::vector<Value>& values)
{
  std::vector<Value> sorted;
  sorted.reserve(values.size());
  for (const std::size_t place : order)
  {
    sorted.push_back(values[place]);
  }
  values.swap(sorted);
}

// Ids and points go with the particles.
void Sort(ParticleFrame& frame)
{
  const std::vector<std::size_t> order =
    FindParticleOrder(frame.Particles, frame.HasIds ? &frame.Ids : nullptr);
  if (!order.empty())
  {
    Permute(order, frame.Particles);
    Permute(order, frame.Ids);
    Permute(order, frame.Points);
  }
}

// One that is not finite counts as unknown, NaN.
void KeepVelocities(vtkDataArray* velocities, ParticleFrame& frame)
{
  if (velocities)
  {
    frame.Velocities.resize(3 * frame.Points.size());
    for (std::size_t i = 0; i < frame.Points.size(); ++i)
    {
      velocities->GetTuple(frame.Points[i], frame.Velocities.data() + 3 * i);
    }
  }
}

// Copies: what comes through the input may be written over by the next step. Arrays without a value
// for each point are left out.
void KeepArrays(vtkPointData* arrays, vtkIdType count, ParticleFrame& frame)
{
  if (!arrays)
  {
    return;
  }
  frame.Passed = vtkSmartPointer<vtkPointData>::New();
  frame.Passed->DeepCopy(arrays);
  for (int i = frame.Passed->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (frame.Passed->GetAbstractArray(i)->GetNumberOfTuples() != count)
    {
      frame.Passed->RemoveArray(i);
    }
  }
}

double FindMedian(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Where most particles are, and half of how far from there; halves, as whole differences overflow.
struct Middle
{
  double At[3];
  double HalfSize = 0.0;
};

Middle FindMiddle(const std::vector<SkeletonVertex>& particles)
{
  Middle middle;
  double farthest = 0.0;
  std::vector<double> values(particles.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    double& at = middle.At[axis];
    std::transform(particles.begin(), particles.end(), values.begin(),
      [axis](const SkeletonVertex& particle) { return particle.Position[axis]; });
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

// A tree, whose leaves stay small however far strays are. It calculates in single precision: so
// around where most particles are, and in units of how far they are from there.
vtkSmartPointer<vtkOctreePointLocator> MakeLocator(const std::vector<SkeletonVertex>& particles)
{
  constexpr double farAway = 1e15; // the square of which is finite
  const Middle middle = FindMiddle(particles);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(particles.size()));
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    double x[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double from = 0.5 * particles[i].Position[axis] - 0.5 * middle.At[axis];
      x[axis] = std::min(std::max(from / middle.HalfSize, -farAway), farAway);
    }
    points->SetPoint(static_cast<vtkIdType>(i), x);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  auto locator = vtkSmartPointer<vtkOctreePointLocator>::New();
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  return locator;
}

// Distance of a particle to its third nearest. More are looked at, as the locator cannot tell which
// of those of a lattice are nearest.
double FindThirdNearest(
  const std::vector<SkeletonVertex>& particles, vtkOctreePointLocator* locator, std::size_t i)
{
  constexpr std::size_t looked = 17, third = 3; // the particle itself is one
  vtkNew<vtkIdList> nearest;
  double x[3];
  locator->GetDataSet()->GetPoint(static_cast<vtkIdType>(i), x);
  locator->FindClosestNPoints(static_cast<int>(std::min(looked, particles.size())), x, nearest);
  std::vector<double> distances;
  for (vtkIdType k = 0; k < nearest->GetNumberOfIds(); ++k)
  {
    const double* from = particles[i].Position;
    const double* to = particles[static_cast<std::size_t>(nearest->GetId(k))].Position;
    distances.push_back(std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]));
  }
  std::sort(distances.begin(), distances.end());
  return distances.empty() ? 0.0 : distances[std::min(third, distances.size() - 1)];
}

}

void ParticleFrame::FindFits(const FitOptions& options, Agreement* ranks)
{
  if (ranks && !ranks->IsAlone())
  {
    this->Shared = std::make_shared<SharedFits>(*ranks, options, this->Particles);
  }
  else
  {
    this->Fits = FitParticles(options, this->Particles);
  }
}

void ParticleFrame::GiveRadius(double radius)
{
  for (SkeletonVertex& particle : this->Particles)
  {
    particle.Radius = radius;
  }
}

bool ParticleFrame::GetBounds(double bounds[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = HUGE_VAL;
    bounds[2 * axis + 1] = -HUGE_VAL;
    for (const SkeletonVertex& particle : this->Particles)
    {
      const double x = particle.Position[axis];
      bounds[2 * axis] = std::min(bounds[2 * axis], x - particle.Radius);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], x + particle.Radius);
    }
  }
  return !this->Particles.empty();
}

double ParticleFrame::GetSpacing() const
{
  constexpr std::size_t samples = 1000;
  if (this->Particles.size() < 2)
  {
    return 0.0;
  }
  const vtkSmartPointer<vtkOctreePointLocator> locator = MakeLocator(this->Particles);
  std::vector<double> distances;
  const std::size_t stride = std::max<std::size_t>(1, this->Particles.size() / samples);
  for (std::size_t i = 0; i < this->Particles.size(); i += stride)
  {
    const double distance = FindThirdNearest(this->Particles, locator, i);
    if (distance > 0.0)
    {
      distances.push_back(distance);
    }
  }
  return distances.empty() ? 0.0 : FindMedian(distances);
}

ParticleFrame ReadParticles(vtkPointSet* points, const PointArrays& arrays)
{
  const vtkIdType count = points->GetNumberOfPoints();
  vtkDataArray* radii = AsNumbers(arrays.Radii, count, "radii");
  vtkDataArray* ids = AsNumbers(arrays.Ids, count, "ids");
  vtkDataArray* strengths = AsNumbers(arrays.Strengths, count, "strengths");
  const std::vector<std::int64_t> allIds = ids ? ReadIds(ids) : std::vector<std::int64_t>();

  ParticleFrame frame;
  frame.HasRadii = radii != nullptr;
  frame.HasIds = ids != nullptr;
  frame.Particles.reserve(count);
  frame.Ids.reserve(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    SkeletonVertex particle;
    points->GetPoint(i, particle.Position);
    particle.Radius = radii ? radii->GetComponent(i, 0) : 1.0;
    particle.Strength = strengths ? strengths->GetComponent(i, 0) : 1.0;
    if (!particle.IsUsable())
    {
      ++frame.Ignored;
      continue;
    }
    frame.Particles.push_back(particle);
    frame.Ids.push_back(ids ? allIds[i] : i);
    frame.Points.push_back(i);
  }
  Sort(frame);
  KeepVelocities(AsNumbers(arrays.Velocities, count, "velocities", 3), frame);
  KeepArrays(arrays.Passed, count, frame);
  if (!frame.Passed)
  {
    frame.Points = {};
  }
  return frame;
}

}
