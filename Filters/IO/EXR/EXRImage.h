// Reads a part of an EXR file into an image.

#ifndef EXRImage_h
#define EXRImage_h

#include "EXR/EXRFile.h"

#include <set>

class vtkImageData;

namespace activesurface
{

// Selected channels: all except Exceptions or, if All is false, only these.
struct EXRSelection
{
  bool All = true;
  std::set<std::string> Exceptions;

  bool Has(const std::string& channel) const
  {
    return (this->Exceptions.count(channel) == 0) == this->All;
  }
};

// Returns a part of a file. Throws FileError if the part does not exist or has deep data.
const EXRPart& FindEXRPart(const EXRFile& file, std::size_t part);

// Returns the selected layers of a part. Throws FileError if there are none.
std::vector<EXRLayer> FindEXRLayers(const EXRPart& part, const EXRSelection& selection);

// Fills an empty image: point arrays from the layers, field data from the attributes. The extent
// may differ from the data window. Throws FileError if more than `limit` bytes are needed.
void ReadEXRImage(EXRFile& file, std::size_t part, const EXRSelection& selection,
  const EXRExtent& extent, double limit, vtkImageData* image);

// Smallest extent that covers both extents.
EXRExtent UniteExtents(const EXRExtent& a, const EXRExtent& b);

}

#endif
