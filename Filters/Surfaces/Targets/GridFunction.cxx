#include "Targets/GridFunction.h"

#include "Surface/LatticeParts.h"
#include "Targets/TargetOptions.h"

#include "vtkDataSet.h"
#include "vtkGridPotential.h"

#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

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

void ReadGrid(vtkGridPotential* grid, vtkDataSet* data)
{
  grid->SetWarnOfDefects(false);
  grid->SetReportErrors(false);
  grid->SetInput(data);
  grid->Build();
  if (*grid->GetError() != '\0')
  {
    throw std::runtime_error(grid->GetError());
  }
}

std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize)
{
  // A fraction this large is visible: on a body 64 voxels across, a patch of about ten by ten
  // voxels. This fraction is six times its sampling error (SurfaceSample.h), so a larger fraction
  // is not random.
  constexpr double negligible = 0.005;
  constexpr double voxels = 2.0;
  auto grid = vtkGridPotential::SafeDownCast(function);
  const double share = grid ? grid->FindThinShare(voxels * voxelSize) : 0.0;
  std::ostringstream text;
  if (share > negligible)
  {
    constexpr double percent = 100.0;
    text << "about " << std::ceil(percent * share)
         << " % of its surface belongs to parts thinner than two voxels, which the skin may "
            "lose or fragment; reduce VoxelSize (now "
         << voxelSize << ") to half of the thickness of these parts.";
  }
  return text.str();
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
