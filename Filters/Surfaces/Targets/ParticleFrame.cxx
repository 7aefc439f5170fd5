#include "Targets/ParticleFrame.h"

#include "Targets/ParticleOrder.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
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
    frame.HasVelocities = true;
    frame.Velocities.resize(frame.Points.size());
    for (std::size_t i = 0; i < frame.Points.size(); ++i)
    {
      velocities->GetTuple(frame.Points[i], frame.Velocities[i].data());
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

}

void ParticleFrame::FindFits(const FitOptions& options) const
{
  if (!this->HasFits)
  {
    this->Fits = FitParticles(options, this->Particles);
    this->HasFits = true;
  }
}

void ParticleFrame::GiveRadius(double radius)
{
  for (SkeletonVertex& particle : this->Particles)
  {
    particle.Radius = radius;
  }
}

void ParticleFrame::UseRadii(double reachPerRadius)
{
  if (reachPerRadius == this->ReachPerRadius)
  {
    return;
  }
  for (SkeletonVertex& particle : this->Particles)
  {
    particle.Radius *= reachPerRadius / this->ReachPerRadius;
  }
  this->ReachPerRadius = reachPerRadius;
  this->HasFits = false;
}

void ParticleFrame::MoveBy(const double offset[3])
{
  for (SkeletonVertex& particle : this->Particles)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      particle.Position[axis] += offset[axis];
    }
  }
  this->HasFits = false;
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
