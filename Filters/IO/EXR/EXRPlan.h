// Which channels a file gets from the arrays of an image, and of which types.

#ifndef EXRPlan_h
#define EXRPlan_h

#include "EXR/EXRPixels.h"

#include <map>

class vtkImageData;

namespace activesurface
{

struct EXRChannelRequest
{
  std::string Array;
  int Component = 0;
  std::string Channel;
};

// What the user asks for.
struct EXRChoices
{
  std::vector<EXRChannelRequest> Channels; // an array that is in here is left out of the rule
  std::map<std::string, EXRPixel> Types;   // by array
  bool FromSRGB = false;
};

// All channels, sorted by name. Throws FileError if two have one name, or there is none.
std::vector<EXRSource> PlanChannels(vtkImageData* image, const EXRChoices& choices);

}

#endif
