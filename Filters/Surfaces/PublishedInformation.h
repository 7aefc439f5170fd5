// What the output ports say about themselves.

#ifndef PublishedInformation_h
#define PublishedInformation_h

#include <vector>

class vtkDataObject;
class vtkInformation;

namespace activesurface
{

struct SurfaceDomain;

// None for a surface that settles: it is at rest, at no time; nor without steps.
void PublishTimes(vtkInformation* output, const std::vector<double>& steps, bool settles);
void PublishTime(vtkDataObject* data, double time, bool settles);

// Of the potential's image; empty without a domain.
void PublishExtent(vtkInformation* output, const SurfaceDomain* domain);

}

#endif
