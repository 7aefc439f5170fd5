// Signed distance to the surface of a label. The label consists of the pixels of an image whose
// values are above a level; pixels beyond the image are outside. The label's surface consists of
// the outer faces of its pixels.
//
// At a pixel's centre the distance is that to the nearest centre on the other side of the surface,
// minus 1/2; negative in the label. Between centres the distance is trilinear. Beyond four pixels
// from the label's box the distance is constant. The unit is a pixel, as if all pixels were cubes
// of side 1. Points with distances between -1/2 and 1/2 are within half a pixel of the label's
// surface along each axis.

#ifndef LabelSamples_h
#define LabelSamples_h

#include "vtkActiveShapesModule.h"

#include <memory>

class vtkImageData;

namespace activesurface
{

class GridSamples;

struct LabelFacts
{
  double Volume = 0.0;       // of the label's pixels [length^3]; 0: no label
  double LeastPixel = 0.0;   // shortest side of a pixel [length]
  double LargestPixel = 0.0; // longest side of a pixel
};

// Returns the distances for the pixels whose active scalar is above the level, and sets `facts`.
// Returns null if there are no such pixels. Throws std::invalid_argument like ImageSamples.
VTKACTIVESHAPES_EXPORT std::shared_ptr<const GridSamples> MakeLabelSamples(
  vtkImageData* image, double level, LabelFacts& facts);

}

#endif
