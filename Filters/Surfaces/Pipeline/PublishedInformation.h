// What the output ports say about themselves, and what is asked of them.

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

// The output port that a request is for.
int RequestedPort(vtkInformation* request);

// None for a surface in equilibrium, which is at no time, and over pushed frames, of which the
// newest can be had. Without steps, those of the input.
void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool hasNone);
void PublishTime(vtkDataObject* data, PipelineTime time, bool isEquilibrium);

// Of the potential's image; empty without a domain.
void PublishExtent(vtkInformation* output, const SurfaceDomain* domain);

// If UPDATE_EXTENT is empty or outside the image, requests the extent of the requested piece; of
// this rank's piece, if no rank has asked for less than the image.
void RequestSomeExtent(vtkInformation* output, const OutputShare& share);

// Whether another piece than the first is requested. Outputs are shared out in pieces to the ranks
// of a parallel program: all of a skin or a history is its first piece, while of the image each
// rank gets its own part.
bool IsOtherPiece(vtkInformation* output);

}

#endif
