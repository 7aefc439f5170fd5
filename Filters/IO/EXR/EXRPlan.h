// Chooses the channels of a file, and their types, from the arrays of an image.

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

// Choices of the user.
struct EXRChoices
{
  std::vector<EXRChannelRequest> Channels; // replace the rule for the arrays that they name
  std::map<std::string, EXRPixel> Types;   // by array
  bool FromSRGB = false;
};

// All channels, sorted by name. Throws FileError if two have the same name, or there is none.
std::vector<EXRSource> PlanChannels(vtkImageData* image, const EXRChoices& choices);

}

#endif
