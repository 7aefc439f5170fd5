// Writes an EXR file completely or not at all.

#ifndef EXRWriting_h
#define EXRWriting_h

#include "EXR/EXRPixels.h"

#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"

#include <array>
#include <map>
#include <string>
#include <vector>

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
  std::vector<EXRChannelRequest> Channels; // replace the automatic channels of their arrays
  std::map<std::string, EXRPixel> Types;   // by array
  bool FromSRGB = false;
};

// Returns all channels, sorted by name. Throws FileError if there is no channel, if a channel's
// name is missing, too long or used twice, or if a requested component does not exist.
std::vector<EXRSource> PlanChannels(vtkImageData* image, const EXRChoices& choices);

struct EXRHeaderSettings
{
  int Compression = 1;              // CompressionType of vtkActiveEXRWriter
  int Level = 4;                    // of ZIP and ZIPS
  std::array<int, 4> Extent{};      // first and last column, first and last row from below
  std::array<int, 2> DisplaySize{}; // 0: the extent, moved to (0, 0)
  double PixelAspectRatio = 1.0;
  double FramesPerSecond = 0.0;                            // 0: not written
  std::string TimeCode;                                    // empty: not written
  vtkSmartPointer<vtkMatrix4x4> WorldToCamera, WorldToNDC; // null: not written
  std::map<std::string, std::string> Texts;
  std::map<std::string, double> Numbers;
};

// Throws std::exception on failure, and then keeps an existing file. The caller adds the file's
// name to the text of the error.
void WriteEXR(const std::string& name, const EXRHeaderSettings& settings,
  const std::vector<EXRSource>& sources);

}

#endif
