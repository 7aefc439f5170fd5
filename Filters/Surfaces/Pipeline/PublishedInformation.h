// What the output ports say about themselves, and what is asked of them.

#ifndef PublishedInformation_h
#define PublishedInformation_h

#include <vector>

class vtkDataObject;
class vtkInformation;

namespace activesurface
{

struct SurfaceDomain;

// Of the outputs the one that a request is for.
int AskedPort(vtkInformation* request);

// None for a surface that settles: it is at rest, at no time. Without steps, those of the input.
void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool settles);
void PublishTime(vtkDataObject* data, double time, bool settles);

// Of the potential's image; empty without a domain.
void PublishExtent(vtkInformation* output, const SurfaceDomain* domain);

// Its piece of the image, if no part was asked for as the extent was not known.
void AskForSomeExtent(vtkInformation* output);

// Whether another piece than the first is asked for. Outputs are shared out in pieces to the ranks
// of a parallel program: all of a skin or a history is its first piece, while of the image each
// rank gets its own part.
bool IsOtherPiece(vtkInformation* output);

}

#endif
