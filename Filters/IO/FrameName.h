// Names of the files of a series.

#ifndef FrameName_h
#define FrameName_h

#include <string>

namespace activesurface
{

// The name with the number in place of its last run of # (padded to its length; not in a folder's
// name), or of %d or %0Nd; where there is neither, and `always`, before the extension, with four
// digits.
std::string MakeFrameName(const std::string& pattern, int number, bool always);

}

#endif
