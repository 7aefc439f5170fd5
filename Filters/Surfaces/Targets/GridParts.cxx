#include "Targets/GridParts.h"

#include "Surface/LatticeParts.h"
#include "Targets/PotentialTarget.h"

#include "vtkGridPotential.h"

namespace activesurface
{

namespace
{

vtkGridPotential* FindGrid(vtkImplicitFunction* function)
{
  auto grid = vtkGridPotential::SafeDownCast(function);
  return grid && !grid->GetTransform() ? grid : nullptr;
}

/** A part relative to an origin, with inside and outside exchanged if inverted. */
class RelativePart : public TargetPart
{
public:
  RelativePart(const TargetPart& part, bool inverted, const std::array<double, 3>& origin)
    : Part(part)
    , Inverted(inverted)
    , Origin(origin)
  {
  }

  bool IsHollow() const override { return this->Part.IsHollow() != this->Inverted; }
  void ForEachSample(const PointVisitor& visit) const override
  {
    this->Part.ForEachSample(this->Move(visit));
  }
  void ForEachPoint(const PointVisitor& visit) const override
  {
    this->Part.ForEachPoint(this->Move(visit));
  }

private:
  PointVisitor Move(const PointVisitor& visit) const
  {
    return [this, &visit](const double x[3])
    {
      const double moved[3] = { x[0] - this->Origin[0], x[1] - this->Origin[1],
        x[2] - this->Origin[2] };
      return visit(moved);
    };
  }

  const TargetPart& Part;
  const bool Inverted;
  const std::array<double, 3>& Origin;
};

}

bool KnowsParts(vtkImplicitFunction* function, const TargetOptions& options)
{
  vtkGridPotential* grid = FindGrid(function);
  return grid && grid->FindParts(options.IsoValue);
}

void ForEachPartOf(vtkImplicitFunction* function, const TargetOptions& options,
  const PartVisitor& visit, const std::array<double, 3>& origin)
{
  vtkGridPotential* grid = FindGrid(function);
  const std::shared_ptr<const LatticeParts> parts =
    grid ? grid->FindParts(options.IsoValue) : nullptr;
  if (parts)
  {
    parts->ForEachPart(
      [&](const TargetPart& part) { visit(RelativePart(part, options.Invert, origin)); });
  }
}

SurfacePoints FindSurfaceOf(vtkImplicitFunction* function, const TargetOptions& options)
{
  vtkGridPotential* grid = FindGrid(function);
  return grid && !options.Invert ? grid->FindSurface(options.IsoValue) : SurfacePoints();
}

}
