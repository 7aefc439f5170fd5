#include "Frames/ParticleFrame.h"

#include "Frames/ParticleOrder.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace activesurface
{

namespace
{

// Returns the array as a vtkDataArray; null if `array` is null. Throws unless the array has the
// given number of components and one tuple for each point.
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
      (array->GetName() ? array->GetName() : "") + "\" cannot be used as the particles' " + what +
      ", which need " + (components == 1 ? "one number" : "three numbers") +
      " for each point; choose another array.");
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
        "\" cannot be used as the particles' ids, which have to be integers (in arrays of "
        "floats within +-2^53); choose another array.");
    }
  }
  vtkNew<vtkTypeInt64Array> ids;
  ids->DeepCopy(array);
  return { ids->GetPointer(0), ids->GetPointer(0) + count };
}

bool IsSingle(vtkPointSet* points)
{
  return points->GetPoints() && points->GetPoints()->GetDataType() == VTK_FLOAT;
}

// Sets the particle ids. ids: an id for each point; if empty, the point index is the id. Empties
// Points if no point is ignored.
void SetIds(std::vector<std::int64_t> ids, ParticleFrame& frame)
{
  if (frame.Ignored == 0)
  {
    frame.Points = {};
  }
  if (!ids.empty() && frame.Ignored == 0)
  {
    frame.Ids = std::move(ids);
    return;
  }
  frame.Ids.reserve(frame.Particles.size());
  for (std::size_t i = 0; i < frame.Particles.size(); ++i)
  {
    const vtkIdType point = frame.GetPoint(i);
    frame.Ids.push_back(ids.empty() ? point : ids[static_cast<std::size_t>(point)]);
  }
}

// Sorts particles, ids and points by FindParticleOrder.
void Sort(ParticleFrame& frame)
{
  const std::vector<std::size_t> order =
    FindParticleOrder(frame.Particles, frame.HasIds ? &frame.Ids : nullptr);
  if (order.empty())
  {
    return;
  }
  if (frame.Points.empty())
  {
    frame.Points.assign(order.begin(), order.end());
  }
  else
  {
    ParticleList::PermuteList(order, frame.Points);
  }
  frame.Permute(order);
}

// Copies the velocities of the particles. Values that are not finite are kept, and mean that a
// velocity is unavailable.
void KeepVelocities(vtkDataArray* velocities, ParticleFrame& frame)
{
  if (velocities)
  {
    frame.HasVelocities = true;
    frame.Velocities.resize(frame.Particles.size());
    for (std::size_t i = 0; i < frame.Particles.size(); ++i)
    {
      velocities->GetTuple(frame.GetPoint(i), frame.Velocities[i].data());
    }
  }
}

// Copies the arrays that have one tuple for each point. A copy is needed because the next step may
// overwrite the input's arrays.
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

}

void ParticleFrame::Permute(const std::vector<std::size_t>& order)
{
  this->Particles.Permute(order);
  ParticleList::PermuteList(order, this->Ids);
  ParticleList::PermuteList(order, this->Velocities);
}

void ParticleFrame::GiveRadius(double radius)
{
  this->Particles.SetRadius(radius);
}

void ParticleFrame::UseRadii(double reachPerRadius)
{
  if (reachPerRadius == this->ReachPerRadius)
  {
    return;
  }
  this->Particles.ScaleRadii(reachPerRadius / this->ReachPerRadius);
  this->ReachPerRadius = reachPerRadius;
}

void ParticleFrame::MoveBy(const double offset[3])
{
  this->Particles.MoveBy(offset);
  for (int axis = 0; this->Whole && axis < 3; ++axis)
  {
    this->Whole->Low[axis] += offset[axis];
    this->Whole->High[axis] += offset[axis];
  }
}

WholeFrame ParticleFrame::Describe() const
{
  WholeFrame whole;
  whole.Particles = this->Particles.size();
  for (const SkeletonVertex& particle : this->Particles)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      whole.Low[axis] = std::min(whole.Low[axis], particle.Position[axis]);
      whole.High[axis] = std::max(whole.High[axis], particle.Position[axis]);
    }
  }
  return whole;
}

bool ParticleFrame::GetBounds(double bounds[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = HUGE_VAL;
    bounds[2 * axis + 1] = -HUGE_VAL;
  }
  if (this->Whole)
  {
    const double radius = this->Particles.GetCommonRadius();
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = this->Whole->Low[axis] - radius;
      bounds[2 * axis + 1] = this->Whole->High[axis] + radius;
    }
    return this->Whole->Particles > 0;
  }
  for (const SkeletonVertex& particle : this->Particles)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = particle.Position[axis];
      bounds[2 * axis] = std::min(bounds[2 * axis], x - particle.Radius);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], x + particle.Radius);
    }
  }
  return !this->Particles.empty();
}

ParticleFrame ReadParticles(vtkPointSet* points, const PointArrays& arrays)
{
  const vtkIdType count = points->GetNumberOfPoints();
  vtkDataArray* radii = AsNumbers(arrays.Radii, count, "radii");
  vtkDataArray* ids = AsNumbers(arrays.Ids, count, "ids");
  vtkDataArray* strengths = AsNumbers(arrays.Strengths, count, "strengths");
  std::vector<std::int64_t> allIds = ids ? ReadIds(ids) : std::vector<std::int64_t>();

  ParticleFrame frame;
  frame.HasRadii = radii != nullptr;
  frame.HasIds = ids != nullptr;
  frame.Particles.Reserve(static_cast<std::size_t>(count), IsSingle(points));
  for (vtkIdType i = 0; i < count; ++i)
  {
    SkeletonVertex particle;
    points->GetPoint(i, particle.Position);
    particle.Radius = radii ? radii->GetComponent(i, 0) : 1.0;
    particle.Strength = strengths ? strengths->GetComponent(i, 0) : 1.0;
    if (particle.IsUsable())
    {
      frame.Particles.Add(particle);
      frame.Points.push_back(i);
    }
  }
  frame.Ignored = static_cast<std::size_t>(count) - frame.Particles.size();
  SetIds(std::move(allIds), frame);
  Sort(frame);
  KeepVelocities(AsNumbers(arrays.Velocities, count, "velocities", 3), frame);
  KeepArrays(arrays.Passed, count, frame);
  return frame;
}

}
