// Arbitrary bytes as a .vdb file: its list of grids, then each grid within a small box, dense and
// sparse.

#include "FuzzInput.h"

#include "vtkActiveVDBReader.h"

#include <vtkNew.h>

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  const activesurface::FuzzFile file(".vdb", data, size);
  vtkNew<vtkActiveVDBReader> reader;
  reader->SetFileName(file.GetName());
  reader->SetRegionToIndex();
  reader->SetIndexRegion(-8, 8, -8, 8, -8, 8);
  reader->SetMaximumNumberOfPoints(10000);
  reader->UpdateInformation();
  const int count = std::min(reader->GetNumberOfGrids(), 4);
  for (int i = 0; i < count; ++i)
  {
    reader->SetGridName(reader->GetGridName(i));
    for (const bool isDense : { true, false })
    {
      reader->SetOutputDense(isDense);
      reader->Update();
    }
  }
  return 0;
}
