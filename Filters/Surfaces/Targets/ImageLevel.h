/**
 * Finds the level of an image of a mask or of volume fractions.
 */
#ifndef ImageLevel_h
#define ImageLevel_h

#include <string>

class vtkDataArray;

namespace activesurface
{

struct ImageLevel
{
  double IsoValue;
  bool Invert; //< whether inside is above
};

/**
 * Returns the level of a mask (all values are one of two, none negative), which is between them, or
 * of volume fractions (0 to 1 with an overshoot of 0.1, most of them 0 or 1), which is 0.5; inside
 * is above. Returns `given` for other values, and if all are equal. Values that are not finite are
 * ignored.
 */
ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given);

/** Returns a sentence for users if some values are not finite, else "". */
std::string DescribeNotFinite(vtkDataArray* values);

/** Returns a sentence for users if the values differ but none of them is inside, else "". */
std::string DescribeLevel(vtkDataArray* values, const ImageLevel& level);

}

#endif
