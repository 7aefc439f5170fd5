// Frames of the input, other than particles, as implicit functions.

#ifndef TargetFunctions_h
#define TargetFunctions_h

#include "SurfaceSettings.h"
#include "TargetFrame.h"

#include <string>

namespace activesurface
{

struct FrameFunction
{
  vtkSmartPointer<vtkImplicitFunction> Function;
  std::string Flaw; // what a user should know of the data, or empty
};

// radius: where the frame has no array of radii. Throws std::runtime_error.
FrameFunction MakeSkeletonFunction(
  const TargetFrame& frame, const ParticleSettings& settings, double radius);

// Of a mesh or image: the distance, negative inside, and its inverse or another level if the
// settings say so for an image. Values are known up to a distance of reach.
// Throws std::runtime_error.
FrameFunction MakeGridFunction(
  const TargetFrame& frame, const SurfaceSettings& settings, double voxelSize, double reach);

// What a user should know of the parts of a function that MakeGridFunction has made which are
// thinner than two voxels, as a sentence; empty if they are a negligible share of its surface.
std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize);

}

#endif
