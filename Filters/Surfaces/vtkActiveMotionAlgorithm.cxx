#include "vtkActiveMotionAlgorithm.h"

void vtkActiveMotionAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Attraction: " << this->Attraction << "\n"
     << indent << "Tension: " << this->Tension << "\n"
     << indent << "CFL: " << this->CFL << "\n"
     << indent << "VolumeControl: " << this->VolumeControl << "\n"
     << indent << "AreaControl: " << this->AreaControl << "\n"
     << indent << "VolumeStiffness: " << this->VolumeStiffness << "\n"
     << indent << "AreaStiffness: " << this->AreaStiffness << "\n"
     << indent << "TargetVolume: " << this->TargetVolume << "\n"
     << indent << "TargetArea: " << this->TargetArea << "\n"
     << indent << "StartTime: " << this->StartTime << "\n"
     << indent << "TimeStepSize: " << this->TimeStepSize << "\n"
     << indent << "NumberOfTimeSteps: " << this->NumberOfTimeSteps << "\n"
     << indent << "TimeScale: " << this->TimeScale << "\n"
     << indent << "CheckpointInterval: " << this->CheckpointInterval << "\n"
     << indent << "CheckpointMemory: " << this->CheckpointMemory << "\n"
     << indent << "MaximumNumberOfActiveVoxels: " << this->MaximumNumberOfActiveVoxels << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n"
     << indent << "EvolutionMode: " << this->EvolutionMode << "\n"
     << indent << "RestTolerance: " << this->RestTolerance << "\n"
     << indent << "MaximumNumberOfSubsteps: " << this->MaximumNumberOfSubsteps << "\n"
     << indent << "TargetEvaluation: " << this->TargetEvaluation << "\n"
     << indent << "GradientScheme: " << this->GradientScheme << "\n"
     << indent << "PaperScheme: " << this->PaperScheme << "\n";
}
