// Information of the output ports, and the requests at these ports.

#ifndef PublishedInformation_h
#define PublishedInformation_h

#include "Pipeline/OutputShare.h"
#include "Simulation/Times.h"

#include <vector>

class vtkDataObject;
class vtkInformation;

namespace activesurface
{

struct SurfaceDomain;

// Returns the output port of a request.
int RequestedPort(vtkInformation* request);

// Publishes the steps. Publishes no times if hasNone: for a surface in equilibrium, which has no
// time, and for pushed frames, because only the newest frame is available. Without steps, the
// output keeps the times that VTK copied from the input.
void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool hasNone);
void PublishTime(vtkDataObject* data, PipelineTime time, bool isEquilibrium);

// Publishes the extent, origin and spacing of the potential's image. The extent is empty without a
// domain, and if SurfaceDomain::GetExtent fails.
void PublishExtent(vtkInformation* output, const SurfaceDomain* domain);

// Replaces an UPDATE_EXTENT that is empty or not within the image by the extent of the requested
// piece. On several ranks, a rank that requests the whole image as piece 0 of 1 gets only its own
// part.
void RequestSomeExtent(vtkInformation* output, const OutputShare& share);

// Returns true if a piece other than piece 0 is requested. Parallel programs may distribute the
// outputs of single-process filters. In such a program, piece 0 contains all of the skin and the
// history, and each rank gets its own part of the image.
bool IsOtherPiece(vtkInformation* output);

}

#endif
