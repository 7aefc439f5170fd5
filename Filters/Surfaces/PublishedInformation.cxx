#include "PublishedInformation.h"

#include "SurfaceSettings.h"

#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

int AskedPort(vtkInformation* request)
{
  return std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
}

void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool settles)
{
  if (settles)
  {
    output->Remove(SDDP::TIME_STEPS());
    output->Remove(SDDP::TIME_RANGE());
    return;
  }
  const double range[2] = { steps.front(), steps.back() };
  output->Set(SDDP::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
  output->Set(SDDP::TIME_RANGE(), range, 2);
}

void PublishTime(vtkDataObject* data, double time, bool settles)
{
  if (settles)
  {
    data->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
    return;
  }
  data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

bool IsOtherPiece(vtkInformation* output)
{
  return output->Has(SDDP::UPDATE_PIECE_NUMBER()) && output->Get(SDDP::UPDATE_PIECE_NUMBER()) > 0;
}

void AskForSomeExtent(vtkInformation* output)
{
  int e[6] = { 0, -1, 0, -1, 0, -1 };
  output->Get(SDDP::UPDATE_EXTENT(), e);
  if (e[0] > e[1] || e[2] > e[3] || e[4] > e[5])
  {
    output->Set(SDDP::UPDATE_EXTENT(), output->Get(SDDP::WHOLE_EXTENT()), 6);
  }
}

void PublishExtent(vtkInformation* output, const SurfaceDomain* domain)
{
  constexpr int empty[6] = { 0, -1, 0, -1, 0, -1 };
  int extent[6];
  if (!domain || !domain->GetExtent(extent))
  {
    std::copy(empty, empty + 6, extent);
  }
  const double size = domain ? domain->VoxelSize : 1.0;
  output->Set(SDDP::WHOLE_EXTENT(), extent, 6);
  output->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  output->Set(vtkDataObject::SPACING(), size, size, size);
}

}
