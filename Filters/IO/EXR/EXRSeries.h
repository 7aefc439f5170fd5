// Reads the files of a series as time steps into images.

#ifndef EXRSeries_h
#define EXRSeries_h

#include "EXR/EXRFile.h"

#include <functional>
#include <set>

class vtkImageData;

namespace activesurface
{

// A file's contents in memory, used in place of a file.
struct EXRMemory
{
  const char* Bytes = nullptr;
  std::size_t Size = 0;
};

// Calls read(file) with an open file. Throws FileError with a sentence that names the file.
void WithEXRFile(
  const std::string& name, const EXRMemory& memory, const std::function<void(EXRFile&)>& read);

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
