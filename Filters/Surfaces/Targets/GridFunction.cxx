#include "Targets/GridFunction.h"

#include "vtkDataSet.h"
#include "vtkGridPotential.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

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
         << " % of its surface belongs to parts thinner than two voxels, which the skin loses "
            "or fragments; reduce VoxelSize (now "
         << voxelSize << ") to half of the thickness of these parts.";
  }
  return text.str();
}

}
