// Pixels of a vtkImageData as samples. The value, +-(pixel - IsoValue), is trilinear within the
// image's box. Outside, the value is the distance to the box [length], or ImageLevel::Beyond if
// that is not negative.

#ifndef ImageSamples_h
#define ImageSamples_h

#include "Base/OpenVDB.h"
#include "Grid/GridSamples.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

struct ImageLevel
{
  std::string ArrayName; // empty: the active scalars, else the first array of one component
  double IsoValue = 0.0;
  bool InvertInside = false;
  double Beyond = -1.0; // value outside the image's box; negative: the distance to the box
};

// Mask of 8 x 8 x 8 pixels.
using PixelMask = openvdb::MaskTree::LeafNodeType::NodeMaskType;

class ImageSamples : public GridSamples
{
public:
  // Keeps the array, which must not change during use. Throws std::invalid_argument, with a
  // message, for an empty or flat image, an unusable array, an origin, spacing or level that is not
  // finite, a spacing of 0, or axes that are not orthogonal.
  ImageSamples(vtkImageData* image, const ImageLevel& level);
  ~ImageSamples() override;

  double Evaluate(const double x[3], double* gradient) const override;
  bool GetBounds(double bounds[6]) const override;
  bool FindShape(double level, LatticeShape& shape) const override;
  // Returns crossings of the surface with lines of pixels.
  SurfaceSample SampleSurface() const override;

private:
  void ReadAxes(vtkImageData* image);
  void SampleLine(int axis, int pixel[3], double area, SurfaceGatherer& surface) const;
  double GetSample(const int pixel[3]) const;
  bool FillBlock(double level, const openvdb::Coord& origin, PixelMask& inside) const;
  void Locate(const double x[3], double place[3]) const;
  double DistanceToBox(const double excess[3], double* gradient) const;
  double Interpolate(const double place[3], double* gradient) const;

  vtkSmartPointer<vtkDataArray> Pixels;
  double IsoValue;
  double Sign; // factor of the samples: -1 exchanges the sides
  double Beyond;
  int Extent[6];
  double Origin[3];
  double Axis[3][3];    // from a pixel to the next along each axis [length]
  double Inverse[3][3]; // rows give lattice coordinates
  double Spacing[3];    // length of the axes, positive
  double Slack;         // rounding of lattice coordinates [pixels]
};

}

#endif
