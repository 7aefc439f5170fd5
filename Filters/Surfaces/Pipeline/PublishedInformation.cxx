#include "Pipeline/PublishedInformation.h"

#include "Simulation/SurfaceDomain.h"

#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkExtentTranslator.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

// Returns true if the extent is not empty and within `whole`. VTK splits an empty extent into
// pieces that are empty and outside `whole`.
bool IsPartOf(const int extent[6], const int whole[6])
{
  bool isPart = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int low = extent[2 * axis], high = extent[2 * axis + 1];
    isPart = isPart && whole[2 * axis] <= low && low <= high && high <= whole[2 * axis + 1];
  }
  return isPart;
}

OutputShare FindPiece(vtkInformation* output)
{
  return output->Has(SDDP::UPDATE_NUMBER_OF_PIECES())
    ? OutputShare{ output->Get(SDDP::UPDATE_PIECE_NUMBER()),
        output->Get(SDDP::UPDATE_NUMBER_OF_PIECES()) }
    : OutputShare();
}

}

int RequestedPort(vtkInformation* request)
{
  return std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
}

void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool hasNone)
{
  if (hasNone)
  {
    output->Remove(SDDP::TIME_STEPS());
    output->Remove(SDDP::TIME_RANGE());
  }
  if (hasNone || steps.empty())
  {
    return;
  }
  const double range[2] = { steps.front(), steps.back() };
  output->Set(SDDP::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
  output->Set(SDDP::TIME_RANGE(), range, 2);
}

void PublishTime(vtkDataObject* data, PipelineTime time, bool isEquilibrium)
{
  if (isEquilibrium)
  {
    data->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
    return;
  }
  data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time.Value);
}

bool IsOtherPiece(vtkInformation* output)
{
  return output->Has(SDDP::UPDATE_PIECE_NUMBER()) && output->Get(SDDP::UPDATE_PIECE_NUMBER()) > 0;
}

void RequestSomeExtent(vtkInformation* output, const OutputShare& share)
{
  const int* whole = output->Get(SDDP::WHOLE_EXTENT());
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  output->Get(SDDP::UPDATE_EXTENT(), extent);
  const OutputShare asked = FindPiece(output);
  const bool isOfRank = asked.IsAll() && !share.IsAll();
  const bool isWhole = std::equal(extent, extent + 6, whole);
  if (IsPartOf(extent, whole) && !(isOfRank && isWhole))
  {
    return;
  }
  const OutputShare piece = isOfRank ? share : asked;
  vtkNew<vtkExtentTranslator> translator;
  translator->PieceToExtentThreadSafe(
    piece.Rank, piece.Size, 0, const_cast<int*>(whole), extent, vtkExtentTranslator::BLOCK_MODE, 0);
  output->Set(SDDP::UPDATE_EXTENT(), extent, 6);
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
  const std::array<double, 3> origin = domain ? domain->Origin : std::array<double, 3>{};
  output->Set(vtkDataObject::ORIGIN(), origin.data(), 3);
  output->Set(vtkDataObject::SPACING(), size, size, size);
}

}
