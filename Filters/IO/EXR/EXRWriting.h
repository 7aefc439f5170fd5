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

namespace activesurface
{

struct EXRHeaderSettings
{
  int Compression = 1;              // of vtkActiveEXRWriter
  int Level = 4;                    // of ZIP and ZIPS
  std::array<int, 4> Extent{};      // first and last column, first and last row from below
  std::array<int, 2> DisplaySize{}; // 0: the extent is the display window
  double PixelAspectRatio = 1.0;
  double FramesPerSecond = 0.0;                            // 0: not written
  std::string TimeCode;                                    // empty: not written
  vtkSmartPointer<vtkMatrix4x4> WorldToCamera, WorldToNDC; // null: not written
  std::map<std::string, std::string> Texts;
  std::map<std::string, double> Numbers;
};

// Throws FileError whose text follows "Cannot write the file: ". On failure an existing file is
// kept.
void WriteEXR(const std::string& name, const EXRHeaderSettings& settings,
  const std::vector<EXRSource>& sources);

}

#endif
