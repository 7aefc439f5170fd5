#include "vtkActiveClockAlgorithm.h"

#include "Simulation/PropertyValues.h"

void vtkActiveClockAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  activesurface::SurfaceSettings unused;
  activesurface::ForEachClockProperty(unused,
    [&](const activesurface::Property& property, auto&, auto&& get)
    { activesurface::PrintProperty(os << indent, property, get(*this)); });
  os << indent << "StartTime: " << this->StartTime << "\n"
     << indent << "TimeStepSize: " << this->TimeStepSize << "\n"
     << indent << "NumberOfTimeSteps: " << this->NumberOfTimeSteps << "\n"
     << indent << "CheckpointInterval: " << this->CheckpointInterval << "\n"
     << indent << "CheckpointMemory: " << this->CheckpointMemory << "\n"
     << indent << "MaximumNumberOfActiveVoxels: " << this->MaximumNumberOfActiveVoxels << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
