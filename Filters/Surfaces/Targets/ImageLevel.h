/** Estimates the level of an image of a mask or of volume fractions. */
#ifndef ImageLevel_h
#define ImageLevel_h

#include <string>

class vtkDataArray;

namespace activesurface
{

struct ImageLevel
{
  double IsoValue;
  bool Invert; //< inside is above the level
};

/**
 * Returns the level that suits the values; inside is above:
 *
 * - mask (only two different values, none negative): midway between the two values
 * - volume fractions (all > -0.1, the largest within 0.1 of 1, more than half within 0.001 of 0 or
 *   1): 0.5
 *
 * Returns `given` for other values, and if all are equal. Ignores values that are not finite.
 */
ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given);

/** Returns a message for the user if some values are not finite, else "". */
std::string DescribeNotFinite(vtkDataArray* values);

/** Returns a message for the user if the values differ but none of them is inside, else "". */
std::string DescribeLevel(vtkDataArray* values, const ImageLevel& level);

}

#endif
