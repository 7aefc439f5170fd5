// Images and EXR files for the tests of vtkActiveEXRReader and vtkActiveEXRWriter. OpenEXR itself
// writes the files, because vtkActiveEXRWriter does not write all kinds.
#ifndef EXRFiles_h
#define EXRFiles_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

class vtkDataArray;

// Array of pseudo-random bits.
vtkSmartPointer<vtkDataArray> MakeNumbers(
  const std::string& name, int type, int components, vtkIdType tuples, unsigned seed);

// Image of one layer with the float arrays RGBA, Z, N, P, forward and the unsigned int array id,
// all of pseudo-random bits.
vtkSmartPointer<vtkImageData> MakeLayers(int width, int height);

// Returns true if both arrays exist and have the same type, size and bytes.
bool HaveSameBytes(vtkDataArray* a, vtkDataArray* b);

std::vector<char> ReadBytes(const std::string& name);
void WriteBytes(const std::string& name, const std::vector<char>& bytes);

// Integer that differs between the pixels of a channel, and between the channels of a pixel.
float ValueAt(int channel, int x, int y);

// Files with channels R, G, B (HALF), Z (FLOAT) and id (UINT) that hold ValueAt(0 to 4, x, y) at
// the file's pixel (x, y), y downwards, over the data window (left, top) to (left + 18, top + 12).
struct KindOfFile
{
  bool Tiled = false;
  bool MipMaps = false;
  bool Downwards = true; // order of lines
  int Compression = 3;   // ZIP
  int Left = 0, Top = 0;
};
constexpr int FileWidth = 19, FileHeight = 13;
void WriteKind(const std::string& name, const KindOfFile& kind);

// Two parts, "left" and "right", with the channels of WriteKind. Values of "right" are greater by
// 1000.
void WriteTwoParts(const std::string& name);

// Y at each pixel, RY and BY at every second pixel in both directions.
void WriteLuminanceChroma(const std::string& name);

// Deep scanlines with two samples in each pixel.
void WriteDeep(const std::string& name);

#endif
