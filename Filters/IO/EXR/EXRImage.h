// Reads a part of an EXR file into an image.

#ifndef EXRImage_h
#define EXRImage_h

#include "EXR/EXRLayers.h"
#include "EXR/EXRStreams.h"

#include <ImfForward.h>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkImageData;

namespace activesurface
{

// First and last column, first and last row. (0, 0) is the lower left pixel of the display window.
using EXRExtent = std::array<int, 4>;

struct EXRPart
{
  std::string Name;
  std::string Type; // scanlineimage, tiledimage, deepscanline or deeptile
  std::vector<EXRChannel> Channels;
  EXRExtent Data{}, Display{};
  double Time = std::nan(""); // the attribute "time", a double
  double ChunkBytes = 0.0;    // bytes of the lines or the tile that OpenEXR unpacks at a time
};

// Destination of a channel's pixels: unsigned int for UINT channels, float for other channels.
struct EXRDestination
{
  std::string Channel;
  char* Pixels = nullptr; // of the first column and row of the extent
  std::size_t Stride = 0; // bytes from one pixel to the next
};

class EXRFile
{
public:
  // Reads the headers. Throws FileError on failure. Bytes in memory have to outlive the object.
  EXRFile(const std::string& name, const EXRMemory& memory);
  ~EXRFile();

  const std::vector<EXRPart>& GetParts() const { return this->Parts; }
  const Imf::Header& GetHeader(std::size_t part) const;

  // Reads channels into images that cover the extent. The extent has to contain the part's data
  // window. Pixels outside the data window keep their values.
  void Read(std::size_t part, const EXRExtent& extent, const std::vector<EXRDestination>& channels);

private:
  EXRFile(const EXRFile&) = delete;
  void operator=(const EXRFile&) = delete;

  EXRInput Input;
  std::unique_ptr<Imf::MultiPartInputFile> File;
  std::vector<EXRPart> Parts;
};

// Selected channels: all except Exceptions or, if All is false, only Exceptions.
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

// Returns the selected layers of a part. Throws FileError if no channel is selected.
std::vector<EXRLayer> FindEXRLayers(const EXRPart& part, const EXRSelection& selection);

// Fills an empty image: point arrays from the layers, field data from the attributes. The extent
// may differ from the data window. Throws FileError if more than `limit` bytes are needed, or the
// part cannot be read.
void ReadEXRImage(EXRFile& file, std::size_t part, const EXRSelection& selection,
  const EXRExtent& extent, double limit, vtkImageData* image);

// Smallest extent that covers both extents.
EXRExtent UniteExtents(const EXRExtent& a, const EXRExtent& b);

}

#endif
