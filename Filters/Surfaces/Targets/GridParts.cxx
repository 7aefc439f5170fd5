#include "Targets/GridParts.h"

#include "LatticeParts.h"
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

/** A part of the other side. */
class InvertedPart : public TargetPart
{
public:
  explicit InvertedPart(const TargetPart& part)
    : Part(part)
  {
  }

  bool IsHollow() const override { return !this->Part.IsHollow(); }
  void ForEachSample(const PointVisitor& visit) const override { this->Part.ForEachSample(visit); }
  void ForEachPoint(const PointVisitor& visit) const override { this->Part.ForEachPoint(visit); }

private:
  const TargetPart& Part;
};

}

bool KnowsParts(vtkImplicitFunction* function, const TargetOptions& options)
{
  vtkGridPotential* grid = FindGrid(function);
  return grid && grid->FindParts(options.IsoValue);
}

void ForEachPartOf(
  vtkImplicitFunction* function, const TargetOptions& options, const PartVisitor& visit)
{
  vtkGridPotential* grid = FindGrid(function);
  const std::shared_ptr<const LatticeParts> parts =
    grid ? grid->FindParts(options.IsoValue) : nullptr;
  if (!parts)
  {
    return;
  }
  if (!options.Invert)
  {
    parts->ForEachPart(visit);
    return;
  }
  parts->ForEachPart([&visit](const TargetPart& part) { visit(InvertedPart(part)); });
}

SurfacePoints FindSurfaceOf(vtkImplicitFunction* function, const TargetOptions& options)
{
  vtkGridPotential* grid = FindGrid(function);
  return grid && !options.Invert ? grid->FindSurface(options.IsoValue) : SurfacePoints();
}

}
