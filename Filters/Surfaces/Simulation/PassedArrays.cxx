#include "Simulation/PassedArrays.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace activesurface
{

namespace
{

constexpr std::size_t Grain = 1024;

// An array of the particles; the array is averaged on the skin.
struct Column
{
  std::size_t Components = 1;
  std::vector<double> Values;         // of the particles
  vtkSmartPointer<vtkDataArray> Name; // empty; has the name and type of the result
  std::vector<double> Averages;       // of the skin's points
};

using Columns = std::vector<Column>;

struct PlacedParticles
{
  explicit PlacedParticles(const ParticleTrack& track)
    : Track(track)
  {
    track.List(this->Particles, this->Origins);
  }
  const ParticleTrack& Track;
  std::vector<SkeletonVertex> Particles;
  std::vector<ParticleOrigin> Origins; // of the particles
};

// Returns true for VTK's type of colours, RGB or RGBA.
bool IsColor(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  return array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4);
}

bool IsAveraged(vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE || IsColor(array);
}

vtkPointData* FindArrays(const ParticleFrame* frame)
{
  return frame ? frame->Passed.Get() : nullptr;
}

// An array at both steps around a time; null at a step that is not used.
struct Pair
{
  vtkAbstractArray* Earlier = nullptr;
  vtkAbstractArray* Later = nullptr;

  vtkAbstractArray* Get() const { return this->Earlier ? this->Earlier : this->Later; }

  bool IsAlike() const
  {
    return !this->Earlier || !this->Later ||
      (this->Earlier->GetDataType() == this->Later->GetDataType() &&
        this->Earlier->GetNumberOfComponents() == this->Later->GetNumberOfComponents());
  }
};

bool Has(const ParticleFrame* frame)
{
  return frame && !frame->Particles.empty();
}

// Returns an empty pair for an array that cannot be passed.
Pair FindPair(const PlacedParticles& particles, const char* name)
{
  const bool wantsEarlier =
    particles.Track.GetFraction() < 1.0 && Has(&particles.Track.GetEarlier());
  const bool wantsLater = particles.Track.GetFraction() > 0.0 && Has(particles.Track.GetLater());
  Pair pair;
  pair.Earlier =
    wantsEarlier ? FindArrays(&particles.Track.GetEarlier())->GetAbstractArray(name) : nullptr;
  pair.Later =
    wantsLater ? FindArrays(particles.Track.GetLater())->GetAbstractArray(name) : nullptr;
  const bool isMissing = (wantsEarlier && !pair.Earlier) || (wantsLater && !pair.Later);
  return isMissing || !pair.IsAlike() ? Pair() : pair;
}

// The tuple of a particle at the nearer of the two steps, or at the only step that contains the
// particle.
struct Place
{
  vtkAbstractArray* Array;
  vtkIdType Tuple;
};

Place FindPlace(const PlacedParticles& particles, const Pair& pair, std::size_t particle)
{
  const ParticleOrigin& origin = particles.Origins[particle];
  const bool isLater = pair.Later && origin.Later != NoPartner &&
    (!pair.Earlier || origin.Earlier == NoPartner || particles.Track.GetFraction() >= 0.5);
  return isLater ? Place{ pair.Later, particles.Track.GetLater()->GetPoint(origin.Later) }
                 : Place{ pair.Earlier, particles.Track.GetEarlier().GetPoint(origin.Earlier) };
}

Column MakeColumn(const PlacedParticles& particles, const Pair& pair)
{
  auto earlier = vtkDataArray::SafeDownCast(pair.Earlier);
  auto later = vtkDataArray::SafeDownCast(pair.Later);
  Column column;
  column.Components = static_cast<std::size_t>(pair.Get()->GetNumberOfComponents());
  column.Name.TakeReference(vtkDataArray::CreateDataArray(pair.Get()->GetDataType()));
  column.Name->SetName(pair.Get()->GetName());
  for (std::size_t i = 0; i < particles.Particles.size(); ++i)
  {
    const ParticleOrigin& origin = particles.Origins[i];
    for (int c = 0; c < static_cast<int>(column.Components); ++c)
    {
      const bool isEarlier = earlier && origin.Earlier != NoPartner;
      const bool isLater = later && origin.Later != NoPartner;
      column.Values.push_back(particles.Track.Interpolate(isEarlier
          ? earlier->GetComponent(particles.Track.GetEarlier().GetPoint(origin.Earlier), c)
          : 0.0,
        isLater ? later->GetComponent(particles.Track.GetLater()->GetPoint(origin.Later), c) : 0.0,
        origin));
    }
  }
  return column;
}

// Components x, y, z of each particle's velocity, and 1; all are 0 if the velocity is unknown.
Column MakeVelocityColumn(const std::vector<double>& velocities)
{
  Column column;
  column.Components = 4;
  for (std::size_t i = 0; i < velocities.size(); i += 3)
  {
    const double* v = velocities.data() + i;
    const bool isKnown = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      column.Values.push_back(isKnown ? v[axis] : 0.0);
    }
    column.Values.push_back(isKnown ? 1.0 : 0.0);
  }
  return column;
}

