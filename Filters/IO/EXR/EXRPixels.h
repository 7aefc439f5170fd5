// The components of VTK's arrays as the samples of channels: in place where they are samples
// already, else converted, and refused where a value does not fit.

#ifndef EXRPixels_h
#define EXRPixels_h

#include "EXR/EXRLayers.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataArray;

namespace activesurface
{

// A channel as it is asked for.
struct EXRSource
{
  std::string Channel;
  vtkSmartPointer<vtkDataArray> Array;
  int Component = 0;
  EXRPixel Type = EXRPixel::FLOAT;
  bool Normalized = false; // integers stand for 0 to 1
  bool FromSRGB = false;   // decoded to linear
};

// Samples of a channel, in the order of the array's tuples.
struct EXRSamples
{
  std::string Channel;
  EXRPixel Type = EXRPixel::FLOAT;
  const char* First = nullptr;
  std::size_t Stride = 0;      // bytes
  std::vector<char> Converted; // what First points to, unless that is the array itself
};

// Throws FileError if a value does not fit into the type. The source has to live as long.
EXRSamples MakeSamples(const EXRSource& source);

}

#endif
