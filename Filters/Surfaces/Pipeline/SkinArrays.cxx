#include "Pipeline/SkinArrays.h"

#include "NarrowBand.h"
#include "Surface/SkinMotion.h"

#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace activesurface
{

namespace
{

struct SkinContext
{
  const SurfaceSimulation& Simulation;
  const SkinAttributes& Attributes;
  const vtkFloatArray* Normals;
};

using FloatArray = vtkSmartPointer<vtkFloatArray>;

// Returns the normal velocity. The tangential part is added with the passed arrays.
FloatArray MakeVelocity(const SkinContext& skin)
{
  const std::vector<float> speeds =
    skin.Attributes.FindSpeeds(skin.Simulation.GetBand(), skin.Simulation.GetMotion());
  auto velocity = FloatArray::New();
  velocity->SetName("Velocity");
  velocity->SetNumberOfComponents(3);
  velocity->SetNumberOfTuples(static_cast<vtkIdType>(speeds.size()));
  for (std::size_t i = 0; i < 3 * speeds.size(); ++i)
  {
    const auto place = static_cast<vtkIdType>(i);
    velocity->SetValue(place, speeds[i / 3] * skin.Normals->GetValue(place));
  }
  return velocity;
}

FloatArray MakeCurvatureOf(const SkinContext& skin)
{
  return MakeCurvature(skin.Simulation.GetBand());
}

// A point array: the property that requests the array, and the inputs that the array needs besides
// the band.
struct SkinArray
{
  bool OutputProperties::*IsRequested;
  bool NeedsNormals;
  bool NeedsSpeeds;
  FloatArray (*Make)(const SkinContext& skin);
};

constexpr SkinArray Arrays[] = {
  { &OutputProperties::Velocity, true, true, MakeVelocity },
  { &OutputProperties::Curvature, false, false, MakeCurvatureOf },
};

bool HasRequested(const OutputProperties& properties, bool SkinArray::*need)
{
  return std::any_of(std::begin(Arrays), std::end(Arrays),
    [&properties, need](const SkinArray& array)
    { return array.*need && properties.*array.IsRequested; });
}

// Limits a vector to the length `longest`. Shortens the normal part first, because the tangential
// part is the particles' own velocity. Shortens the tangential part only if this part itself
// exceeds `longest`.
void ShortenVector(double longest, const double normal[3], float* vector)
{
  double along = 0.0, square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    along += double(vector[axis]) * normal[axis];
    square += double(vector[axis]) * vector[axis];
  }
  if (square <= longest * longest)
  {
    return;
  }
  const double across = std::sqrt(std::max(square - along * along, 0.0));
  const double share = across > longest ? longest / across : 1.0;
  const double most = std::sqrt(std::max(longest * longest - across * across, 0.0));
  const double kept = std::min(std::max(along, -most), most);
  for (int axis = 0; axis < 3; ++axis)
  {
    vector[axis] =
      static_cast<float>(share * (vector[axis] - along * normal[axis]) + kept * normal[axis]);
  }
}

void ShortenVectors(double longest, const vtkFloatArray* normals, vtkFloatArray* vectors)
{
  for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
  {
    const double normal[3] = { normals->GetTypedComponent(i, 0), normals->GetTypedComponent(i, 1),
      normals->GetTypedComponent(i, 2) };
    ShortenVector(longest, normal, vectors->GetPointer(3 * i));
  }
}

}

vtkSmartPointer<vtkFloatArray> MakeCurvature(const NarrowBand& band)
{
  const std::vector<float> curvatures = FindCurvatures(band);
  auto array = FloatArray::New();
  array->SetName("MeanCurvature");
  array->SetNumberOfTuples(static_cast<vtkIdType>(curvatures.size()));
  std::copy(curvatures.begin(), curvatures.end(), array->GetPointer(0));
  return array;
}

bool NeedNormals(const OutputProperties& properties)
{
  return HasRequested(properties, &SkinArray::NeedsNormals);
}

bool NeedSpeeds(const OutputProperties& properties)
{
  return HasRequested(properties, &SkinArray::NeedsSpeeds);
}

void AddSkinArrays(const OutputProperties& properties, const SurfaceSimulation& simulation,
  const vtkFloatArray* normals, vtkPolyData* skin)
{
  const SkinAttributes attributes = simulation.FindAttributes();
  const SkinContext context{ simulation, attributes, normals };
  for (const SkinArray& array : Arrays)
  {
    if (properties.*array.IsRequested)
    {
      skin->GetPointData()->AddArray(array.Make(context));
    }
  }
  const PassedArrays passed = attributes.FindPassedArrays();
  simulation.GetBand().Run([&passed, normals, skin] { PassArrays(passed, normals, skin); });
  if (properties.Velocity)
  {
    const double longest = properties.MaximumVelocity > 0.0
      ? properties.MaximumVelocity
      : attributes.FindFastestParticle(passed);
    if (longest > 0.0)
    {
      ShortenVectors(
        longest, normals, vtkFloatArray::SafeDownCast(skin->GetPointData()->GetArray("Velocity")));
    }
  }
}

}
