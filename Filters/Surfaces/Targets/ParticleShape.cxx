#include "Targets/ParticleShape.h"

#include "Targets/ParticleTarget.h"
#include "Targets/TargetOptions.h"
#include "Targets/Warnings.h"

#include "vtkBoundingBox.h"
#include "vtkCellType.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

// Largest strengths that have an effect. Ellipsoids fade in with strengths from 0 to 1. A SUM of
// larger strengths than this limit would reach at most 0.05 % of a kernel radius farther, and could
// overflow.
constexpr double MostStrengthOfEllipsoids = 1.0, MostStrengthOfSum = 1e9;

// Throws for cells other than vertices. A vtkPolyData needs no check: a vtkPolyData with lines or
// polygons is read as a skeleton or a mesh (InputKinds.cxx).
void CheckHasVerticesOnly(vtkDataSet* data)
{
  const vtkIdType count = vtkPolyData::SafeDownCast(data) ? 0 : data->GetNumberOfCells();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const int type = data->GetCellType(i);
    if (type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX)
    {
      throw std::invalid_argument(std::string("A ") + data->GetClassName() +
        " with other cells than vertices cannot be an input. Use its closed surface as a "
        "vtkPolyData (vtkDataSetSurfaceFilter), or at port 0 only its points, as particles.");
    }
  }
}

ParticleFrame ReadPoints(const InputData& input)
{
  CheckHasVerticesOnly(input.Data);
  PointArrays arrays;
  arrays.Radii = input.Chosen.FindRadii();
  arrays.Ids = input.Chosen.FindIds();
  arrays.Strengths = input.Chosen.FindStrengths();
  arrays.Velocities = input.Kept.Velocities.empty() ? nullptr : input.Chosen.FindVelocities();
  arrays.Passed = input.Kept.All ? input.Data->GetPointData() : nullptr;
  return ReadParticles(vtkPointSet::SafeDownCast(input.Data), arrays);
}

}

bool ParticleShape::Fits(vtkDataSet* data)
{
  return vtkPointSet::SafeDownCast(data) != nullptr;
}

ParticleShape::ParticleShape(const InputData& input)
  : Particles(ReadPoints(input))
  , Kept(input.Kept)
  , HasVertices(input.Data->GetNumberOfCells() > 0)
{
}

ParticleShape::ParticleShape(ParticleFrame particles, const ParticleArrays& kept, bool hasVertices)
  : Particles(std::move(particles))
  , Kept(kept)
  , HasVertices(hasVertices)
{
}

std::shared_ptr<ParticleShape> ParticleShape::MakeOther(ParticleFrame particles) const
{
  auto other = std::make_shared<ParticleShape>(std::move(particles), this->Kept, this->HasVertices);
  other->CopyFacts(*this);
  return other;
}

std::string ParticleShape::Prepare(const TargetOptions& options, const Warnings& messages)
{
  const std::size_t count = this->Particles.CountAllPoints() - this->Particles.CountAllParticles();
  if (count > 0)
  {
    messages.Say("ignored particles",
      std::to_string(count) + (count > 1 ? " particles are" : " particle is") + " left out " +
        options.When +
        " because a coordinate, radius or strength is not finite (NaN, or beyond +-1e100), or a "
        "radius is below 1e-100. Correct or remove such particles.");
  }
  this->LimitStrengths(options, messages);
  options.GiveRadii(options.Model, this->Particles);
  return "";
}

void ParticleShape::LimitStrengths(const TargetOptions& options, const Warnings& messages)
{
  const bool isSum = options.Model == ParticleModel::Sum;
  if (this->Particles.Particles.LimitStrengths(
        isSum ? MostStrengthOfSum : MostStrengthOfEllipsoids) &&
    !isSum)
  {
    messages.Say("limited strengths",
      "Strengths of particles above 1 count as 1 with ParticleModel ANISOTROPIC; use SUM, "
      "or choose no array of strengths.");
  }
}

void ParticleShape::AddBounds(
  const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox&) const
{
  double bounds[6];
  if (this->Particles.GetBounds(bounds))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (options.Box.Length[axis] > 0.0)
      {
        bounds[2 * axis] = options.Box.Low[axis];
        bounds[2 * axis + 1] = options.Box.Low[axis] + options.Box.Length[axis];
      }
    }
    shapes.AddBounds(bounds);
  }
}

std::unique_ptr<MovingTarget> ParticleShape::MakeTarget(
  const TargetFrames& frames, const TargetOptions& options) const
{
  return std::make_unique<ParticleTarget>(frames, options);
}

}