// Weights of the particles at a point: the absolute contributions of their kernels, normalized to a
// sum of 1. Outside of all kernels, as on a skin that lags behind, the nearest particle has weight
// 1.
class ParticleWeights
{
public:
  // particles: at least one.
  ParticleWeights(const std::vector<SkeletonVertex>& particles, SkeletonKernel kernel)
    : Kernel(kernel)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(particles.size()));
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), particles[i].Position);
      this->Elements.AddPoint(particles[i]);
    }
    this->Elements.Build();
    this->Cloud->SetPoints(points);
    this->Locator->SetDataSet(this->Cloud);
    this->Locator->BuildLocator();
  }

  // Replaces the contents of `weights` by at least one weight, in ascending order of particles.
  // Thread-safe.
  void Find(const double x[3], std::vector<SkeletonWeight>& weights) const
  {
    this->Elements.FindWeights(this->Kernel, x, weights);
    double sum = 0.0;
    for (SkeletonWeight& weight : weights)
    {
      weight.Weight = std::fabs(weight.Weight);
      sum += weight.Weight;
    }
    if (!(sum > 0.0))
    {
      const vtkIdType nearest =
        const_cast<vtkStaticPointLocator*>(this->Locator.Get())->FindClosestPoint(x);
      weights.assign(1, { static_cast<std::uint32_t>(nearest), 1.0 });
      return;
    }
    for (SkeletonWeight& weight : weights)
    {
      weight.Weight /= sum;
    }
  }

private:
  const SkeletonKernel Kernel;
  Skeleton Elements;
  vtkNew<vtkPolyData> Cloud;
  vtkNew<vtkStaticPointLocator> Locator;
};

// Averages the columns at the points of the skin. Returns the particle of the largest weight for
// each point.
std::vector<vtkIdType> Average(const std::vector<SkeletonVertex>& cloud, SkeletonKernel kernel,
  vtkPolyData* skin, Columns& columns)
{
  const ParticleWeights particles(cloud, kernel);
  const std::size_t count = static_cast<std::size_t>(skin->GetNumberOfPoints());
  std::vector<vtkIdType> nearest(count);
  for (Column& column : columns)
  {
    column.Averages.assign(count * column.Components, 0.0);
  }
  const auto isLighter = [](const SkeletonWeight& a, const SkeletonWeight& b)
  { return a.Weight < b.Weight; };
  const auto averageSome = [&](const tbb::blocked_range<std::size_t>& range)
  {
    std::vector<SkeletonWeight> weights;
    for (std::size_t v = range.begin(); v != range.end(); ++v)
    {
      double x[3];
      skin->GetPoints()->GetPoint(static_cast<vtkIdType>(v), x);
      particles.Find(x, weights);
      nearest[v] = std::max_element(weights.begin(), weights.end(), isLighter)->Point;
      for (Column& column : columns)
      {
        double* averages = column.Averages.data() + v * column.Components;
        for (const SkeletonWeight& weight : weights)
        {
          const double* values = column.Values.data() + weight.Point * column.Components;
          for (std::size_t c = 0; c < column.Components; ++c)
          {
            averages[c] += weight.Weight * values[c];
          }
        }
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, Grain), averageSome);
  return nearest;
}

// Rounds to the nearest integer, halves upwards; VTK would truncate. Clamps to [0,255], because the
// sum of the weights is 1 only up to rounding.
void RoundColors(std::vector<double>& averages)
{
  constexpr double largest = 255.0;
  for (double& average : averages)
  {
    average = std::clamp(std::floor(average + 0.5), 0.0, largest);
  }
}

void AddAverages(Column& column, vtkPolyData* skin)
{
  vtkDataArray* array = column.Name;
  array->SetNumberOfComponents(static_cast<int>(column.Components));
  array->SetNumberOfTuples(skin->GetNumberOfPoints());
  if (IsColor(array))
  {
    RoundColors(column.Averages);
  }
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    array->SetTuple(v, column.Averages.data() + v * column.Components);
  }
  skin->GetPointData()->AddArray(array);
}

