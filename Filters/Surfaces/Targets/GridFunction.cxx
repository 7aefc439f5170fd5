#include "Targets/GridFunction.h"

#include "vtkDataSet.h"
#include "vtkGridPotential.h"

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

}
