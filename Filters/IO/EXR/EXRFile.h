// Reads an EXR file: its parts, their headers, and the pixels of one part, each channel into a
// buffer of its own.
//
// Rows are VTK's, from below: the pixel (x, y) of the file is at column x - displayWindow.min.x and
// row displayWindow.max.y - y. The pixel (0, 0) is the lower left one of the display window.

#ifndef EXRFile_h
#define EXRFile_h

#include "EXR/EXRLayers.h"
#include "EXR/EXRStreams.h"

#include <ImfForward.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

using EXRExtent = std::array<int, 4>; // first and last column, first and last row

struct EXRPart
{
  std::string Name;
  std::string Type; // scanlineimage, tiledimage, deepscanline or deeptile
  std::vector<EXRChannel> Channels;
  EXRExtent Data{}, Display{};
  double Time = std::nan(""); // the attribute "time"
  double ChunkBytes = 0.0;    // of the lines or the tile that OpenEXR unpacks at a time
};

// Destination of a channel's pixels: unsigned int for UINT channels, float for the others.
struct EXRDestination
{
  std::string Channel;
  char* Pixels = nullptr; // of the first column and row of the extent
  std::size_t Stride = 0; // bytes from one pixel to the next
};

class EXRFile
{
public:
  // Reads the headers. Throws FileError. Bytes in memory have to outlive the object.
  EXRFile(const std::string& name, const EXRMemory& memory);
  ~EXRFile();

  const std::vector<EXRPart>& GetParts() const { return this->Parts; }
  const Imf::Header& GetHeader(std::size_t part) const;

  // Reads channels into images that cover the extent. The extent contains the part's data window.
  // Pixels outside the data window keep their values.
  void Read(std::size_t part, const EXRExtent& extent, const std::vector<EXRDestination>& channels);

private:
  EXRFile(const EXRFile&) = delete;
  void operator=(const EXRFile&) = delete;

  EXRInput Input;
  std::unique_ptr<Imf::MultiPartInputFile> File;
  std::vector<EXRPart> Parts;
};

}

#endif
