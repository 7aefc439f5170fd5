/**
 * The level of an image whose values say what is inside without being below 0 there.
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
 * Of a mask, all values of which are one of two, none of them negative, the level is between them.
 * Of fractions of volume, from 0 to 1 but for .1, most of which are 0 or 1, it is .5. Inside is
 * above. Else what is given, as where all values are equal. Values that are not finite do not
 * count.
 */
ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given);

/** What a user should know of values that differ but have nothing inside, a sentence; or nothing.
 */
std::string DescribeLevel(vtkDataArray* values, const ImageLevel& level);

}

#endif