void AddNearest(const PlacedParticles& particles, const Pair& pair,
  const std::vector<vtkIdType>& nearest, vtkPolyData* skin)
{
  vtkSmartPointer<vtkAbstractArray> array;
  array.TakeReference(pair.Get()->NewInstance());
  array->SetName(pair.Get()->GetName());
  array->SetNumberOfComponents(pair.Get()->GetNumberOfComponents());
  array->SetNumberOfTuples(skin->GetNumberOfPoints());
  for (std::size_t v = 0; v < nearest.size(); ++v)
  {
    const Place place = FindPlace(particles, pair, static_cast<std::size_t>(nearest[v]));
    array->SetTuple(static_cast<vtkIdType>(v), place.Tuple, place.Array);
  }
  skin->GetPointData()->AddArray(array);
}

void AddDrift(const Column& column, const vtkFloatArray* directions, vtkPolyData* skin)
{
  vtkDataArray* velocity = skin->GetPointData()->GetArray("Velocity");
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    const double* sum = column.Averages.data() + 4 * v;
    double drift[3], along = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      drift[axis] = sum[3] > 0.0 ? sum[axis] / sum[3] : 0.0;
      along += drift[axis] * directions->GetTypedComponent(v, axis);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const double tangential = drift[axis] - along * directions->GetTypedComponent(v, axis);
      velocity->SetComponent(v, axis, velocity->GetComponent(v, axis) + tangential);
    }
  }
}

vtkPointData* GetReference(const PlacedParticles& particles)
{
  const bool fromEarlier =
    Has(&particles.Track.GetEarlier()) && particles.Track.GetFraction() < 1.0;
  return FindArrays(fromEarlier ? &particles.Track.GetEarlier() : particles.Track.GetLater());
}

void CopyActiveScalars(const PlacedParticles& particles, vtkPolyData* skin)
{
  vtkDataArray* scalars = GetReference(particles)->GetScalars();
  if (scalars && scalars->GetName() && skin->GetPointData()->HasArray(scalars->GetName()))
  {
    skin->GetPointData()->SetActiveScalars(scalars->GetName());
  }
}

// Returns the arrays that are passed to the skin, in the order of the particles' arrays.
std::vector<Pair> FindPairs(const PlacedParticles& particles, vtkPolyData* skin)
{
  vtkPointData* own = skin->GetPointData();
  vtkPointData* arrays = GetReference(particles);
  std::vector<Pair> pairs;
  for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    const char* name = arrays->GetAbstractArray(i)->GetName();
    if (!name || *name == '\0' || own->HasArray(name) ||
      std::string(name) == vtkDataSetAttributes::GhostArrayName())
    {
      continue;
    }
    const Pair pair = FindPair(particles, name);
    if (pair.Get())
    {
      pairs.push_back(pair);
    }
  }
  return pairs;
}

}

void PassArrays(const PassedArrays& passed, const vtkFloatArray* directions, vtkPolyData* skin)
{
  if (!passed.Particles || passed.Particles->Size() == 0 || skin->GetNumberOfPoints() == 0)
  {
    return;
  }
  const PlacedParticles particles(*passed.Particles);
  const std::vector<Pair> pairs = passed.Arrays ? FindPairs(particles, skin) : std::vector<Pair>();
  Columns columns;
  for (const Pair& pair : pairs)
  {
    if (IsAveraged(pair.Get()))
    {
      columns.push_back(MakeColumn(particles, pair));
    }
  }
  if (!passed.Velocities.empty())
  {
    columns.push_back(MakeVelocityColumn(passed.Velocities));
  }
  const std::vector<vtkIdType> nearest = Average(particles.Particles, passed.Kernel, skin, columns);
  auto column = columns.begin();
  for (const Pair& pair : pairs)
  {
    IsAveraged(pair.Get()) ? AddAverages(*column++, skin)
                           : AddNearest(particles, pair, nearest, skin);
  }
  if (!passed.Velocities.empty())
  {
    AddDrift(*column, directions, skin);
  }
  if (passed.Arrays)
  {
    CopyActiveScalars(particles, skin);
  }
}

}
