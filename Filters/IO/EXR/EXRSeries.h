// The files that a reader reads, as time steps, and where their pixels go in an image.

#ifndef EXRSeries_h
#define EXRSeries_h

#include "EXR/EXRFile.h"

#include <functional>
#include <set>

class vtkImageData;

namespace activesurface
{

// Bytes that hold a file, in place of one.
struct EXRMemory
{
  const char* Bytes = nullptr;
  std::size_t Size = 0;
};

// Calls read(file) with an open file; throws FileError with a sentence that names it.
void WithEXRFile(
  const std::string& name, const EXRMemory& memory, const std::function<void(EXRFile&)>& read);

// Which channels are wanted: all but these, or, with All false, these only.
struct EXRSelection
{
  bool All = true;
  std::set<std::string> Exceptions;

  bool Has(const std::string& channel) const
  {
    return (this->Exceptions.count(channel) == 0) == this->All;
  }
};

// What a file has to offer of one part, or an FileError: it is not there, or deep.
const EXRPart& FindEXRPart(const EXRFile& file, std::size_t part);

// The layers of a part that are wanted. An FileError if there are none.
std::vector<EXRLayer> FindEXRLayers(const EXRPart& part, const EXRSelection& selection);

// Fills an empty image: the layers of a part over an extent, which need not be that of the data
// window, and the attributes as field data. An FileError if it takes more bytes than the limit.
void ReadEXRImage(EXRFile& file, std::size_t part, const EXRSelection& selection,
  const EXRExtent& extent, double limit, vtkImageData* image);

// The smallest extent that covers both.
EXRExtent UniteExtents(const EXRExtent& a, const EXRExtent& b);

}

#endif
