#include "ParticleFrame.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

// The array as numbers, one for each point, or null if there is none.
vtkDataArray* AsNumbers(vtkAbstractArray* array, vtkIdType points, const char* what)
{
  if (!array)
  {
    return nullptr;
  }
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers || numbers->GetNumberOfComponents() != 1 || numbers->GetNumberOfTuples() != points)
  {
    throw std::invalid_argument(std::string("The array \"") +
      (array->GetName() ? array->GetName() : "") + "\" cannot give the particles' " + what +
      ": it has to hold one number for each point.");
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

// Indices of the particles, by ascending id; equal ids stay in order.
std::vector<std::size_t> SortByIds(const std::vector<std::int64_t>& ids)
{
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(
    order.begin(), order.end(), [&ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return order;
}

void MatchIds(const std::vector<std::int64_t>& earlier, const std::vector<std::int64_t>& later,
  std::vector<std::size_t>& partners)
{
  const std::vector<std::size_t> from = SortByIds(earlier);
  const std::vector<std::size_t> to = SortByIds(later);
  auto candidate = to.begin();
  for (const std::size_t particle : from)
  {
    while (candidate != to.end() && later[*candidate] < earlier[particle])
    {
      ++candidate;
    }
    if (candidate != to.end() && later[*candidate] == earlier[particle])
    {
      partners[particle] = *candidate++;
    }
  }
}

// The later particles that are nobody's partner.
std::vector<std::size_t> FindBirths(const std::vector<std::size_t>& partners, std::size_t later)
{
  std::vector<bool> isPartner(later, false);
  for (const std::size_t partner : partners)
  {
    if (partner != ParticleMatches::NoPartner)
    {
      isPartner[partner] = true;
    }
  }
  std::vector<std::size_t> births;
  for (std::size_t i = 0; i < later; ++i)
  {
    if (!isPartner[i])
    {
      births.push_back(i);
    }
  }
  return births;
}

double Between(double a, double b, double fraction)
{
  return a + fraction * (b - a);
}

void MoveTowards(SkeletonVertex& particle, const SkeletonVertex& partner, double fraction)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    particle.Position[axis] = Between(particle.Position[axis], partner.Position[axis], fraction);
  }
  const double radius = Between(particle.Radius, partner.Radius, fraction);
  particle.Radius = radius > 0.0 ? radius : partner.Radius; // which rounding may have swallowed
  particle.Strength = Between(particle.Strength, partner.Strength, fraction);
}

void AddFaded(const SkeletonVertex& particle, double share, std::vector<SkeletonVertex>& particles)
{
  if (share * particle.Strength != 0.0)
  {
    particles.push_back(particle);
    particles.back().Strength *= share;
  }
}

}

void ParticleFrame::GiveRadius(double radius)
{
  for (SkeletonVertex& particle : this->Particles)
  {
    particle.Radius = radius;
  }
  this->HasRadii = true;
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
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const SkeletonVertex& particle : this->Particles)
  {
    points->InsertNextPoint(particle.Position);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();

  std::vector<double> distances;
  vtkNew<vtkIdList> nearest;
  const std::size_t stride = std::max<std::size_t>(1, this->Particles.size() / samples);
  for (std::size_t i = 0; i < this->Particles.size() && this->Particles.size() > 1; i += stride)
  {
    const double* x = this->Particles[i].Position;
    locator->FindClosestNPoints(2, x, nearest);
    double distance = 0.0;
    for (vtkIdType k = 0; k < nearest->GetNumberOfIds(); ++k)
    {
      const double* other = this->Particles[nearest->GetId(k)].Position;
      distance = std::max(distance, std::hypot(x[0] - other[0], x[1] - other[1], x[2] - other[2]));
    }
    if (distance > 0.0)
    {
      distances.push_back(distance);
    }
  }
  const auto middle = distances.begin() + distances.size() / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return distances.empty() ? 0.0 : *middle;
}

ParticleFrame ReadParticles(vtkPointSet* points, const ParticleArrays& arrays)
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
  }
  return frame;
}

ParticleMatches MatchParticles(const ParticleFrame& earlier, const ParticleFrame& later)
{
  const bool sameCount =
    earlier.Particles.size() + earlier.Ignored == later.Particles.size() + later.Ignored;
  ParticleMatches matches;
  matches.Partners.assign(earlier.Particles.size(), ParticleMatches::NoPartner);
  if (earlier.HasIds == later.HasIds && (earlier.HasIds || sameCount))
  {
    MatchIds(earlier.Ids, later.Ids, matches.Partners);
  }
  matches.Births = FindBirths(matches.Partners, later.Particles.size());
  return matches;
}

void InterpolateParticles(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, double fraction, std::vector<SkeletonVertex>& particles)
{
  particles.clear();
  for (std::size_t i = 0; i < earlier.Particles.size(); ++i)
  {
    if (matches.Partners[i] == ParticleMatches::NoPartner)
    {
      AddFaded(earlier.Particles[i], 1.0 - fraction, particles);
      continue;
    }
    particles.push_back(earlier.Particles[i]);
    MoveTowards(particles.back(), later.Particles[matches.Partners[i]], fraction);
  }
  for (const std::size_t birth : matches.Births)
  {
    AddFaded(later.Particles[birth], fraction, particles);
  }
}

}
