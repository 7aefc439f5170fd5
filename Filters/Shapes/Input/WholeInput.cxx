#include "Input/WholeInput.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

void RequestWhole(vtkInformation* input)
{
  input->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  input->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (input->Has(SDDP::WHOLE_EXTENT()))
  {
    input->Set(SDDP::UPDATE_EXTENT(), input->Get(SDDP::WHOLE_EXTENT()), 6);
  }
}

}
