// Provides components of VTK arrays as samples of channels, without a copy if the types agree and
// no color is decoded. Other values are converted; a value that does not fit the type of the
// channel is an error.

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

// Channel to write.
struct EXRSource
{
  std::string Channel;
  vtkSmartPointer<vtkDataArray> Array;
  int Component = 0;
  EXRPixel Type = EXRPixel::FLOAT;
  bool Normalized = false; // integers represent 0 to 1
  bool FromSRGB = false;   // sRGB, to be decoded to linear
};

// Samples of a channel, in the order of the array's tuples.
struct EXRSamples
{
  EXRPixel Type = EXRPixel::FLOAT;
  const char* First = nullptr;
  std::size_t Stride = 0;      // bytes
  std::vector<char> Converted; // converted samples if First does not point into the array
};

// Throws FileError if a value does not fit into the type, or the array's type is not supported. The
// source has to outlive the samples.
EXRSamples MakeSamples(const EXRSource& source);

}

#endif
