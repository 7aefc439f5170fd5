#include "SkinPort.h"

#include "SkinMotion.h"
#include "SurfaceInput.h"
#include "SurfaceOutput.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

// What no vector of "Velocity" is longer than, or 0 for no bound.
double FindLargestVelocity(
  double maximum, SurfaceSimulation& simulation, const std::vector<double>& velocities)
{
  if (!(maximum >= 0.0))
  {
    throw std::invalid_argument(
      "MaximumVelocity has to be a number > 0, or 0 for the speed of the fastest particle.");
  }
  double fastest = maximum > 0.0 ? maximum : simulation.GetFastestParticle();
  for (std::size_t i = 0; maximum == 0.0 && fastest > 0.0 && i < velocities.size(); i += 3)
  {
    const double speed = std::hypot(velocities[i], velocities[i + 1], velocities[i + 2]);
    fastest = speed > fastest ? speed : fastest;
  }
  return fastest;
}

// Shortens what is along the normals: the particles' own velocity along the skin is no error.
void LimitVelocity(double largest, const vtkFloatArray* normals, vtkFloatArray* velocity)
{
  for (vtkIdType v = 0; v < velocity->GetNumberOfTuples(); ++v)
  {
    float* vector = velocity->GetPointer(3 * v);
    double along = 0.0, square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      along += double(vector[axis]) * normals->GetTypedComponent(v, axis);
      square += double(vector[axis]) * vector[axis];
    }
    if (square <= largest * largest)
    {
      continue;
    }
    const double across = std::sqrt(std::max(square - along * along, 0.0));
    const double share = across > largest ? largest / across : 1.0;
    const double most = std::sqrt(std::max(largest * largest - across * across, 0.0));
    const double kept = std::min(std::max(along, -most), most);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double normal = normals->GetTypedComponent(v, axis);
      vector[axis] = static_cast<float>(share * (vector[axis] - along * normal) + kept * normal);
    }
  }
}

}

SkinWishes ReadWishes(vtkActiveImplicitSurface* filter, const SurfaceInput& target)
{
  SkinWishes wishes;
  wishes.Speeds = filter->GetComputeVelocity() != 0;
  wishes.Bound = wishes.Speeds && filter->GetMaximumVelocity() == 0.0;
  wishes.Drift = wishes.Speeds && filter->GetTangentialVelocity() != 0;
  wishes.Arrays = filter->GetPassTargetArrays() != 0;
  if (wishes.Arrays || wishes.Drift)
  {
    wishes.Extras = target.DescribeExtras(wishes.Arrays, wishes.Drift);
  }
  return wishes;
}

void FillSkinPort(
  vtkActiveImplicitSurface* filter, SurfaceSimulation& simulation, vtkPolyData* skin)
{
  const NarrowBand& band = simulation.GetBand();
  SkinArrays arrays;
  arrays.Normals = filter->GetComputeNormals() != 0;
  std::vector<float> curvatures, speeds;
  if (filter->GetComputeCurvature())
  {
    curvatures = FindCurvatures(band);
    arrays.Curvatures = &curvatures;
  }
  if (filter->GetComputeVelocity())
  {
    speeds = simulation.GetSpeeds();
    arrays.Speeds = &speeds;
  }
  const vtkSmartPointer<vtkFloatArray> directions = FillSkin(band, arrays, skin);
  const PassedArrays passed = simulation.GetPassedArrays();
  band.Run([&passed, &directions, skin] { PassArrays(passed, directions, skin); });
  if (filter->GetComputeVelocity())
  {
    const double largest =
      FindLargestVelocity(filter->GetMaximumVelocity(), simulation, passed.Velocities);
    if (largest > 0.0)
    {
      LimitVelocity(largest, directions,
        vtkFloatArray::SafeDownCast(skin->GetPointData()->GetArray("Velocity")));
    }
  }
}

}
